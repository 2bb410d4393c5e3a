#include "raster/scene_drawing.hpp"

#include <cmath>

namespace wold {

SceneDetail suitable_detail(bool software) {
  SceneDetail detail;
  if (!software) return detail;
  detail.shadows.size = 1024;
  detail.picture.cloud_steps = 48;
  return detail;
}

SceneDrawing::SceneDrawing(const PlantedWorld& world, const SceneDetail& detail, Progress&)
    : world_(world),
      light_(world.world().sky, detail.shadows),
      sun_shadows_(world.world().ground),
      terrain_(world.world().ground, detail.terrain),
      picture_(light_, detail.picture) {
  light_.set_canopy(canopy_shade(world.world()));
  shade_land(world.world().ground);
}

void SceneDrawing::draw(const Camera& camera, const std::function<void(const DrawView&)>& extra) {
  picture_.draw(camera, [&](const DrawView& view, const SceneLight* light) {
    terrain_.draw(view, light);
    if (extra && light != nullptr) extra(view);
  });
}

void SceneDrawing::set_sky(const SkySettings& sky) {
  light_.set_sky(Sky(sky));
  set_sun();
  picture_.sky_changed();
}

void SceneDrawing::update_ground(const Ground& ground) {
  terrain_.update(ground);
  sun_shadows_ = SunShadowMap(ground);
  shade_land(ground);
  light_.shadows().forget();
  picture_.restart();
}

void SceneDrawing::shade_land(const Ground& ground) {
  light_.terrain_shade().set(SkyVisibility(ground));
  set_sun();
}

void SceneDrawing::set_sun() {
  sun_shadows_.set_sun(light_.sky().sun_direction());
  light_.terrain_shade().set(sun_shadows_);
}

std::size_t SceneDrawing::drawn_triangles() const {
  return terrain_.drawn_triangles();
}

}  // namespace wold
