#include "terrain/fractal_ground.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/hash.hpp"
#include "base/parallel.hpp"

namespace wold {

namespace {

constexpr std::uint32_t probe_seed = 0x70726f62;

constexpr int probes = 4096;

DVec2 probe_place(int k) {
  const auto coordinate = [&](int axis) {
    return 97.0 * uniform_double(random_bits(probe_seed, k, axis));
  };
  return {coordinate(0), coordinate(1)};
}

}  // namespace

Description<FractalShape> describe(const FractalShape&) {
  using S = FractalShape;
  return Description<S>("shape", "Extent of a fractal.")
      .add("height", &S::height, {.unit = "m", .min = 0, .max = 20000},
           "Height of the summits above the valleys.")
      .add("base", &S::base, {.unit = "m", .min = -20000, .max = 20000}, "Height of the valleys.")
      .add("feature_size", &S::feature_size, {.unit = "m", .min = 0.1, .max = 1e6},
           "Distance between the largest hills.");
}

FractalStatistics fractal_statistics(const Fractal& f, float spacing) {
  constexpr int count = probes;
  constexpr int tail = count / 200;
  const FractalSampler sample(f, probe_seed);
  std::vector<float> whole(count);
  std::vector<float> faded(count);
  parallel_for(
      0, count,
      [&](int k) {
        const DVec2 place = probe_place(k);
        whole[static_cast<std::size_t>(k)] = sample(place).value;
        faded[static_cast<std::size_t>(k)] = sample(place, spacing).value;
      },
      256);
  const auto mean = [](const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / count;
  };
  const auto lost = static_cast<float>(mean(whole) - mean(faded));
  std::sort(whole.begin(), whole.end());
  return {{whole[tail], whole[count - 1 - tail]}, lost};
}

std::vector<float> octave_means(const Fractal& f) {
  std::vector<float> means;
  double before = 0;
  for (int octaves = 1; octaves <= f.octaves; ++octaves) {
    Fractal part = f;
    part.octaves = octaves;
    const FractalSampler sample(part, probe_seed);
    double sum = 0;
    for (int k = 0; k < probes; ++k) sum += static_cast<double>(sample(probe_place(k)).value);
    means.push_back(static_cast<float>((sum - before) / probes));
    before = sum;
  }
  return means;
}

std::uint32_t fractal_seed(std::uint64_t seed) {
  return static_cast<std::uint32_t>(mix_bits(seed) >> 32U);
}

DVec2 fractal_offset(std::uint64_t seed) {
  const auto coordinate = [&](int axis) {
    return 4096 *
           (2 * uniform_double(random_bits(seed, hash_text(std::string_view("offset")), axis)) - 1);
  };
  return {coordinate(0), coordinate(1)};
}

Heightfield fractal_ground(const Heightfield& input, const Fractal& f, const FractalShape& shape,
                           const TerrainContext& context) {
  Heightfield out{Grid<float>(input.height.width(), input.height.height()), input.origin,
                  input.cell};
  const double size = static_cast<double>(shape.feature_size);
  fill_fractal(out.height, f, input.origin / size + fractal_offset(context.seed), input.cell / size,
               fractal_seed(context.seed), context.progress);
  const auto [range, lost] = fractal_statistics(f, static_cast<float>(input.cell / size));
  const float low = range.low - lost;
  const float scale = shape.height / std::max(1e-6F, range.high - range.low);
  parallel_for(
      0, out.height.height(),
      [&](int j) {
        for (float& h : out.height.row(j)) h = shape.base + scale * (h - low);
      },
      16);
  return out;
}

Grid<float> irregular(const Heightfield& input, float feature_size, int octaves, std::uint64_t seed,
                      Progress& progress) {
  Grid<float> out(input.height.width(), input.height.height());
  const Fractal f{.octaves = octaves};
  const double size = static_cast<double>(feature_size);
  fill_fractal(out, f, input.origin / size + fractal_offset(seed), input.cell / size,
               fractal_seed(seed), progress);
  return out;
}

}  // namespace wold
