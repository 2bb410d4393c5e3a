#include "raster/shadow_maps.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gpu/context.hpp"

namespace wold {

namespace {

constexpr int with_land = 2;        // cascades
constexpr float leave = 0.18F;      // of the radius: how far the eye goes before a map is drawn
constexpr float least_depth = 600;  // m, half of what a map holds along the light
constexpr float blur_texels = 0.8F;
constexpr float least_turn = 0.9999995F;  // cosine of how far the sun goes

/// A place moved onto whole texels across the light.
Vec3 snapped(Vec3 place, Vec3 towards_sun, float texel) {
  const Vec3 side = glm::normalize(
      glm::cross(towards_sun, std::abs(towards_sun.z) < 0.99F ? Vec3(0, 0, 1) : Vec3(0, 1, 0)));
  const Vec3 up = glm::cross(side, towards_sun);
  const auto whole = [texel](float x) { return std::round(x / texel) * texel - x; };
  return place + side * whole(glm::dot(place, side)) + up * whole(glm::dot(place, up));
}

}  // namespace

ShadowMaps::ShadowMaps(const ShadowSettings& settings) : settings_(settings) {
  if (settings.size <= 0) return;
  settings_.size = std::min(settings.size, gpu_info().max_texture_size / 2);
  atlas_ = GpuTarget(2 * settings_.size, 2 * settings_.size, {}, true, TextureFilter::nearest);
}

float ShadowMaps::radius(int cascade) const {
  return settings_.nearest_radius * std::pow(settings_.ratio, static_cast<float>(cascade));
}

void ShadowMaps::update(const DrawView& camera, Vec3 towards_sun,
                        const std::function<void(const DrawView&)>& draw) {
  if (!atlas_ || towards_sun.z <= 0) return;
  if (glm::dot(sun_, towards_sun) < least_turn) forget();
  sun_ = towards_sun;
  for (int k = 0; k < shadow_cascades; ++k) {
    const auto c = static_cast<std::size_t>(k);
    const float r = radius(k);
    if (drawn_[c] && glm::distance(centres_[c], camera.eye) < leave * r) continue;
    centres_[c] = camera.eye;
    drawn_[c] = true;
    const float texel = 2 * r / static_cast<float>(settings_.size);
    DrawView view = shadow_view(camera, snapped(camera.eye, towards_sun, texel), towards_sun,
                                {r, r, std::max(least_depth, 3 * r)});
    view.without_land = k >= with_land;
    matrices_[c] = view.view_projection;
    atlas_.bind();
    const int x = (k & 1) * settings_.size;
    const int y = (k >> 1) * settings_.size;
    glViewport(x, y, settings_.size, settings_.size);
    glScissor(x, y, settings_.size, settings_.size);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    draw(view);
    glDisable(GL_SCISSOR_TEST);
  }
}

void ShadowMaps::apply(const GpuProgram& program, int unit, float turn) const {
  const bool any = static_cast<bool>(atlas_) && drawn_[0];
  program.set("shadow_count", any ? shadow_cascades : 0);
  program.set("shadow_atlas", unit);
  if (!any) return;
  atlas_.depth().bind(unit);
  std::array<float, shadow_cascades> texels{};
  std::array<float, shadow_cascades> lifts{};
  for (int k = 0; k < shadow_cascades; ++k) {
    const auto c = static_cast<std::size_t>(k);
    texels[c] = 2 * radius(k) / static_cast<float>(settings_.size);
    lifts[c] = k < with_land ? texels[c] : 0;
  }
  program.set("shadow_matrices", std::span<const Mat4>(matrices_));
  program.set("shadow_texels", std::span<const float>(texels));
  program.set("shadow_lifts", std::span<const float>(lifts));
  program.set("shadow_blur", 2 * blur_texels / static_cast<float>(settings_.size));
  program.set("shadow_turn", turn);
  program.set("depth_range", stored_depth_range());
}

}  // namespace wold
