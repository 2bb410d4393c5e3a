#include "sky/preetham.hpp"

#include <algorithm>
#include <cmath>

#include "sky/spectrum.hpp"

namespace wold {

namespace {

SkyColour zenith_colour(double t, double s) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  const double chi = (4.0 / 9.0 - t / 120.0) * (pi_d - 2 * s);
  SkyColour zenith;
  zenith.luminance = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  zenith.x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
             t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
             (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
  zenith.y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
             t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
             (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
  return zenith;
}

}  // namespace

double PreethamSky::Perez::operator()(double cos_theta, double gamma) const {
  // At the horizon e^(B / cos θ) has gone to 0, as B is negative.
  const double cos_gamma = std::cos(gamma);
  return (1 + a * std::exp(b / std::max(cos_theta, 1e-4))) *
         (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
}

PreethamSky::PreethamSky(double t, double sun_zenith)
    : luminance_{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                 0.1206 * t - 2.5771, -0.0670 * t + 0.3703},
      x_{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
         -0.0033 * t + 0.0452},
      y_{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
         -0.0109 * t + 0.0529} {
  const double s = std::clamp(sun_zenith, 0.0, pi_d / 2);
  zenith_ = zenith_colour(t, s);
  at_zenith_ = {luminance_(1, s), x_(1, s), y_(1, s)};
}

SkyColour PreethamSky::colour(double cos_theta, double gamma) const {
  return {zenith_.luminance * luminance_(cos_theta, gamma) / at_zenith_.luminance,
          zenith_.x * x_(cos_theta, gamma) / at_zenith_.x,
          zenith_.y * y_(cos_theta, gamma) / at_zenith_.y};
}

DVec3 PreethamSky::radiance(double cos_theta, double gamma) const {
  const SkyColour c = colour(cos_theta, gamma);
  const double x = std::clamp(c.x, 0.05, 0.7);
  const double daylight = -3 * x * x + 2.87 * x - 0.275;
  const double y = std::clamp(std::max(c.y, daylight), 0.05, 0.8);
  const double luminance_cd = 1000 * std::max(c.luminance, 0.0);
  return in_gamut(rec709_from_xyz(xyz_from_chromaticity(x, y, luminance_cd)));
}

}  // namespace wold
