#include "sky/haze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace wold {

namespace {

constexpr float molecules_scale = 8000;  // m
/// Scattering by molecules at 680, 550, 440 nm, 1/m.
constexpr Vec3 molecules_at_zero{5.8e-6F, 13.5e-6F, 33.1e-6F};

/// How strongly extinction falls with wavelength (Kruse, McGlauchlin, McQuistan 1962).
double kruse_exponent(double visibility) {
  const double km = visibility / 1000;
  if (km < 6) return 0.585 * std::cbrt(km);
  return km < 50 ? 1.3 : 1.6;
}

/// ∫ e^(-(h + s z) / H) ds over s in [0, distance], m; z is the rise per metre.
float air_on_path(float h, float z, float distance, float scale_height) {
  const float start = std::exp(-std::clamp(h / scale_height, -8.0F, 80.0F));
  const float rise = z / scale_height;
  if (std::abs(rise) * distance < 1e-4F || rise == 0) return start * distance;
  return start * -std::expm1(-std::max(rise * distance, -40.0F)) / rise;
}

}  // namespace

Vec3 aerosol_extinction(double visibility, DVec3 wavelengths) {
  if (!(visibility > 0))
    throw Error(ErrorKind::input,
                fmt::format("visibility ({} m) must be greater than 0", visibility));
  const double at_550 =
      std::max(0.0, 3.912 / visibility - static_cast<double>(molecules_at_zero.y));
  const double q = kruse_exponent(visibility);
  return at_550 * DVec3(std::pow(wavelengths.x / 550, -q), std::pow(wavelengths.y / 550, -q),
                        std::pow(wavelengths.z / 550, -q));
}

Haze::Haze(double visibility, double scale_height) : molecules_(molecules_at_zero), enabled_(true) {
  if (!(visibility > 0) || !(scale_height > 0))
    throw Error(ErrorKind::input,
                fmt::format("visibility ({} m) and haze height ({} m) must be greater than 0",
                            visibility, scale_height));
  aerosol_height_ = static_cast<float>(scale_height);
  aerosol_ = aerosol_extinction(visibility, {680, 550, 440});
}

float Haze::molecules_height() {
  return molecules_scale;
}

Vec3 Haze::transmittance(Vec3 origin, Vec3 direction, float distance) const {
  if (!enabled_ || !(distance > 0)) return Vec3(1);
  const float d = std::min(distance, 1e9F);
  const Vec3 depth = molecules_ * air_on_path(origin.z, direction.z, d, molecules_scale) +
                     aerosol_ * air_on_path(origin.z, direction.z, d, aerosol_height_);
  return {std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z)};
}

}  // namespace wold
