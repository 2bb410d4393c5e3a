#include "sky/air_view.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

constexpr int sky_steps = 32;
constexpr int side_angles = 33;  // nodes from the sun's side to the opposite one
constexpr int height_nodes = 128;
constexpr float stretch_length = 4000;  // m
constexpr int most_stretches = 8;
constexpr int dome_rings = 12;  // directions for the light of the sky on the ground
constexpr int dome_angles = 8;

Vec3 largest(Vec3 a, float b) {
  return glm::max(a, Vec3(b));
}

AirView::Seen mixed(const AirView::Seen& a, const AirView::Seen& b, float t) {
  return {{glm::mix(a.air.transmittance, b.air.transmittance, t),
           glm::mix(a.air.by_air, b.air.by_air, t), glm::mix(a.air.by_aerosol, b.air.by_aerosol, t),
           glm::mix(a.air.multiple, b.air.multiple, t)},
          glm::mix(a.ground, b.ground, t)};
}

/// Angle between the directions of two vectors over the ground, radians.
float side_angle(Vec3 a, Vec3 b) {
  const float across = std::abs(a.x * b.y - a.y * b.x);
  return across > 0 ? std::atan2(across, a.x * b.x + a.y * b.y) : 0;
}

}  // namespace

AirView::AirView(const Atmosphere& atmosphere, Vec3 sun_direction, Vec3 sun_illuminance,
                 float eye_height)
    : air_(atmosphere),
      sun_direction_(sun_direction),
      sun_illuminance_(sun_illuminance),
      eye_height_(eye_height) {
  fill_sky_on_ground();
  fill_heights();
}

void AirView::fill_sky_on_ground() {
  const Atmosphere& a = air_.atmosphere();
  const float sun_sine = std::sqrt(std::max(0.0F, 1 - sun_direction_.z * sun_direction_.z));
  for (int k = 0; k < dome_rings * dome_angles; ++k) {
    const int ring = k / dome_angles;
    const float cosine = std::sqrt((static_cast<float>(ring) + 0.5F) / dome_rings);
    const float turn = pi * (static_cast<float>(k % dome_angles) + 0.5F) / dome_angles;
    const float to_sun =
        cosine * sun_direction_.z + std::sqrt(1 - cosine * cosine) * sun_sine * std::cos(turn);
    const AirRay up{0, cosine, sun_direction_.z, to_sun};
    sky_on_ground_ +=
        with_phases(a, air_.seen(up, INFINITY, sky_steps), to_sun, sun_illuminance_).light;
  }
  sky_on_ground_ *= pi / (dome_rings * dome_angles);
}

void AirView::fill_heights() {
  heights_.resize(height_nodes);
  const float top = air_.atmosphere().air_thickness;
  for (int k = 0; k < height_nodes; ++k) {
    const float v = static_cast<float>(k) / (height_nodes - 1);
    LightInAir light = air_.light(top * v * v, sun_direction_.z);
    light.sun *= sun_illuminance_;
    light.multiple *= sun_illuminance_;
    heights_[static_cast<std::size_t>(k)] = light;
  }
}

LightInAir AirView::light_at(float height) const {
  const float v = std::clamp(height / air_.atmosphere().air_thickness, 0.0F, 1.0F);
  const float x = std::sqrt(v) * (height_nodes - 1);
  const int k = std::min(static_cast<int>(x), height_nodes - 2);
  const float t = x - static_cast<float>(k);
  const LightInAir& low = heights_[static_cast<std::size_t>(k)];
  const LightInAir& high = heights_[static_cast<std::size_t>(k) + 1];
  return {glm::mix(low.sun, high.sun, t), glm::mix(low.multiple, high.multiple, t)};
}

/// Elsewhere on the planet the sky's light goes with Ψ.
Vec3 AirView::ground_radiance(float sun_cosine) const {
  const LightInAir here = air_.light(0, sun_direction_.z);
  const LightInAir there = air_.light(0, sun_cosine);
  const Vec3 sky = sky_on_ground_ * there.multiple / largest(here.multiple, 1e-12F);
  return air_.atmosphere().ground_albedo / pi *
         (sky + sun_illuminance_ * there.sun * std::max(sun_cosine, 0.0F));
}

std::vector<AirView::Seen> AirView::around(double elevation) const {
  const Atmosphere& a = air_.atmosphere();
  const float cosine = static_cast<float>(std::sin(elevation));
  const float sun_sine = std::sqrt(std::max(0.0F, 1 - sun_direction_.z * sun_direction_.z));
  const AirSpan span = span_in_air(a, eye_height_, cosine);
  std::vector<Seen> nodes(side_angles);
  for (int k = 0; k < side_angles; ++k) {
    const float turn = pi * static_cast<float>(k) / (side_angles - 1);
    const float to_sun = cosine * sun_direction_.z +
                         std::sqrt(std::max(0.0F, 1 - cosine * cosine)) * sun_sine * std::cos(turn);
    const AirRay ray{eye_height_, cosine, sun_direction_.z, to_sun};
    Seen& seen = nodes[static_cast<std::size_t>(k)];
    seen.air = air_.seen(ray, INFINITY, sky_steps);
    if (span.ground)
      seen.ground = seen.air.transmittance * ground_radiance(sun_cosine_after(a, ray, span.end));
  }
  return nodes;
}

Vec3 AirView::sky(const std::vector<Seen>& around, Vec3 direction) const {
  const float x = side_angle(direction, sun_direction_) / pi * (side_angles - 1);
  const int k = std::clamp(static_cast<int>(x), 0, side_angles - 2);
  const Seen seen = mixed(around[static_cast<std::size_t>(k)],
                          around[static_cast<std::size_t>(k) + 1], x - static_cast<float>(k));
  return with_phases(air_.atmosphere(), seen.air, glm::dot(direction, sun_direction_),
                     sun_illuminance_)
             .light +
         seen.ground;
}

AirLight AirView::between(Vec3 origin, Vec3 direction, float distance) const {
  if (!(distance > 0)) return {};
  const Atmosphere& a = air_.atmosphere();
  const AirRay ray = air_ray(a, origin, direction, sun_direction_);
  const AirSpan span = span_in_air(a, ray.height, ray.cosine);
  // Terrain may lie below the planet's surface.
  const float end = std::isinf(distance) ? span.end : std::min(distance, 2 * a.planet_radius);
  const int stretches = 1 + std::min(static_cast<int>(end / stretch_length), most_stretches - 1);
  ScatteredSums sums;
  float from = 0;
  for (int k = 0; k < stretches; ++k) {
    const float part = static_cast<float>(k + 1) / static_cast<float>(stretches);
    const float to = end * part * part;
    const float middle = height_after(a, ray.height, ray.cosine, 0.5F * (from + to));
    add_stretch(a, air_column(a, ray.height, ray.cosine, from, to, 1), light_at(middle), sums);
    from = to;
  }
  return with_phases(a, sums, ray.to_sun, Vec3(1));
}

}  // namespace wold
