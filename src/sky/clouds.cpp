#include "sky/clouds.hpp"

#include <algorithm>
#include <cmath>

#include "base/smoothstep.hpp"
#include "noise/lattice.hpp"
#include "sky/phase_functions.hpp"

namespace wold {

namespace {

constexpr float noise_spread = 0.166F;  // standard deviation of n
constexpr float softness = 0.16F;       // s
constexpr float doming = 0.3F;          // r
constexpr float base_share = 0.07F;     // of the layer over which the base fades in
constexpr double lumps_per_feature = 7;
constexpr double fine_lumps = 2.3;  // times finer
constexpr float fine_share = 0.35F;

const Fractal cloud_noise{.kind = FractalKind::fbm, .basis = NoiseBasis::value, .octaves = 6};

/// The value that the share `q` of a standard normal distribution exceeds (Tukey's lambda).
float normal_threshold(float q) {
  return (std::pow(1 - q, 0.135F) - std::pow(q, 0.135F)) / 0.1975F;
}

/// Phase functions of all orders times the sunlight they get, of which `lit` is the first's.
float scattered(const Clouds& c, float to_sun, float lit) {
  float sum = 0;
  float share = 1;
  for (int k = 0; k < c.orders; ++k, share *= 0.5F)
    sum += share * std::pow(lit, share) *
           double_henyey_greenstein(to_sun, share * c.forward, share * c.back, c.back_share);
  return sum;
}

AirRay ray_after(const Atmosphere& a, const AirRay& ray, float distance) {
  const float height = height_after(a, ray.height, ray.cosine, distance);
  return {height, 0, sun_cosine_after(a, ray, distance), ray.to_sun};
}

}  // namespace

Description<Clouds> describe(const Clouds&) {
  return Description<Clouds>("clouds", "A layer of clouds.")
      .add("cloud_coverage", &Clouds::coverage, {.min = 0, .max = 1},
           "Share of the sky under clouds.")
      .add("cloud_height", &Clouds::height, {.unit = "m", .min = 0, .max = 20000},
           "Height of the base.")
      .add("cloud_thickness", &Clouds::thickness, {.unit = "m", .min = 1, .max = 20000},
           "From the base to the highest tops.")
      .add("cloud_feature_size", &Clouds::feature_size, {.unit = "m", .min = 1, .max = 1e6},
           "From cloud to cloud.")
      .add("cloud_billows", &Clouds::billows, {.min = 0, .max = 0.95},
           "Depth of the notches in clouds.")
      .add("cloud_scattering", &Clouds::scattering, {.unit = "per m", .min = 0, .max = 10},
           "Light scattered where clouds are densest.")
      .add("cloud_absorption", &Clouds::absorption, {.unit = "per m", .min = 0, .max = 10},
           "Light absorbed there.")
      .add("cloud_forward", &Clouds::forward, {.min = 0, .max = 0.99},
           "Mean cosine of the light that goes on.")
      .add("cloud_back", &Clouds::back, {.min = -0.99, .max = 0},
           "Mean cosine of the light that turns back.")
      .add("cloud_back_share", &Clouds::back_share, {.min = 0, .max = 1},
           "Share of the light that turns back.")
      .add("cloud_orders", &Clouds::orders, {.min = 1, .max = 8},
           "How often light is scattered in clouds; 1 leaves them grey.")
      .add("cloud_seed", &Clouds::seed, {.min = 0, .max = 4294967295.0}, "Where clouds stand.");
}

float worley_distance(DVec3 p, std::uint32_t key) {
  const DVec3 corner(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const Vec3 within(p - corner);
  const auto cell = [](double x) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(x));
  };
  float nearest = 1;
  for (int k = -1; k <= 1; ++k) {
    const std::uint32_t plane = lattice_line(cell(corner.z) + static_cast<std::uint32_t>(k), key);
    for (int j = -1; j <= 1; ++j) {
      const std::uint32_t row = lattice_line(cell(corner.y) + static_cast<std::uint32_t>(j), plane);
      for (int i = -1; i <= 1; ++i) {
        const std::uint32_t h = lattice_hash(cell(corner.x) + static_cast<std::uint32_t>(i), row);
        const Vec3 point =
            Vec3{i, j, k} + Vec3{h & 1023U, (h >> 10U) & 1023U, (h >> 20U) & 1023U} / 1024.0F;
        const Vec3 offset = point - within;
        nearest = std::min(nearest, glm::dot(offset, offset));
      }
    }
  }
  return std::sqrt(nearest);
}

CloudLayer::CloudLayer(const Clouds& clouds)
    : clouds_(clouds), shape_(cloud_noise, clouds.seed), lumps_key_(lattice_key(~clouds.seed)) {
  describe(clouds).parameters().check(&clouds);
  // A column is covered if it is at any height: more often than a single point.
  threshold_ = 0.5F + noise_spread * normal_threshold(std::pow(clouds.coverage, 1.35F));
}

float CloudLayer::density(DVec2 place, float height) const {
  const float v = (height - clouds_.height) / clouds_.thickness;
  if (!(v > 0 && v < 1)) return 0;
  const DVec3 p =
      DVec3{place, static_cast<double>(height)} / static_cast<double>(clouds_.feature_size);
  const float n = 0.5F + 0.5F * shape_(p).value;
  const float shape = (n - threshold_ - doming * v * v) / softness;
  if (!(shape > 0)) return 0;
  const float d =
      std::min(shape, 1.0F) * smoothstep(0.0F, base_share, v) * (1 - smoothstep(0.9F, 1.0F, v));
  if (clouds_.billows == 0) return d;
  const DVec3 lumps = p * lumps_per_feature;
  const float notch =
      clouds_.billows * ((1 - fine_share) * worley_distance(lumps, lumps_key_) +
                         fine_share * worley_distance(lumps * fine_lumps, lumps_key_));
  return std::max(0.0F, (d - notch) / (1 - notch));
}

float CloudLayer::transmittance(const Atmosphere& a, DVec2 place, const AirRay& ray, Vec3 direction,
                                float distance, int steps) const {
  const AirSpan span =
      span_in_layer(a, ray.height, ray.cosine, clouds_.height, clouds_.height + clouds_.thickness);
  const float length = std::min(distance, span.end) - span.begin;
  if (!(length > 0)) return 1;
  float sum = 0;
  float from = span.begin;
  for (int k = 0; k < steps; ++k) {
    const float part = static_cast<float>(k + 1) / static_cast<float>(steps);
    const float to = span.begin + length * part * part;
    const float s = 0.5F * (from + to);
    sum += (to - from) * density(place + static_cast<double>(s) * DVec2(direction.x, direction.y),
                                 height_after(a, ray.height, ray.cosine, s));
    from = to;
  }
  return std::exp(-(clouds_.scattering + clouds_.absorption) * sum);
}

CloudLight CloudLayer::seen(const Atmosphere& a, DVec2 place, const AirRay& ray, Vec3 direction,
                            Vec3 sun_direction, float distance, Vec3 sun_illuminance,
                            Vec3 sky_radiance, float start, CloudSteps steps) const {
  CloudLight result;
  const AirSpan span =
      span_in_layer(a, ray.height, ray.cosine, clouds_.height, clouds_.height + clouds_.thickness);
  const float length = std::min(distance, span.end) - span.begin;
  const float extinction = clouds_.scattering + clouds_.absorption;
  if (!(length > 0) || !(extinction > 0)) return result;
  const float step = length / static_cast<float>(steps.along);
  for (int k = 0; k < steps.along && result.transmittance > 1e-3F; ++k) {
    const float s = span.begin + (static_cast<float>(k) + start) * step;
    const AirRay here = ray_after(a, ray, s);
    const DVec2 at = place + static_cast<double>(s) * DVec2(direction.x, direction.y);
    const float dense = density(at, here.height);
    if (!(dense > 0)) continue;
    const AirRay sunward{here.height, here.sun_cosine, here.sun_cosine, 1};
    const float lit = transmittance(a, at, sunward, sun_direction, INFINITY, steps.to_sun);
    const float passed = std::exp(-extinction * dense * step);
    const Vec3 source = (scattered(clouds_, ray.to_sun, lit) * sun_illuminance + sky_radiance) *
                        (clouds_.scattering / extinction);
    result.light += result.transmittance * (1 - passed) * source;
    result.transmittance *= passed;
  }
  return result;
}

}  // namespace wold
