#include "erosion/thermal_rungs.hpp"

#include <algorithm>
#include <array>

#include "base/parallel.hpp"

namespace wold {

namespace {

using Heights = Grid<std::int32_t>;

constexpr int least_rung = 20;

std::int64_t loose(const SlideGround& ground, int i, int j) {
  return std::int64_t{ground.surface(i, j)} - ground.bed(i, j);
}

Heights halved(const Heights& in) {
  Heights out(in.width() / 2, in.height() / 2);
  parallel_for(0, out.height(), [&](int j) {
    for (int i = 0; i < out.width(); ++i) {
      const std::int64_t sum = std::int64_t{in(2 * i, 2 * j)} + in(2 * i + 1, 2 * j) +
                               in(2 * i, 2 * j + 1) + in(2 * i + 1, 2 * j + 1);
      out(i, j) = static_cast<std::int32_t>((sum + 2) >> 2);
    }
  });
  return out;
}

/// The greatest of the 6 x 6 cells around, so that no change is laid over the hardest.
Grid<float> hardest(const Grid<float>& in) {
  Grid<float> out(in.width() / 2, in.height() / 2);
  parallel_for(0, out.height(), [&](int j) {
    for (int i = 0; i < out.width(); ++i) {
      float most = 0;
      for (int n = -2; n <= 3; ++n)
        for (int m = -2; m <= 3; ++m) most = std::max(most, in.clamped(2 * i + m, 2 * j + n));
      out(i, j) = most;
    }
  });
  return out;
}

/// Each value four times, then levelled across the borders of coarse cells of one sign: bilinear
/// interpolation whose sum is exact, and that leaves alone where nothing changed.
Heights spread(const Heights& coarse, int width, int height) {
  Heights along(2 * coarse.width(), coarse.height());
  const auto quarter = [](std::int32_t a, std::int32_t b) { return (b - a) / 4; };
  parallel_for(0, coarse.height(), [&](int j) {
    for (int i = 0; i < coarse.width(); ++i) {
      const std::int32_t here = coarse(i, j);
      along(2 * i, j) = here - quarter(coarse.clamped(i - 1, j), here);
      along(2 * i + 1, j) = here + quarter(here, coarse.clamped(i + 1, j));
    }
  });
  Heights out(width, height);
  parallel_for(0, coarse.height(), [&](int j) {
    for (int i = 0; i < along.width(); ++i) {
      const std::int32_t here = along(i, j);
      out(i, 2 * j) = here - quarter(along.clamped(i, j - 1), here);
      out(i, 2 * j + 1) = here + quarter(here, along.clamped(i, j + 1));
    }
  });
  return out;
}

template <class Function>
Heights map_heights(const Heights& shape, const Function& function) {
  Heights out(shape.width(), shape.height());
  parallel_for(0, out.height(), [&](int j) {
    for (int i = 0; i < out.width(); ++i) out(i, j) = function(i, j);
  });
  return out;
}

/// Takes `total`, which they have together, from four holdings in proportion to them; what rounding
/// leaves, from the first that have it.
void take(std::int64_t total, const std::array<std::int32_t*, 4>& held) {
  std::int64_t sum = 0;
  for (const std::int32_t* h : held) sum += *h;
  std::int64_t left = total;
  for (std::int32_t* h : held) {
    const std::int64_t part = sum > 0 ? *h * total / sum : 0;
    *h -= static_cast<std::int32_t>(part);
    left -= part;
  }
  for (std::int32_t* h : held) {
    const std::int64_t part = std::min<std::int64_t>(left, *h);
    *h -= static_cast<std::int32_t>(part);
    left -= part;
  }
}

void lay_over_layers(SlideGround& fine, const SlideGround& before, const SlideGround& after) {
  const Heights& shape = before.surface;
  const Heights wear =
      spread(map_heights(shape, [&](int i, int j) { return before.bed(i, j) - after.bed(i, j); }),
             fine.surface.width(), fine.surface.height());
  const auto gain_at = [&](int i, int j) {
    return after.surface(i, j) - after.bed(i, j) - before.surface(i, j) + before.bed(i, j);
  };
  const Heights gain =
      spread(map_heights(shape, [&](int i, int j) { return std::max(0, gain_at(i, j)); }),
             fine.surface.width(), fine.surface.height());
  // From here on `surface` holds the loose depth.
  parallel_for(0, fine.surface.height(), [&](int j) {
    for (int i = 0; i < fine.surface.width(); ++i) {
      fine.surface(i, j) -= fine.bed(i, j);
      fine.bed(i, j) -= wear(i, j);
    }
  });
  parallel_for(0, shape.height(), [&](int j) {
    for (int i = 0; i < shape.width(); ++i) {
      if (gain_at(i, j) >= 0) continue;
      take(-4 * std::int64_t{gain_at(i, j)},
           {&fine.surface(2 * i, 2 * j), &fine.surface(2 * i + 1, 2 * j),
            &fine.surface(2 * i, 2 * j + 1), &fine.surface(2 * i + 1, 2 * j + 1)});
    }
  });
  parallel_for(0, fine.surface.height(), [&](int j) {
    for (int i = 0; i < fine.surface.width(); ++i)
      fine.surface(i, j) += fine.bed(i, j) + gain(i, j);
  });
}

}  // namespace

bool has_coarser_rung(const SlideGround& ground) {
  return std::min(ground.surface.width(), ground.surface.height()) >= 2 * least_rung;
}

SlideGround coarser_rung(const SlideGround& ground) {
  SlideGround out;
  out.surface = halved(ground.surface);
  if (!ground.bed.empty()) {
    out.bed = out.surface;
    parallel_for(0, out.bed.height(), [&](int j) {
      for (int i = 0; i < out.bed.width(); ++i)
        out.bed(i, j) -= static_cast<std::int32_t>(
            (loose(ground, 2 * i, 2 * j) + loose(ground, 2 * i + 1, 2 * j) +
             loose(ground, 2 * i, 2 * j + 1) + loose(ground, 2 * i + 1, 2 * j + 1)) >>
            2);
    });
  }
  if (!ground.hardness.empty()) out.hardness = hardest(ground.hardness);
  out.unit = ground.unit;
  out.cell = 2 * ground.cell;
  return out;
}

void lay_over(SlideGround& fine, const SlideGround& before, const SlideGround& after) {
  if (!fine.bed.empty()) {
    lay_over_layers(fine, before, after);
    return;
  }
  const Heights change =
      spread(map_heights(before.surface,
                         [&](int i, int j) { return after.surface(i, j) - before.surface(i, j); }),
             fine.surface.width(), fine.surface.height());
  for (std::size_t k = 0; k < change.size(); ++k) fine.surface.values()[k] += change.values()[k];
}

}  // namespace wold
