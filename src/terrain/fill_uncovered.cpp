#include <algorithm>

#include "base/parallel.hpp"
#include "terrain/mesh_field.hpp"

namespace wold {

namespace {

/// A grid with samples that are known and others to be found.
struct Level {
  Grid<float> height;
  Grid<std::uint8_t> known;
};

bool all_known(const Grid<std::uint8_t>& known) {
  return std::find(known.values().begin(), known.values().end(), 0) == known.values().end();
}

/// Every second sample: the mean of the known ones among the nine around it.
Level coarser(const Level& fine) {
  const int width = (fine.height.width() - 1) / 2 + 1;
  const int height = (fine.height.height() - 1) / 2 + 1;
  Level coarse{Grid<float>(width, height), Grid<std::uint8_t>(width, height)};
  parallel_for(0, height, [&](int j) {
    for (int i = 0; i < width; ++i) {
      float sum = 0;
      int count = 0;
      for (int b = std::max(0, 2 * j - 1); b <= std::min(2 * j + 1, fine.height.height() - 1); ++b)
        for (int a = std::max(0, 2 * i - 1); a <= std::min(2 * i + 1, fine.height.width() - 1); ++a)
          if (fine.known(a, b) != 0) {
            sum += fine.height(a, b);
            ++count;
          }
      coarse.known(i, j) = count > 0 ? 1 : 0;
      if (count > 0) coarse.height(i, j) = sum / static_cast<float>(count);
    }
  });
  return coarse;
}

/// A first guess of the unknown: between the samples of the coarser grid, bilinearly.
void guess(Level& fine, const Grid<float>& coarse) {
  parallel_for(0, fine.height.height(), [&](int j) {
    for (int i = 0; i < fine.height.width(); ++i) {
      if (fine.known(i, j) != 0) continue;
      const int i0 = i / 2;
      const int j0 = j / 2;
      const int i1 = i0 + i % 2;
      const int j1 = j0 + j % 2;
      fine.height(i, j) = 0.25F * ((coarse.clamped(i0, j0) + coarse.clamped(i1, j0)) +
                                   (coarse.clamped(i0, j1) + coarse.clamped(i1, j1)));
    }
  });
}

/// Jacobi's iteration: each unknown becomes the mean of its four neighbours; the border mirrors.
void relax(Level& level, Progress& progress) {
  constexpr int iterations = 24;
  Grid<float> next = level.height;
  for (int n = 0; n < iterations; ++n) {
    const Grid<float>& h = level.height;
    parallel_for(
        0, h.height(),
        [&](int j) {
          for (int i = 0; i < h.width(); ++i)
            if (level.known(i, j) == 0)
              next(i, j) = 0.25F * ((h.clamped(i - 1, j) + h.clamped(i + 1, j)) +
                                    (h.clamped(i, j - 1) + h.clamped(i, j + 1)));
          progress.check();
        },
        16);
    std::swap(level.height, next);
  }
}

}  // namespace

void fill_uncovered(Grid<float>& height, const Grid<std::uint8_t>& covered, Progress& progress) {
  if (all_known(covered)) return;
  std::vector<Level> levels;
  levels.push_back({height, covered});
  while (!all_known(levels.back().known) && levels.back().height.size() > 1)
    levels.push_back(coarser(levels.back()));
  for (std::size_t k = levels.size() - 1; k-- > 0;) {
    guess(levels[k], levels[k + 1].height);
    relax(levels[k], progress);
  }
  height = std::move(levels.front().height);
}

}  // namespace wold
