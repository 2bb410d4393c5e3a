#pragma once
// Sunlight at every place in the air, as tables: what gets there straight from the sun, and what
// gets there scattered twice or more.
//
//   Ψ = L₂ / (1 - f)
//   L₂  mean over all directions of the light scattered once (evenly) or reflected by the ground
//   f   mean over all directions of ∫ T σs ds: the part of even light that the air hands on
//
// The series 1 + f + f² + … is all orders, taken as even in all directions and as alike around a
// place: Hillaire, "A scalable and production ready sky and atmosphere rendering technique", EGSR
// 2020, section 5.5. The table of transmittance has the coordinates of Bruneton, Neyret,
// "Precomputed atmospheric scattering", EGSR 2008, which are finest at the horizon.
// Light is per illuminance by the sun outside the air.

#include "base/grid.hpp"
#include "sky/atmosphere.hpp"

namespace wold {

class SunlitAir {
 public:
  explicit SunlitAir(const Atmosphere& atmosphere);

  const Atmosphere& atmosphere() const { return atmosphere_; }
  /// Sunlight, and Ψ in 1/sr, at a height (m, up to the top of the air) and cosine of the sun to
  /// the zenith there.
  LightInAir light(float height, float sun_cosine) const;
  /// Light seen along a ray, up to `distance`.
  ScatteredSums seen(const AirRay& ray, float distance, int steps) const;

  /// Nodes of the tables, for textures: transmittance to space in columns by the distance to it and
  /// rows by the distance to the horizon; Ψ in columns by cosine of the sun and rows by height.
  const Grid<Vec3>& transmittance_table() const { return transmittance_; }
  const Grid<Vec3>& multiple_table() const { return multiple_; }

 private:
  void fill_transmittance();
  void fill_multiple();
  Vec3 multiple_at(float height, float sun_cosine) const;

  Atmosphere atmosphere_;
  Grid<Vec3> transmittance_;
  Grid<Vec3> multiple_;
};

}  // namespace wold
