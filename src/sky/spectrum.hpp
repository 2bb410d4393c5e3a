#pragma once
// From spectra to colours: CIE 1931 observer and linear Rec. 709.

#include "base/vec.hpp"

namespace wold {

inline constexpr double luminous_efficacy = 683;  ///< lm/W at 555 nm

/// Colour matching functions at a wavelength in nm: the multi-lobe fit of Wyman, Sloan, Shirley,
/// "Simple analytic approximations to the CIE XYZ color matching functions", JCGT 2(2), 2013;
/// within 1 % of the peak.
DVec3 cie_observer(double wavelength);

/// Linear Rec. 709 from CIE XYZ, white D65. May have negative parts: see `in_gamut`.
DVec3 rec709_from_xyz(DVec3 xyz);
/// Luminance of linear Rec. 709.
double luminance(DVec3 rgb);

/// The nearest colour of the same luminance without negative parts: mixed with grey as far as is
/// needed. Black when there is no luminance.
DVec3 in_gamut(DVec3 rgb);

/// From chromaticity and luminance; y must be positive.
DVec3 xyz_from_chromaticity(double x, double y, double luminance);

}  // namespace wold
