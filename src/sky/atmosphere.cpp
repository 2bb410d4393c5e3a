#include "sky/atmosphere.hpp"

#include <algorithm>
#include <cmath>

#include "sky/phase_functions.hpp"

namespace wold {

namespace {

constexpr float ozone_middle = 25000;      // m
constexpr float ozone_half_width = 15000;  // m
constexpr float sun_radius = 0.00463F;     // radians

Vec3 exponential(Vec3 v) {
  return {std::exp(v.x), std::exp(v.y), std::exp(v.z)};
}

/// (1 - e^-x) / x, from x and e^-x.
float faded_share(float x, float passed) {
  return x < 1e-3F ? 1 - 0.5F * x : (1 - passed) / x;
}

float exponential_density(float height, float scale) {
  return std::exp(-std::clamp(height / scale, -8.0F, 80.0F));
}

/// Mean density between two heights, as if height changed evenly, from the densities at both ends.
float mean_density(float at_low, float at_high, float rise) {
  if (std::abs(rise) < 1e-2F || !(at_low != at_high)) return 0.5F * (at_low + at_high);
  return (at_low - at_high) / rise;
}

float exponential_mean(float from, float to, float scale) {
  const float a = std::clamp(from / scale, -8.0F, 80.0F);
  const float b = std::clamp(to / scale, -8.0F, 80.0F);
  return mean_density(std::exp(-a), std::exp(-b), b - a);
}

float ozone_density(float height) {
  return std::max(0.0F, 1 - std::abs(height - ozone_middle) / ozone_half_width);
}

/// s of the sphere `height_of` metres above the ground along the ray: near and far, if it meets it.
struct Crossing {
  bool meets = false;
  float near_distance = 0;
  float far_distance = 0;
};
Crossing crossing(const Atmosphere& a, float height, float cosine, float shell) {
  const float r = a.planet_radius + height;
  const float b = r * cosine;
  const float c = (height - shell) * (r + a.planet_radius + shell);
  const float discriminant = b * b - c;
  if (discriminant < 0) return {};
  const float root = std::sqrt(discriminant);
  // Without differences of like numbers: the product of the two solutions is c.
  const float q = b > 0 ? -b - root : -b + root;
  const float other = q == 0 ? 0 : c / q;
  return {true, std::min(q, other), std::max(q, other)};
}

}  // namespace

Description<Atmosphere> describe(const Atmosphere&) {
  return Description<Atmosphere>("atmosphere", "The air of model \"atmosphere\".")
      .choice("air", &Atmosphere::air, {"rec709", "popular", "penndorf"},
              "Scattering by air: as the colours of the display see it, or at 680, 550, 440 nm the "
              "figures most programs use, or those measured.")
      .add("ozone", &Atmosphere::ozone, {.unit = "Dobson units", .min = 0, .max = 2000},
           "Ozone, which keeps the zenith blue at dusk.")
      .add("aerosol_forward", &Atmosphere::aerosol_forward, {.min = -0.95, .max = 0.95},
           "How much haze scatters straight on: the mean cosine of its phase function.")
      .add("aerosol_albedo", &Atmosphere::aerosol_albedo, {.min = 0.01, .max = 1},
           "Share of the light that haze scatters of what it takes; the rest it absorbs.");
}

DVec3 wavelengths(AirCoefficients set) {
  return set == AirCoefficients::rec709 ? DVec3{644, 545, 443} : DVec3{680, 550, 440};
}

Vec3 air_scattering(AirCoefficients set) {
  if (set == AirCoefficients::rec709) return {5.93e-6F, 11.81e-6F, 28.02e-6F};
  return set == AirCoefficients::popular ? Vec3{5.8e-6F, 13.5e-6F, 33.1e-6F}
                                         : Vec3{4.91e-6F, 11.62e-6F, 28.99e-6F};
}

double rayleigh_scattering(double wavelength) {
  constexpr double molecules = 2.5474e25;  // 1/m³
  constexpr double depolarisation = 0.035;
  constexpr double king = (6 + 3 * depolarisation) / (6 - 7 * depolarisation);
  const double waves = std::pow(1000 / wavelength, 2);  // 1/µm²
  const double n = 1 + 1e-8 * (6432.8 + 2949810 / (146 - waves) + 25540 / (41 - waves));
  const double metres = wavelength * 1e-9;
  return 8 * std::pow(pi_d, 3) * std::pow(n * n - 1, 2) / (3 * molecules * std::pow(metres, 4)) *
         king;
}

Vec3 ozone_absorption(const Atmosphere& a) {
  const Vec3 usual = a.air == AirCoefficients::rec709 ? Vec3{2.51e-6F, 1.78e-6F, 0}
                                                      : Vec3{0.650e-6F, 1.881e-6F, 0.085e-6F};
  return usual * (a.ozone / 300);
}

AirColumn air_density(const Atmosphere& a, float height) {
  return {exponential_density(height, a.air_height), exponential_density(height, a.aerosol_height),
          ozone_density(height)};
}

Vec3 optical_depth(const Atmosphere& a, AirColumn column) {
  return air_scattering(a.air) * column.x + a.aerosol_scattering * (column.y / a.aerosol_albedo) +
         ozone_absorption(a) * column.z;
}

AirRay air_ray(const Atmosphere& a, Vec3 origin, Vec3 direction, Vec3 sun) {
  const float across_2 = origin.x * origin.x + origin.y * origin.y;
  const float below = a.planet_radius + origin.z;
  const float r = std::sqrt(below * below + across_2);
  const Vec3 up = Vec3{origin.x, origin.y, below} / r;
  return {origin.z + across_2 / (r + below), glm::dot(up, direction), glm::dot(up, sun),
          glm::dot(direction, sun)};
}

float height_after(const Atmosphere& a, float height, float cosine, float distance) {
  const float r = a.planet_radius + height;
  const float d = distance * (distance + 2 * r * cosine);
  return height + d / (r + std::sqrt(std::max(r * r + d, 0.0F)));
}

float sun_cosine_after(const Atmosphere& a, const AirRay& ray, float distance) {
  const float r = a.planet_radius + ray.height;
  const float there = a.planet_radius + height_after(a, ray.height, ray.cosine, distance);
  return std::clamp((r * ray.sun_cosine + distance * ray.to_sun) / there, -1.0F, 1.0F);
}

float distance_to_space(const Atmosphere& a, float height, float cosine) {
  return std::max(0.0F, crossing(a, height, cosine, a.air_thickness).far_distance);
}

AirSpan span_in_air(const Atmosphere& a, float height, float cosine) {
  const Crossing top = crossing(a, height, cosine, a.air_thickness);
  if (!top.meets || top.far_distance <= 0) return {};
  AirSpan span{std::max(0.0F, top.near_distance), top.far_distance, false};
  const Crossing ground = crossing(a, std::max(height, 0.0F), cosine, 0);
  if (ground.meets && cosine < 0) {
    span.end = std::max(ground.near_distance, span.begin);
    span.ground = true;
  }
  return span;
}

AirSpan span_in_layer(const Atmosphere& a, float height, float cosine, float low, float high) {
  const Crossing top = crossing(a, height, cosine, high);
  if (!top.meets || top.far_distance <= 0) return {};
  AirSpan span{std::max(0.0F, top.near_distance), top.far_distance, false};
  const Crossing base = crossing(a, height, cosine, low);
  if (!base.meets || base.far_distance <= 0) return span;
  if (height < low) {
    const Crossing ground = crossing(a, std::max(height, 0.0F), cosine, 0);
    if (ground.meets && cosine < 0) return {};
    span.begin = base.far_distance;
  } else {
    span.end = std::max(span.begin, base.near_distance);
  }
  return span;
}

AirColumn air_column(const Atmosphere& a, float height, float cosine, float begin, float end,
                     int steps) {
  AirColumn sum(0);
  float from = begin;
  float low = height_after(a, height, cosine, from);
  for (int k = 0; k < steps; ++k) {
    const float part = static_cast<float>(k + 1) / static_cast<float>(steps);
    const float to = begin + (end - begin) * part * part;
    const float high = height_after(a, height, cosine, to);
    sum += AirColumn{exponential_mean(low, high, a.air_height),
                     exponential_mean(low, high, a.aerosol_height),
                     0.5F * (ozone_density(low) + ozone_density(high))} *
           (to - from);
    from = to;
    low = high;
  }
  return sum;
}

Vec3 transmittance(const Atmosphere& a, float height, float cosine, float distance, int steps) {
  const AirSpan span = span_in_air(a, height, cosine);
  const float end = std::min(distance, span.end);
  if (!(end > span.begin)) return Vec3(1);
  return exponential(-optical_depth(a, air_column(a, height, cosine, span.begin, end, steps)));
}

float sun_above_edge(const Atmosphere& a, float height, float sun_cosine) {
  const float sine = a.planet_radius / (a.planet_radius + std::max(height, 0.0F));
  const float edge = -std::sqrt(std::max(0.0F, 1 - sine * sine));
  const float x = std::clamp((sun_cosine - edge) / (sine * sun_radius), -1.0F, 1.0F);
  return 0.5F + x * (0.75F - 0.25F * x * x);
}

Vec3 sun_transmittance(const Atmosphere& a, float height, float sun_cosine, int steps) {
  const float seen = sun_above_edge(a, height, sun_cosine);
  if (!(seen > 0)) return Vec3(0);
  const Crossing top = crossing(a, height, sun_cosine, a.air_thickness);
  if (!top.meets || top.far_distance <= 0) return Vec3(seen);
  const float begin = std::max(0.0F, top.near_distance);
  return seen * exponential(-optical_depth(
                    a, air_column(a, height, sun_cosine, begin, top.far_distance, steps)));
}

void add_stretch(const Atmosphere& a, AirColumn column, const LightInAir& light,
                 ScatteredSums& sums) {
  const Vec3 depth = optical_depth(a, column);
  const Vec3 passed = exponential(-depth);
  const Vec3 share =
      sums.transmittance * Vec3{faded_share(depth.x, passed.x), faded_share(depth.y, passed.y),
                                faded_share(depth.z, passed.z)};
  const Vec3 air = share * air_scattering(a.air) * column.x;
  const Vec3 aerosol = share * a.aerosol_scattering * column.y;
  sums.by_air += air * light.sun;
  sums.by_aerosol += aerosol * light.sun;
  sums.multiple += (air + aerosol) * light.multiple;
  sums.transmittance *= passed;
}

AirLight with_phases(const Atmosphere& a, const ScatteredSums& sums, float to_sun,
                     Vec3 sun_illuminance) {
  return {
      sums.transmittance,
      sun_illuminance * (sums.by_air * rayleigh_phase(to_sun) +
                         sums.by_aerosol * mie_phase(to_sun, a.aerosol_forward) + sums.multiple)};
}

AirLight single_scattering(const Atmosphere& a, const AirRay& ray, float distance,
                           Vec3 sun_illuminance, int steps, int light_steps) {
  const auto light_at = [&](float height, float sun_cosine) {
    return LightInAir{sun_transmittance(a, height, sun_cosine, light_steps), Vec3(0)};
  };
  return with_phases(a, march(a, ray, distance, steps, light_at), ray.to_sun, sun_illuminance);
}

}  // namespace wold
