#include "render/camera.hpp"

#include <cmath>

namespace wold {

Vec2 disc_sample(Vec2 u) {
  const Vec2 c = 2.0F * u - Vec2(1);
  if (c.x == 0 && c.y == 0) return Vec2(0);
  if (std::abs(c.x) > std::abs(c.y)) {
    const float angle = pi / 4 * (c.y / c.x);
    return c.x * Vec2(std::cos(angle), std::sin(angle));
  }
  const float angle = pi / 2 - pi / 4 * (c.x / c.y);
  return c.y * Vec2(std::cos(angle), std::sin(angle));
}

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : position_(camera.position),
      forward_(glm::normalize(camera.direction)),
      width_(width),
      height_(height),
      lens_radius_(camera.aperture / 2),
      focus_(camera.focus) {
  Vec3 right = glm::cross(forward_, camera.up);
  if (glm::length(right) < 1e-4F) right = glm::cross(forward_, Vec3(0, 1, 0));
  if (glm::length(right) < 1e-4F) right = glm::cross(forward_, Vec3(1, 0, 0));
  right_ = glm::normalize(right);
  down_ = glm::cross(forward_, right_);
  const float half = std::tan(radians(camera.field_of_view) / 2);
  const float longer = static_cast<float>(std::max(width, height));
  half_width_ = half * static_cast<float>(width) / longer;
  half_height_ = half * static_cast<float>(height) / longer;
  pixel_angle_ = 2 * half / longer;
}

Ray CameraRays::ray(Vec2 pixel, Vec2 lens) const {
  const float x = (2 * pixel.x / static_cast<float>(width_) - 1) * half_width_;
  const float y = (2 * pixel.y / static_cast<float>(height_) - 1) * half_height_;
  const Vec3 through = forward_ + x * right_ + y * down_;
  if (lens_radius_ <= 0) return {position_, glm::normalize(through)};
  const Vec2 d = disc_sample(lens) * lens_radius_;
  const Vec3 offset = d.x * right_ + d.y * down_;
  return {position_ + offset, glm::normalize(through * focus_ - offset)};
}

Vec3 CameraRays::project(Vec3 place) const {
  const Vec3 d = place - position_;
  const float depth = glm::dot(d, forward_);
  const float scale = 1 / std::max(depth, 1e-6F);
  const float x = glm::dot(d, right_) * scale / half_width_;
  const float y = glm::dot(d, down_) * scale / half_height_;
  return {(x + 1) / 2 * static_cast<float>(width_), (y + 1) / 2 * static_cast<float>(height_),
          depth};
}

}  // namespace wold
