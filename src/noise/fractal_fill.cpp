#include <cmath>

#include "base/parallel.hpp"
#include "noise/fractal.hpp"
#include "noise/lattice.hpp"
#include "noise/noise_cell.hpp"

namespace wold {
namespace {

template <class Value>
void fill_rows(GridView<float> out, DVec2 origin, double step, const char* stage,
               Progress& progress, const Value& value) {
  progress.begin(stage, out.height(), "rows");
  parallel_for(0, out.height(), [&](int j) {
    const double y = origin.y + step * j;
    const auto row = out.row(j);
    for (int i = 0; i < out.width(); ++i)
      row[static_cast<std::size_t>(i)] = value(DVec2(origin.x + step * i, y));
    progress.advance();
  });
  progress.end();
}

}  // namespace

void fill_fractal(GridView<float> out, const Fractal& f, DVec2 origin, double step,
                  std::uint32_t seed, Progress& progress) {
  const FractalSampler sampler(f, seed);
  const auto spacing = static_cast<float>(std::abs(step));
  fill_rows(out, origin, step, "fractal", progress,
            [&](DVec2 p) { return sampler(p, spacing).value; });
}

}  // namespace wold
