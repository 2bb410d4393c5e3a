#include "raster/draw_view.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

Vec4 row(const Mat4& m, int k) {
  return {m[0][k], m[1][k], m[2][k], m[3][k]};
}

Vec4 unit_plane(Vec4 p) {
  const float length = glm::length(Vec3(p));
  return length > 0 ? p / length : p;
}

/// From -w <= x, y <= w, and z <= w, in terms of world coordinates.
std::array<Vec4, 5> planes_of(const Mat4& m) {
  const Vec4 x = row(m, 0);
  const Vec4 y = row(m, 1);
  const Vec4 z = row(m, 2);
  const Vec4 w = row(m, 3);
  return {unit_plane(w + x), unit_plane(w - x), unit_plane(w + y), unit_plane(w - y),
          unit_plane(w - z)};
}

/// World to view: x right, y up, z towards the eye.
Mat4 look(Vec3 eye, Vec3 forward, Vec3 up) {
  const Vec3 right = glm::normalize(glm::cross(forward, up));
  const Vec3 above = glm::cross(right, forward);
  Mat4 m(1);
  for (int k = 0; k < 3; ++k) {
    m[k][0] = right[k];
    m[k][1] = above[k];
    m[k][2] = -forward[k];
  }
  m[3] = Vec4(-glm::dot(right, eye), -glm::dot(above, eye), glm::dot(forward, eye), 1);
  return m;
}

Vec3 some_up(Vec3 direction) {
  return std::abs(direction.z) < 0.99F ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
}

}  // namespace

bool DrawView::sees(Vec3 low, Vec3 high) const {
  return std::all_of(planes.begin(), planes.end(), [&](const Vec4& p) {
    const Vec3 farthest(p.x > 0 ? high.x : low.x, p.y > 0 ? high.y : low.y,
                        p.z > 0 ? high.z : low.z);
    return glm::dot(Vec3(p), farthest) + p.w >= 0;
  });
}

bool DrawView::sees_sphere(Vec3 centre, float radius) const {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const Vec4& p) { return glm::dot(Vec3(p), centre) + p.w >= -radius; });
}

void DrawView::apply(const GpuProgram& program) const {
  program.set("view_projection", view_projection);
  program.set("eye", eye);
  program.set("pixel_angle", pixel_angle);
}

DrawView camera_view(const Camera& camera, int width, int height, float nearest, Vec2 jitter) {
  const float longer = std::tan(0.5F * radians(camera.field_of_view));
  const auto w = static_cast<float>(width);
  const auto h = static_cast<float>(height);
  const float half_width = w >= h ? longer : longer * w / h;
  const float half_height = w >= h ? longer * h / w : longer;
  Mat4 projection(0);
  projection[0][0] = 1 / half_width;
  projection[1][1] = 1 / half_height;
  projection[2][0] = -2 * jitter.x / w;
  projection[2][1] = -2 * jitter.y / h;
  projection[2][3] = -1;
  projection[3][2] = nearest;
  DrawView view;
  view.view_projection = projection * look(camera.position, camera.direction, camera.up);
  view.eye = camera.position;
  view.pixel_angle = 2 * half_width / w;
  view.planes = planes_of(view.view_projection);
  const Vec3 side = glm::normalize(glm::cross(camera.direction, camera.up));
  view.right = half_width * side;
  view.above = half_height * glm::cross(side, camera.direction);
  view.forward =
      camera.direction - (2 * jitter.x / w) * view.right - (2 * jitter.y / h) * view.above;
  view.nearest = nearest;
  return view;
}

DrawView shadow_view(const DrawView& camera, Vec3 centre, Vec3 towards_light, Vec3 half) {
  const Vec3 forward = -towards_light;
  const Mat4 to_light = look(centre, forward, some_up(forward));
  Mat4 projection(1);
  projection[0][0] = 1 / half.x;
  projection[1][1] = 1 / half.y;
  projection[2][2] = 0.5F / half.z;  // towards the light is +z in view space
  projection[3][2] = 0.5F;
  DrawView view = camera;
  view.view_projection = projection * to_light;
  view.depth_only = true;
  view.planes = planes_of(view.view_projection);
  return view;
}

namespace {
bool has_clip_control() {
  return epoxy_is_desktop_gl() &&
         (epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control"));
}
}  // namespace

Vec2 stored_depth_range() {
  return has_clip_control() ? Vec2(0, 1) : Vec2(-1, 2);
}

bool use_reversed_depth() {
  glDepthFunc(GL_GEQUAL);
  glClearDepthf(0);
  const bool exact = has_clip_control();
  if (exact) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  return exact;
}

}  // namespace wold
