#include "sky/sunlight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sky/spectrum.hpp"

namespace wold {

namespace {

constexpr int bands = 38;  // 380 to 750 nm
constexpr double first_wavelength = 380;
constexpr double wavelength_step = 10;
using Band = std::array<double, bands>;

/// Extraterrestrial radiance, 100 W/(m² sr nm).
constexpr Band sun = {165.5, 162.3, 211.2, 258.8, 258.2, 242.3, 267.6, 296.6, 305.4, 300.6,
                      306.6, 288.3, 287.1, 278.2, 271.0, 272.3, 263.6, 255.0, 250.6, 253.1,
                      253.5, 251.3, 246.3, 241.7, 236.8, 232.1, 228.2, 223.4, 219.7, 215.3,
                      211.0, 207.3, 202.4, 198.7, 194.3, 190.7, 186.3, 182.6};
/// Ozone, 1/cm.
constexpr Band ozone = {0,     0,     0,     0,     0,     0,     0,     0.003, 0.006, 0.009,
                        0.014, 0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120,
                        0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048,
                        0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};
/// Water vapour, 1/cm, from 690 nm.
constexpr std::array<double, 7> water = {0.016, 0.024, 0.0125, 1.0, 0.87, 0.061, 0.001};
constexpr int first_water_band = 31;

double air_mass(double zenith) {
  const double z = std::clamp(zenith, 0.0, 90.0);
  return 1 / (std::cos(radians(z)) + 0.15 * std::pow(93.885 - z, -1.253));
}

double transmittance(int band, double wavelength, double m, double turbidity) {
  const double micrometres = wavelength / 1000;
  const double beta = std::max(0.0, 0.04608 * turbidity - 0.04586);
  double depth = m * (0.008735 * std::pow(micrometres, -4.08) + beta * std::pow(micrometres, -1.3) +
                      0.35 * ozone[static_cast<std::size_t>(band)]);
  if (band >= first_water_band) {
    constexpr double water_cm = 2;
    const double k = water[static_cast<std::size_t>(band - first_water_band)] * water_cm * m;
    depth += 0.2385 * k / std::pow(1 + 20.07 * k, 0.45);
  }
  // The mixed gases absorb only beyond 759 nm, past the end of the table.
  return std::exp(-depth);
}

}  // namespace

DVec3 sun_disc_radiance(double zenith, double turbidity) {
  const double m = air_mass(zenith);
  DVec3 xyz(0);
  for (int band = 0; band < bands; ++band) {
    const double wavelength = first_wavelength + wavelength_step * band;
    const double passed = turbidity > 0 ? transmittance(band, wavelength, m, turbidity) : 1;
    xyz += cie_observer(wavelength) * (sun[static_cast<std::size_t>(band)] * 100 * passed);
  }
  return in_gamut(rec709_from_xyz(xyz * (luminous_efficacy * wavelength_step)));
}

DVec3 limb_darkening_exponent() {
  const auto exponent = [](double micrometres) { return -0.023 + 0.292 / micrometres; };
  return {exponent(0.612), exponent(0.549), exponent(0.464)};
}

}  // namespace wold
