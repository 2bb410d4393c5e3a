#pragma once
// Phase functions: how likely light that is scattered turns by the angle θ, per steradian.
//
//   isotropic           p = 1 / 4π
//   Rayleigh            p = 3/(16π) (1 + cos² θ)
//   Cornette-Shanks     p = 3/(8π) (1 - g²)(1 + cos² θ) / ((2 + g²)(1 + g² - 2g cos θ)^1.5)
//   Henyey-Greenstein   p = 1/(4π) (1 - g²) / (1 + g² - 2g cos θ)^1.5
//   double HG           p = (1 - f) HG(g1) + f HG(g2)
//   Schlick             p = 1/(4π) (1 - k²) / (1 - k cos θ)²,  k = 1.55 g - 0.55 g³
//
// cos θ is between the directions in which light travels before and after: 1 straight on. For the
// eye's ray and the direction towards the sun it is their scalar product. g in (-1, 1) is the mean
// of cos θ for HG (for Cornette-Shanks 3g(4 + g²) / (5(2 + g²))); light goes on for g > 0, back for
// g < 0. Each integrates to 1 over the sphere.
//
// Rayleigh: molecules, much smaller than the wavelength. Cornette, Shanks, "Physically reasonable
// analytic expression for the single-scattering phase function", Applied Optics 31, 1992: aerosol
// (often called Mie; becomes Rayleigh's for g = 0). Henyey, Greenstein 1941: clouds. Schlick's
// needs no power; his k was fitted to HG (Blasi, Le Saëc, Schlick 1993), but passes 1 for g above
// 0.94, where p would be negative: here it is held to ±0.999.

#include "base/vec.hpp"

namespace wold {

float isotropic_phase();
float rayleigh_phase(float cosine);
float mie_phase(float cosine, float g);
float henyey_greenstein(float cosine, float g);
float double_henyey_greenstein(float cosine, float g1, float g2, float f);
float schlick_phase(float cosine, float k);
/// The k that brings Schlick's function nearest to HG with this g.
float schlick_k(float g);

/// cos θ distributed as Henyey-Greenstein's function; `u` uniform in [0, 1).
float sample_henyey_greenstein(float g, float u);

}  // namespace wold
