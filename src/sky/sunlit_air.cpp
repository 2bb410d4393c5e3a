#include "sky/sunlit_air.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace wold {

namespace {

constexpr int transmittance_columns = 128;
constexpr int transmittance_rows = 40;
constexpr int transmittance_steps = 40;
constexpr int multiple_columns = 40;
constexpr int multiple_rows = 14;
constexpr int cosines = 8;   // directions of a mean
constexpr int azimuths = 4;  // over half a turn: the other half is its mirror
constexpr int multiple_steps = 16;

/// Bilinear, from coordinates in [0, 1].
Vec3 looked_up(const Grid<Vec3>& grid, float u, float v) {
  const float x = std::clamp(u, 0.0F, 1.0F) * static_cast<float>(grid.width() - 1);
  const float y = std::clamp(v, 0.0F, 1.0F) * static_cast<float>(grid.height() - 1);
  const int i = std::min(static_cast<int>(x), grid.width() - 2);
  const int j = std::min(static_cast<int>(y), grid.height() - 2);
  const float along = x - static_cast<float>(i);
  const float up = y - static_cast<float>(j);
  return glm::mix(glm::mix(grid(i, j), grid(i + 1, j), along),
                  glm::mix(grid(i, j + 1), grid(i + 1, j + 1), along), up);
}

float node(int index, int count) {
  return static_cast<float>(index) / static_cast<float>(count - 1);
}

/// Distances along the horizontal from the ground to the edge of space, and from a height to the
/// horizon.
float horizon_distance(const Atmosphere& a, float height) {
  return std::sqrt(std::max(0.0F, height * (2 * a.planet_radius + height)));
}

}  // namespace

SunlitAir::SunlitAir(const Atmosphere& atmosphere) : atmosphere_(atmosphere) {
  fill_transmittance();
  fill_multiple();
}

void SunlitAir::fill_transmittance() {
  const Atmosphere& a = atmosphere_;
  transmittance_ = Grid<Vec3>(transmittance_columns, transmittance_rows);
  const float whole = horizon_distance(a, a.air_thickness);
  parallel_for(0, transmittance_rows, [&](int j) {
    const float rho = whole * node(j, transmittance_rows);
    const float height = rho * rho / (a.planet_radius + std::hypot(a.planet_radius, rho));
    const float nearest = a.air_thickness - height;
    const float farthest = rho + whole;
    const float r = a.planet_radius + height;
    for (int i = 0; i < transmittance_columns; ++i) {
      const float distance = nearest + (farthest - nearest) * node(i, transmittance_columns);
      const float top = nearest * (r + a.planet_radius + a.air_thickness);
      const float cosine =
          distance > 0 ? std::clamp((top - distance * distance) / (2 * r * distance), -1.0F, 1.0F)
                       : 1;
      const Vec3 depth =
          optical_depth(a, air_column(a, height, cosine, 0, distance, transmittance_steps));
      transmittance_(i, j) = {std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z)};
    }
  });
}

void SunlitAir::fill_multiple() {
  const Atmosphere& a = atmosphere_;
  Grid<Vec3> table(multiple_columns, multiple_rows);
  parallel_for(0, multiple_rows, [&](int j) {
    const float v = node(j, multiple_rows);
    for (int i = 0; i < multiple_columns; ++i) {
      const float s = 2 * node(i, multiple_columns) - 1;
      table(i, j) = multiple_at(a.air_thickness * v * v, std::copysign(s * s, s));
    }
  });
  multiple_ = std::move(table);
}

Vec3 SunlitAir::multiple_at(float height, float sun_cosine) const {
  const Atmosphere& a = atmosphere_;
  const float sun_sine = std::sqrt(std::max(0.0F, 1 - sun_cosine * sun_cosine));
  const auto light_at = [&](float h, float c) { return LightInAir{light(h, c).sun, Vec3(1)}; };
  Vec3 once(0);
  Vec3 handed_on(0);
  for (int k = 0; k < cosines * azimuths; ++k) {
    const float cosine = 1 - 2 * (static_cast<float>(k / azimuths) + 0.5F) / cosines;  // NOLINT
    const float turn = pi * (static_cast<float>(k % azimuths) + 0.5F) / azimuths;
    const float to_sun =
        cosine * sun_cosine + std::sqrt(1 - cosine * cosine) * sun_sine * std::cos(turn);
    const AirRay ray{height, cosine, sun_cosine, to_sun};
    const ScatteredSums sums = march(a, ray, INFINITY, multiple_steps, light_at);
    once += (sums.by_air + sums.by_aerosol) / (4 * pi);
    handed_on += sums.multiple;
    const AirSpan span = span_in_air(a, height, cosine);
    if (span.ground) {
      const float there = sun_cosine_after(a, ray, span.end);
      once +=
          sums.transmittance * a.ground_albedo / pi * light(0, there).sun * std::max(there, 0.0F);
    }
  }
  constexpr float count = cosines * azimuths;
  return once / count / (Vec3(1) - glm::min(handed_on / count, Vec3(0.99F)));
}

LightInAir SunlitAir::light(float height, float sun_cosine) const {
  const Atmosphere& a = atmosphere_;
  const float h = std::clamp(height, 0.0F, a.air_thickness);
  LightInAir light;
  const float seen = sun_above_edge(a, h, sun_cosine);
  if (seen > 0) {
    const float whole = horizon_distance(a, a.air_thickness);
    const float rho = horizon_distance(a, h);
    const float nearest = a.air_thickness - h;
    const float farthest = rho + whole;
    const float distance = distance_to_space(a, h, sun_cosine);
    light.sun =
        seen * looked_up(transmittance_, (distance - nearest) / (farthest - nearest), rho / whole);
  }
  if (!multiple_.empty()) {
    const float u = 0.5F + 0.5F * std::copysign(std::sqrt(std::abs(sun_cosine)), sun_cosine);
    light.multiple = looked_up(multiple_, u, std::sqrt(h / a.air_thickness));
  }
  return light;
}

ScatteredSums SunlitAir::seen(const AirRay& ray, float distance, int steps) const {
  return march(atmosphere_, ray, distance, steps,
               [&](float height, float sun_cosine) { return light(height, sun_cosine); });
}

}  // namespace wold
