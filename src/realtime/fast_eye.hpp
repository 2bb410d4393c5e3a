#pragma once
// The eye of the landscape as the processor knows it: what has to be drawn anew follows from how it
// moved.

#include <optional>

#include "base/vec.hpp"
#include "realtime/landscape_settings.hpp"
#include "render/camera.hpp"

namespace wold {

/// Where the eye is, but for its height in a flight, which the shader knows.
struct LandscapeEye {
  DVec2 place{0};                ///< m from the terrain's middle
  std::optional<Camera> camera;  ///< none in a flight
  float time = 0;                ///< s
};

/// Twin of sun_direction (landscape/light.glsl).
Vec3 sun_at(const LandscapeSettings& settings, float time);
LandscapeEye eye_of_flight(const LandscapeSettings& settings, float time);

/// Whether what is seen at `b` has little to do with what was seen at `a`.
bool is_cut(const LandscapeEye& a, const LandscapeEye& b);
/// Whether both see from one place in one direction.
bool stands(const LandscapeEye& a, const LandscapeEye& b);

}  // namespace wold
