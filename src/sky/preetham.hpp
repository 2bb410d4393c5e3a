#pragma once
// The clear sky of Preetham, Shirley, Smits, "A practical analytic model for daylight",
// SIGGRAPH 1999: luminance Y and chromaticity x, y, each by the formula of Perez et al. 1993,
//
//   F(θ, γ) = (1 + A e^(B / cos θ)) (1 + C e^(D γ) + E cos² γ)
//   value(θ, γ) = value_zenith · F(θ, γ) / F(0, θs)
//
// θ angle from the zenith, γ from the sun, θs zenith angle of the sun, radians; A to E linear in
// turbidity T, the zenith values polynomials in T and θs (appendix 2 of the paper). T is the ratio
// of the optical thickness of the hazy air to that of clean air: 2 very clear, 3 clear, 6 hazy.
//
// The fit was made for T from 2 to 6 and a sun well above the horizon. Outside: T below 1.9 would
// make luminance negative and is refused by the scene; a sun below the horizon counts as on it (who
// calls dims the sky as night falls); chromaticities are held to real colours.

#include "base/vec.hpp"

namespace wold {

/// Y in kcd/m², x and y of CIE 1931.
struct SkyColour {
  double luminance = 0;
  double x = 0;
  double y = 0;
};

class PreethamSky {
 public:
  /// `sun_zenith` in radians.
  PreethamSky(double turbidity, double sun_zenith);

  SkyColour zenith() const { return zenith_; }
  /// From the angle to the zenith (its cosine, taken as at least 0) and to the sun (radians).
  SkyColour colour(double cos_theta, double gamma) const;
  /// The same as linear Rec. 709, cd/m², never negative. Near the horizon the fit turns mauve:
  /// chromaticities below the locus of daylight, y = -3 x² + 2.87 x - 0.275 (Judd, MacAdam,
  /// Wyszecki 1964), are lifted to it.
  DVec3 radiance(double cos_theta, double gamma) const;

 private:
  struct Perez {
    double a, b, c, d, e;
    double operator()(double cos_theta, double gamma) const;
  };

  SkyColour zenith_;
  Perez luminance_;
  Perez x_;
  Perez y_;
  SkyColour at_zenith_;  // F(0, θs) of each
};

}  // namespace wold
