#include "view/pilot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

constexpr double acceleration_time = 0.18;  // s, τ of the velocity
constexpr double following_time = 0.12;     // s, τ of the eyes over the ground
constexpr double boost = 6;
constexpr double steepest = radians(89.0);
constexpr double least_speed = 0.5;
constexpr double greatest_speed = 2000;
constexpr double greatest_walking_speed = 20;
constexpr double speed_per_notch = 1.25;
constexpr double view_per_notch = 0.92;
constexpr double narrowest = 5;      // degrees
constexpr double widest = 120;       // degrees
constexpr double longest_frame = 1;  // s; what took longer was no flight

double ground_height(const PilotWorld& world, const DVec3& place) {
  return world.ground ? static_cast<double>(world.ground(DVec2(place))) : -1e30;
}

Pilot at_scene_camera(const Pilot& pilot, int index, const PilotWorld& world) {
  if (index < 0 || static_cast<std::size_t>(index) >= world.cameras.size()) return pilot;
  Pilot there = pilot_at(world.cameras[static_cast<std::size_t>(index)], world);
  there.camera = index;
  there.walking_speed = pilot.walking_speed;
  return there;
}

Pilot gone_to_camera(const Pilot& pilot, const Controls& controls, const PilotWorld& world) {
  if (controls.pressed.has(Action::home)) return at_scene_camera(pilot, pilot.camera, world);
  for (int k = 0; k < 9; ++k)
    if (controls.pressed.has(static_cast<Action>(static_cast<int>(Action::camera_1) + k)))
      return at_scene_camera(pilot, k, world);
  return pilot;
}

/// The point in the middle of the picture follows the mouse: of a picture that is 2 tan(fov/2)
/// wide at distance 1.
void turn(Pilot& pilot, Vec2 look) {
  const double angle = 2 * std::tan(radians(pilot.field_of_view) / 2);
  pilot.yaw = std::remainder(pilot.yaw + angle * static_cast<double>(look.x), 2 * pi_d);
  pilot.pitch = std::clamp(pilot.pitch - angle * static_cast<double>(look.y), -steepest, steepest);
}

void turn_wheel(Pilot& pilot, const Controls& controls) {
  const auto notches = static_cast<double>(controls.wheel);
  if (notches == 0) return;
  if (controls.held.has(Action::zoom)) {
    pilot.field_of_view =
        std::clamp(pilot.field_of_view * std::pow(view_per_notch, notches), narrowest, widest);
    return;
  }
  double& speed = pilot.walking ? pilot.walking_speed : pilot.speed;
  speed = std::clamp(speed * std::pow(speed_per_notch, notches), least_speed,
                     pilot.walking ? greatest_walking_speed : greatest_speed);
}

DVec3 wanted_velocity(const Pilot& pilot, const ActionSet& held) {
  const auto axis = [&](Action plus, Action minus) {
    return (held.has(plus) ? 1.0 : 0.0) - (held.has(minus) ? 1.0 : 0.0);
  };
  const DVec3 forward = direction_of(pilot.yaw, pilot.walking ? 0 : pilot.pitch);
  const DVec3 right = direction_of(pilot.yaw + pi_d / 2, 0);
  DVec3 way =
      axis(Action::forward, Action::backward) * forward + axis(Action::right, Action::left) * right;
  if (!pilot.walking) way.z += axis(Action::up, Action::down);
  const double length = glm::length(way);
  if (length < 1e-9) return DVec3(0);
  double speed = pilot.walking ? pilot.walking_speed : pilot.speed;
  if (held.has(Action::faster)) speed *= boost;
  if (held.has(Action::slower)) speed /= boost;
  return way * (speed / length);
}

/// The exact solution at the head of the header.
void move(Pilot& pilot, const DVec3& wanted, double seconds) {
  const double left = std::exp(-seconds / acceleration_time);
  const DVec3 lag = pilot.velocity - wanted;
  pilot.position += wanted * seconds + lag * (acceleration_time * (1 - left));
  pilot.velocity = wanted + lag * left;
  if (glm::length(pilot.velocity) < 1e-6) pilot.velocity = DVec3(0);
}

void stay_above_ground(Pilot& pilot, double seconds, const PilotWorld& world) {
  if (!world.ground) return;
  const double ground = ground_height(world, pilot.position);
  if (pilot.walking) {
    const double eyes = ground + eye_height;
    pilot.position.z = eyes + (pilot.position.z - eyes) * std::exp(-seconds / following_time);
    pilot.velocity.z = 0;
  }
  const double least = ground + least_height;
  if (pilot.position.z >= least) return;
  pilot.position.z = least;
  pilot.velocity.z = std::max(pilot.velocity.z, 0.0);
}

}  // namespace

DVec3 direction_of(double yaw, double pitch) {
  return {std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch), std::sin(pitch)};
}

Pilot pilot_at(const Camera& camera, const PilotWorld& world) {
  Pilot pilot;
  pilot.position = DVec3(camera.position);
  const DVec3 direction = glm::normalize(DVec3(camera.direction));
  pilot.yaw = std::atan2(direction.x, direction.y);
  pilot.pitch = std::clamp(std::asin(std::clamp(direction.z, -1.0, 1.0)), -steepest, steepest);
  pilot.field_of_view = static_cast<double>(camera.field_of_view);
  pilot.aperture = camera.aperture;
  pilot.focus = camera.focus;
  const double height = pilot.position.z - ground_height(world, pilot.position);
  if (world.ground) pilot.speed = std::clamp(2 * height, 5.0, 500.0);
  return pilot;
}

Pilot flown(const Pilot& before, const Controls& controls, const PilotWorld& world) {
  Pilot pilot = gone_to_camera(before, controls, world);
  const double seconds = std::clamp(controls.seconds, 0.0, longest_frame);
  if (controls.pressed.has(Action::walk)) pilot.walking = !pilot.walking && world.ground;
  turn_wheel(pilot, controls);
  turn(pilot, controls.look);
  const DVec3 wanted = wanted_velocity(pilot, controls.held);
  if (wanted == DVec3(0) && pilot.velocity == DVec3(0) && !pilot.walking) return pilot;
  move(pilot, wanted, seconds);
  stay_above_ground(pilot, seconds, world);
  return pilot;
}

Camera camera_of(const Pilot& pilot) {
  Camera camera;
  camera.position = Vec3(pilot.position);
  camera.direction = Vec3(direction_of(pilot.yaw, pilot.pitch));
  camera.field_of_view = static_cast<float>(pilot.field_of_view);
  camera.aperture = pilot.aperture;
  camera.focus = pilot.focus;
  return camera;
}

std::string camera_toml(const Camera& camera, std::string_view name) {
  const Vec3& p = camera.position;
  const Vec3& d = camera.direction;
  std::string text = fmt::format(
      "[[camera]]\nname = \"{}\"\nposition = [{:.2f}, {:.2f}, {:.2f}]\n"
      "look_direction = [{:.5f}, {:.5f}, {:.5f}]\nfield_of_view = {:.4g}\n",
      name, p.x, p.y, p.z, d.x, d.y, d.z, camera.field_of_view);
  if (camera.aperture > 0)
    text += fmt::format("aperture = {}\nfocus = {}\n", camera.aperture, camera.focus);
  return text;
}

}  // namespace wold
