#pragma once
// Aerial perspective: what the air between a surface and the eye takes away and adds.
//
//   L = L_surface · T + J · (1 - T)
//   T = exp(-Σ β · ∫ e^(-h(s) / H) ds)          per colour, over molecules and aerosol
//   J = L_sky(direction) / (1 - T_whole path)    the light that the air sends to the eye, by the
//                                                whole path up from height 0
//
// β are extinction coefficients at height 0, 1/m. Molecules: 5.8, 13.5, 33.1 e-6 /m at 680, 550,
// 440 nm with H = 8 km (Nishita et al. 1993). Aerosol: what is missing to the visibility V, since
// β(550 nm) = 3.912 / V (Koschmieder: 2 % contrast left), with colour λ^-q, q by Kruse et al. 1962.
// J is chosen so that what is infinitely far away looks exactly like the sky in that direction
// (the horizon in that direction, for one below it), so the edge of the world dissolves.
// Left out: shadows in the air, and change of J along the path.

#include "base/vec.hpp"

namespace wold {

/// Extinction by aerosol at height 0, 1/m, at three wavelengths in nm, for a visibility in metres.
/// Throws Error(input) if that is not > 0.
Vec3 aerosol_extinction(double visibility, DVec3 wavelengths);

class Haze {
 public:
  /// No haze at all.
  Haze() = default;
  /// `visibility` and `scale_height` (of the aerosol) in metres. Throws Error(input) if not > 0.
  Haze(double visibility, double scale_height);

  bool enabled() const { return enabled_; }
  /// Extinction at height 0, 1/m, and the heights over which it falls to 1/e, m.
  Vec3 molecules() const { return molecules_; }
  Vec3 aerosol() const { return aerosol_; }
  float aerosol_height() const { return aerosol_height_; }
  static float molecules_height();
  /// Part of the light that passes `distance` metres (may be infinite) from `origin` (m, world)
  /// along the unit vector `direction`; per colour, in [0, 1].
  Vec3 transmittance(Vec3 origin, Vec3 direction, float distance) const;

 private:
  Vec3 molecules_{0};  // 1/m
  Vec3 aerosol_{0};    // 1/m
  float aerosol_height_ = 1;
  bool enabled_ = false;
};

}  // namespace wold
