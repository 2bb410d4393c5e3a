#include "sky/spectrum.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

double lobe(double wavelength, double centre, double width_below, double width_above) {
  const double t = (wavelength - centre) / (wavelength < centre ? width_below : width_above);
  return std::exp(-0.5 * t * t);
}

}  // namespace

DVec3 cie_observer(double wavelength) {
  return {
      1.056 * lobe(wavelength, 599.8, 37.9, 31.0) + 0.362 * lobe(wavelength, 442.0, 16.0, 26.7) -
          0.065 * lobe(wavelength, 501.1, 20.4, 26.2),
      0.821 * lobe(wavelength, 568.8, 46.9, 40.5) + 0.286 * lobe(wavelength, 530.9, 16.3, 31.1),
      1.217 * lobe(wavelength, 437.0, 11.8, 36.0) + 0.681 * lobe(wavelength, 459.0, 26.0, 13.8)};
}

DVec3 rec709_from_xyz(DVec3 c) {
  return {3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z,
          -0.9692660 * c.x + 1.8760108 * c.y + 0.0415560 * c.z,
          0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z};
}

double luminance(DVec3 rgb) {
  return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

DVec3 in_gamut(DVec3 rgb) {
  const double grey = luminance(rgb);
  if (!(grey > 0)) return DVec3(0);
  const double lowest = std::min({rgb.x, rgb.y, rgb.z});
  if (lowest >= 0) return rgb;
  const double keep = grey / (grey - lowest);
  return glm::max(DVec3(grey) + keep * (rgb - DVec3(grey)), DVec3(0));
}

DVec3 xyz_from_chromaticity(double x, double y, double luminance) {
  return {x / y * luminance, luminance, (1 - x - y) / y * luminance};
}

}  // namespace wold
