#pragma once
// A layer of clouds between two spheres around the planet, as a density and by ray marching.
//
//   density = eroded(shape), shape = (n - t - r v²) / s · base(v), in [0, 1]
//
// n is 3D fBm of six octaves of value noise, brought to [0, 1]; t the threshold that leaves the
// share `coverage` of the sky under clouds; v the height in the layer, from 0 to 1. Since the
// threshold grows with v² by r, clouds are domes on a flat base. Inverted Worley noise then cuts
// notches between round lumps, d' = (d - b w) / (1 - b w) with w the distance to the nearest point:
// A. Schneider, "The real-time volumetric cloudscapes of Horizon: Zero Dawn", SIGGRAPH 2015.
//
//   L = ∫ T(t) σs [p(cos θ) E T_sun(t) + J] dt      T = exp(-∫ (σs + σa) density)
//
// p is the double Henyey-Greenstein function; J, the sky's mean radiance, stands for the light from
// all around. σ in 1/m at density 1, E in lx, J in cd/m². More orders of scattering, without which
// clouds are grey, are a sum: the order i + 1 has 1/2^i of the light and of the depth towards the
// sun, and its phase function g / 2^i (Wrenninge, Kulla, Lundqvist, "Oz: the great and volumetric",
// SIGGRAPH 2013 talks). `orders` 1 is single scattering.
//
// For GLSL: the noise is that of noise/, octaves turned as in noise/fractal.hpp; places are east
// and north over a plane (m) and height, which is right within 100 km or so.

#include <cstdint>

#include "base/parameters.hpp"
#include "noise/fractal.hpp"
#include "sky/atmosphere.hpp"

namespace wold {

struct Clouds {
  float coverage = 0.5F;
  float height = 1500;        ///< m, of the base
  float thickness = 1200;     ///< m
  float feature_size = 2500;  ///< m
  float billows = 0.5F;       ///< b
  float scattering = 0.03F;   ///< 1/m
  float absorption = 0;       ///< 1/m
  float forward = 0.7F;       ///< g1
  float back = -0.5F;         ///< g2
  float back_share = 0.3F;    ///< f
  int orders = 4;             ///< of scattering
  std::uint32_t seed = 1;
};

Description<Clouds> describe(const Clouds&);

/// What the eye sees of clouds: L = behind · transmittance + light.
struct CloudLight {
  float transmittance = 1;
  Vec3 light{0};
};

struct CloudSteps {
  int along = 64;
  int to_sun = 12;
};

class CloudLayer {
 public:
  /// Throws Error(input) if a parameter is out of range.
  explicit CloudLayer(const Clouds& clouds);

  const Clouds& clouds() const { return clouds_; }
  /// In [0, 1], at a place (east and north, m) and height (m) over the planet's surface.
  float density(DVec2 place, float height) const;

  /// Of sunlight and of light from behind on `distance` metres of a ray through the layer.
  float transmittance(const Atmosphere& atmosphere, DVec2 place, const AirRay& ray, Vec3 direction,
                      float distance, int steps) const;

  /// Light of clouds along a ray from `place` and ray.height towards `direction` (world, unit), up
  /// to `distance`. `start` in [0, 1) shifts the samples within their steps: random by pixel, it
  /// turns bands into noise.
  CloudLight seen(const Atmosphere& atmosphere, DVec2 place, const AirRay& ray, Vec3 direction,
                  Vec3 sun_direction, float distance, Vec3 sun_illuminance, Vec3 sky_radiance,
                  float start, CloudSteps steps = {}) const;

 private:
  Clouds clouds_;
  FractalSampler shape_;
  std::uint32_t lumps_key_ = 0;
  float threshold_ = 0;
};

/// Distance to the nearest of one random point per cell of the integer lattice, at most 1.
float worley_distance(DVec3 p, std::uint32_t key);

}  // namespace wold
