#pragma once
// Light of the sun that reaches the ground: spectrum above the air times the transmittances of
// appendix 1 of Preetham, Shirley, Smits 1999 (after Iqbal 1983), λ in µm, m relative air mass:
//
//   Rayleigh     e^(-0.008735 λ^-4.08 m)
//   aerosol      e^(-β λ^-1.3 m),  β = 0.04608 T - 0.04586 (Ångström's coefficient by turbidity)
//   ozone        e^(-k_o 0.35 m)                                     0.35 cm of ozone
//   mixed gases  e^(-1.41 k_g m / (1 + 118.93 k_g m)^0.45)
//   water        e^(-0.2385 k_w 2 m / (1 + 20.07 k_w 2 m)^0.45)      2 cm of water
//   m = 1 / (cos θ + 0.15 (93.885 - θ°)^-1.253)
//
// The paper's table of the sun is a mean radiance of the disc in units of 100 W/(m² sr nm).

#include "base/vec.hpp"

namespace wold {

/// Mean radiance of the sun's disc, linear Rec. 709 in cd/m², never negative. `zenith` in degrees;
/// below the horizon as on it. With `turbidity` 0 there is no air at all.
DVec3 sun_disc_radiance(double zenith, double turbidity);

/// Exponent α of limb darkening I(μ) / I(1) = μ^α, μ the cosine between the line of sight and the
/// normal of the sun's surface, at red, green and blue: Hestroffer, Magnan, "Wavelength dependency
/// of the solar limb darkening", A&A 333, 1998. The mean over the disc is 2 / (α + 2).
DVec3 limb_darkening_exponent();

}  // namespace wold
