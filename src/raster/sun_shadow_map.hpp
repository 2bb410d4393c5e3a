#pragma once
// Where the land throws its own shadow, further than shadow maps reach: over the scene's field and,
// more coarsely, over all around it.
//
// Between which heights the sun rises over every place: a sample of height h at the horizontal
// distance x towards the sun hides, at elevation e and with the sun's angular radius r,
//
//   all of it below        max over x of h(x) - x tan(e + r)
//   and something below    max over x of h(x) - x tan(e - r)
//
// Both are carried from row to row away from the sun, exactly along rays that run with the light a
// sample apart, and looked up between two of these. Between the two heights
// the share that is seen goes by a smooth step, near the disc's own curve. As it is a matter of
// height, it holds for trees and the flanks of detail too.

#include "render/ground.hpp"

namespace wold {

/// Half the angle at which the sun is seen, radians.
inline constexpr float sun_radius = 0.00465F;

/// Heights of land at most so many samples wide, as the fields and the surroundings' square.
struct ShadeLand {
  Heightfield field;
  Heightfield around;  ///< with the field in it; empty where there are no surroundings
};
ShadeLand shade_land(const Ground& ground, int most_field, int most_around);

class SunShadowMap {
 public:
  explicit SunShadowMap(const Ground& ground, int most_field = 1025, int most_around = 1025);

  /// Works the shadows out for a sun in this (unit) direction.
  void set_sun(Vec3 towards_sun, float radius = sun_radius);
  /// Part of the sun seen from a place, past the land.
  float share(Vec3 place) const;

  /// Heights where the sun begins to rise and where it has risen.
  struct Layer {
    Grid<Vec2> edges;
    DVec2 origin{0};
    double cell = 1;
  };
  const Layer& field() const { return field_; }
  const Layer& around() const { return around_; }

 private:
  ShadeLand land_;
  Layer field_;
  Layer around_;
};

}  // namespace wold
