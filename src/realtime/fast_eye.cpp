#include "realtime/fast_eye.hpp"

#include <cmath>

namespace wold {

namespace {
constexpr float leap = 300;          // m
constexpr float far_turn = 0.9F;     // cosine
constexpr float longest_pause = 10;  // s
}  // namespace

Vec3 sun_at(const LandscapeSettings& s, float time) {
  const float elevation = radians(s.sun_elevation);
  const float azimuth = radians(s.sun_azimuth);
  const Vec3 sun(std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
                 std::sin(elevation));
  const float turn = radians(s.day_speed) * time;
  const Vec3 axis(0, std::sqrt(0.5F), std::sqrt(0.5F));
  return std::cos(turn) * sun - std::sin(turn) * glm::cross(axis, sun) +
         (1 - std::cos(turn)) * glm::dot(axis, sun) * axis;
}

LandscapeEye eye_of_flight(const LandscapeSettings& s, float time) {
  const double azimuth = radians(double{s.cam_direction});
  const double flown = double{s.cam_speed} * static_cast<double>(time);
  return {{s.cam_east + flown * std::sin(azimuth), s.cam_north + flown * std::cos(azimuth)},
          std::nullopt,
          time};
}

bool is_cut(const LandscapeEye& a, const LandscapeEye& b) {
  if (a.camera.has_value() != b.camera.has_value()) return true;
  if (glm::distance(a.place, b.place) > leap) return true;
  if (b.time < a.time || b.time - a.time > longest_pause) return true;
  if (!a.camera) return false;
  return std::abs(a.camera->position.z - b.camera->position.z) > leap ||
         glm::dot(glm::normalize(a.camera->direction), glm::normalize(b.camera->direction)) <
             far_turn;
}

bool stands(const LandscapeEye& a, const LandscapeEye& b) {
  if (a.place != b.place || a.camera.has_value() != b.camera.has_value()) return false;
  return !a.camera ||
         (a.camera->position == b.camera->position && a.camera->direction == b.camera->direction &&
          a.camera->up == b.camera->up && a.camera->field_of_view == b.camera->field_of_view);
}

}  // namespace wold
