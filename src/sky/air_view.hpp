#pragma once
// The air with the sun of one moment: the sky from one height, and the air between an eye and what
// it looks at (aerial perspective).
//
// The sky is marched (atmosphere.hpp). Between surfaces the light is looked up by height, for a sun
// that stands everywhere as it does over the origin, and integrated over a few stretches whose
// columns of air are exact (the planet's curvature among them). Left out: shadows in the air.

#include <vector>

#include "sky/sunlit_air.hpp"

namespace wold {

class AirView {
 public:
  /// `sun_illuminance` outside the air, lx; `eye_height` in m, up to far out in space.
  AirView(const Atmosphere& atmosphere, Vec3 sun_direction, Vec3 sun_illuminance, float eye_height);

  /// What is seen in one direction: the air, and the ground through it (cd/m²).
  struct Seen {
    ScatteredSums air;
    Vec3 ground{0};
  };
  /// In directions of one elevation (radians), at even angles from the side of the sun to the
  /// opposite one.
  std::vector<Seen> around(double elevation) const;
  /// Radiance in a direction of that elevation, cd/m².
  Vec3 sky(const std::vector<Seen>& around, Vec3 direction) const;

  /// The air on `distance` metres (may be infinite) from `origin` (world, m) along the unit vector
  /// `direction`.
  AirLight between(Vec3 origin, Vec3 direction, float distance) const;
  /// Light at heights that grow from 0 to the top of the air with the square of the index, times
  /// the sun's illuminance outside: what `between` looks up.
  const std::vector<LightInAir>& light_by_height() const { return heights_; }

 private:
  Vec3 ground_radiance(float sun_cosine) const;
  void fill_sky_on_ground();
  void fill_heights();
  LightInAir light_at(float height) const;

  SunlitAir air_;
  Vec3 sun_direction_;
  Vec3 sun_illuminance_;
  float eye_height_;
  Vec3 sky_on_ground_{0};  // irradiance by the sky where the sun stands as over the eye, lx
  std::vector<LightInAir> heights_;
};

}  // namespace wold
