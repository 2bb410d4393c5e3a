#pragma once
// Light that a march along one ray does not find, as small GLSL tables over the sun's height: of
// the sky on level ground, and scattered more than once in the air (sky/sunlit_air.hpp).

#include <string>

#include "sky/sky.hpp"

namespace wold {

/// The air of these settings.
Atmosphere shader_air(const SkySettings& settings);

/// Illuminance by the sun outside the air, klx.
Vec3 sun_outside(const SkySettings& settings);

/// GLSL of `vec3 sky_on_ground(float sun_sine)` (per illuminance by the sun outside the air) and
/// `vec3 multiple_scattering(float height, float sun_sine)` (1/sr).
std::string light_tables(const SkySettings& settings);

}  // namespace wold
