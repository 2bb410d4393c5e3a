#include "raster/sky_visibility.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"

namespace wold {

namespace {

constexpr int directions = 16;
// Of the samples of heights that horizons are looked for in, to those of the visibility.
constexpr int land_samples = 2;

/// Half as many samples, each with half of its neighbours' in it.
Heightfield coarser(const Heightfield& fine) {
  const Grid<float>& g = fine.height;
  const auto half = [](int n) { return (n + 2) / 2; };
  Heightfield out{Grid<float>(half(g.width()), half(g.height())), fine.origin, 2 * fine.cell};
  parallel_for(0, out.height.height(), [&](int j) {
    for (int i = 0; i < out.height.width(); ++i) {
      float sum = 0;
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di)
          sum += static_cast<float>((2 - std::abs(di)) * (2 - std::abs(dj))) *
                 g.clamped(2 * i + di, 2 * j + dj);
      out.height(i, j) = sum / 16;
    }
  });
  return out;
}

using Pyramid = std::vector<Heightfield>;

Pyramid pyramid(Heightfield finest) {
  Pyramid levels;
  levels.push_back(std::move(finest));
  while (std::min(levels.back().height.width(), levels.back().height.height()) > 8)
    levels.push_back(coarser(levels.back()));
  return levels;
}

/// The land to look for horizons in.
class Land {
 public:
  explicit Land(ShadeLand land) : field_(pyramid(std::move(land.field))) {
    if (!land.around.height.empty()) around_ = pyramid(std::move(land.around));
  }

  /// As even as `width` metres; false outside.
  bool height(DVec2 place, double width, float& out) const {
    if (on(field_, place, width, out)) return true;
    return !around_.empty() && on(around_, place, width, out);
  }

 private:
  static bool on(const Pyramid& levels, DVec2 place, double width, float& out) {
    if (!levels.front().contains(place)) return false;
    std::size_t k = 0;
    while (k + 1 < levels.size() && levels[k].cell < width) ++k;
    out = height_at(levels[k], place);
    return true;
  }

  Pyramid field_;
  Pyramid around_;
};

/// Cosine-weighted light from above the horizon of slope `rise`, for the normal's parts across and
/// up.
float light_above(float rise, float across, float up) {
  const float cosine2 = 1 / (1 + rise * rise);
  return 0.5F * (up * cosine2 + across * (0.5F * pi - std::atan(rise) - rise * cosine2));
}

float visibility(const Land& land, DVec2 place, double cell) {
  float here = 0;
  land.height(place, 0, here);
  const auto beside = [&](DVec2 offset) {
    float h = here;
    land.height(place + offset, 0, h);
    return h;
  };
  const auto width = static_cast<float>(2 * cell);
  const Vec2 gradient((beside({cell, 0}) - beside({-cell, 0})) / width,
                      (beside({0, cell}) - beside({0, -cell})) / width);
  const Vec3 normal = normal_of(gradient);
  float seen = 0;
  float open = 0;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * pi_d * (k + 0.5) / directions;
    const DVec2 d(std::cos(angle), std::sin(angle));
    const float own = std::max(0.0F, glm::dot(gradient, Vec2(d)));
    float rise = own;
    float h = 0;
    for (double x = cell; land.height(place + x * d, 0.06 * x, h); x *= 1.25)
      rise = std::max(rise, (h - here) / static_cast<float>(x));
    const float across = glm::dot(Vec2(normal), Vec2(d));
    seen += light_above(rise, across, normal.z);
    open += light_above(own, across, normal.z);
  }
  return open > 0 ? std::clamp(seen / open, 0.0F, 1.0F) : 1;
}

Heightfield visibilities(const Land& land, DVec2 low, DVec2 size, int most) {
  Heightfield out;
  out.origin = low;
  out.cell = std::max(size.x, size.y) / (most - 1);
  const auto samples = [&](double length) {
    return std::max(2, static_cast<int>(std::ceil(length / out.cell - 1e-6)) + 1);
  };
  out.height = Grid<float>(samples(size.x), samples(size.y));
  parallel_for(0, out.height.height(), [&](int j) {
    for (int i = 0; i < out.height.width(); ++i) {
      const DVec2 place = glm::min(low + out.cell * DVec2(i, j), low + size);
      out.height(i, j) = visibility(land, place, out.cell);
    }
  });
  return out;
}

}  // namespace

SkyVisibility::SkyVisibility(const Ground& ground, int most_samples) {
  const int most = land_samples * (most_samples - 1) + 1;
  const Land land(shade_land(ground, most, most));
  const Heightfield& field = ground.field();
  field_ = visibilities(land, field.origin, field.size(), most_samples);
  if (!ground.surroundings().height.empty())
    around_ = visibilities(land, ground.low(), ground.high() - ground.low(), most_samples);
}

float SkyVisibility::share(DVec2 place) const {
  if (field_.contains(place)) return height_at(field_, place);
  return !around_.height.empty() && around_.contains(place) ? height_at(around_, place) : 1.0F;
}

}  // namespace wold
