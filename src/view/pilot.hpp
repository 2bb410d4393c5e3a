#pragma once
// The viewer's flying camera: a pure function of its state, a frame of controls and the world.
//
// Yaw and pitch, no roll. The velocity v goes after the wanted one w exponentially,
//
//   v(t) = w + (v0 - w) e^(-t/τ)        x(t) = x0 + w t + (v0 - w) τ (1 - e^(-t/τ)),
//
// which is the exact solution of dv/dt = (w - v) / τ: while the keys stay as they are, one long
// frame and many short ones lead to the same place. Flying, the camera stays above the ground by a
// least height; walking, its eyes follow the ground at theirs.

#include <functional>
#include <span>

#include "render/camera.hpp"
#include "view/controls.hpp"

namespace wold {

struct Pilot {
  DVec3 position{0};          ///< m
  DVec3 velocity{0};          ///< m/s
  double yaw = 0;             ///< radians, from north by east
  double pitch = 0;           ///< radians, up positive, short of straight up and down
  double speed = 10;          ///< m/s, of flying
  double walking_speed = 2;   ///< m/s
  double field_of_view = 55;  ///< degrees, across the longer side
  bool walking = false;
  int camera = 0;      ///< of the scene, the last one gone to
  float aperture = 0;  ///< m, of that camera
  float focus = 50;    ///< m

  friend bool operator==(const Pilot&, const Pilot&) = default;
};

/// What the pilot knows of the world.
struct PilotWorld {
  std::function<float(DVec2)> ground;  ///< its height, m; may be empty: no ground
  std::span<const Camera> cameras;     ///< of the scene
};

inline constexpr double eye_height = 1.8;    ///< m, walking
inline constexpr double least_height = 0.5;  ///< m, flying

/// A pilot at a camera, with a speed that suits its height above ground.
Pilot pilot_at(const Camera& camera, const PilotWorld& world);

/// The pilot after a frame.
Pilot flown(const Pilot& pilot, const Controls& controls, const PilotWorld& world);

/// What the pilot sees. `direction` and `up` without roll.
Camera camera_of(const Pilot& pilot);

/// Unit vector of yaw and pitch.
DVec3 direction_of(double yaw, double pitch);

/// "[[camera]]\nposition = …": the camera as a section of a scene file.
std::string camera_toml(const Camera& camera, std::string_view name);

}  // namespace wold
