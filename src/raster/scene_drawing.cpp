#include "raster/scene_drawing.hpp"

#include <thread>

#include "scene/same_scene.hpp"

namespace wold {

namespace {

constexpr double near_step = 5;  // m that the eye moves before the plants about it are found anew
// As the path tracer dices the ground under them.
constexpr double undergrowth_reach = 50;  // m
constexpr float near_spacing_pixels = 2;
constexpr float default_pixel_angle = 1e-3F;
constexpr float finest_under_trees = 0.1F;  // m

}  // namespace

SceneDetail scene_detail(DrawingQuality quality) {
  SceneDetail detail;
  switch (quality) {
    case DrawingQuality::low:
      detail.shadows.size = 1024;
      detail.plants.triangle_budget = 700'000;
      detail.plants.shadow_share = 0.3F;
      detail.picture.cloud_steps = 32;
      detail.picture.cloud_light_steps = 4;
      break;
    case DrawingQuality::medium: detail.plants.triangle_budget = 4'000'000; break;
    case DrawingQuality::high:
      detail.plants.triangle_budget = 12'000'000;
      detail.plants.leaves_per_pixel = 2;
      detail.plants.card_height = 60;
      detail.terrain.pixels_per_vertex = 3;
      detail.picture.cloud_light_steps = 12;
      detail.picture.cloud_scale = 1;
      detail.shadows.size = 4096;
      break;
  }
  return detail;
}

SceneDrawing::SceneDrawing(const PlantedWorld& world, const SceneDetail& detail, Progress& progress)
    : world_(&world),
      light_(world.world().sky, detail.shadows),
      sun_shadows_(world.world().ground),
      terrain_(world.world().ground, detail.terrain),
      plants_(world.world(), progress, detail.plants),
      picture_(light_, detail.picture) {
  stand_plants();
  light_.set_canopy(canopy_shade(world.world()));
  shade_land(world.world().ground);
}

void SceneDrawing::stand_plants() {
  std::vector<ModelInstance> plants = world_->world().instances;
  world_->set_on_detailed_ground(plants, finest_under_trees);
  plants_.set_plants(plants);
}

void SceneDrawing::find_near_plants(const Camera& camera) {
  const DVec2 eye(camera.position.x, camera.position.y);
  near_eye_ = eye;
  const float spacing_angle = near_spacing_pixels * default_pixel_angle;
  finding_near_.begin([this, eye, place = camera.position, spacing_angle](Progress& progress) {
    NearPlants found;
    found.plants = world_->plants_near(eye, progress);
    world_->set_on_drawn_ground(found.plants, place, spacing_angle);
    found.shade = undergrowth_shade(world_->world(), found.plants, eye, undergrowth_reach);
    return found;
  });
}

bool SceneDrawing::take_near_plants() {
  std::optional<BackgroundJob<NearPlants>::Outcome> outcome = finding_near_.take();
  const auto* found = outcome ? std::get_if<NearPlants>(&*outcome) : nullptr;
  if (found == nullptr) return false;
  set_near_plants(*found);
  return true;
}

void SceneDrawing::set_near_plants(const NearPlants& found) {
  plants_.set_near_plants(found.plants);
  light_.set_undergrowth(found.shade);
  light_.shadows().forget();
}

void SceneDrawing::settle(const Camera& camera) {
  const DVec2 eye(camera.position.x, camera.position.y);
  if (near_eye_ != eye) find_near_plants(camera);
  if (!finding_near_.busy()) return;
  set_near_plants(finding_near_.wait());
  picture_.restart();
}

void SceneDrawing::draw(const Camera& camera, const std::function<void(const DrawView&)>& extra) {
  if (take_near_plants()) picture_.restart();
  const DVec2 eye(camera.position.x, camera.position.y);
  if (!finding_near_.busy() && (!near_eye_ || glm::distance(eye, *near_eye_) > near_step))
    find_near_plants(camera);
  picture_.draw(camera, [&](const DrawView& view, const SceneLight* light) {
    if (!view.without_land) terrain_.draw(view, light);
    plants_.draw(view, light);
    if (extra && light != nullptr) extra(view);
  });
}

void SceneDrawing::set_sky(const SkySettings& sky) {
  light_.set_sky(Sky(sky));
  set_sun();
  picture_.sky_changed();
}

void SceneDrawing::replace(const PlantedWorld& world, Progress& progress) {
  if (finding_near_.busy()) {
    finding_near_.cancel();
    while (!finding_near_.take()) std::this_thread::yield();
  }
  near_eye_.reset();
  const World& next = world.world();
  if (!same_models(world_->scene(), world.scene()))
    plants_ = PlantDrawing(next, progress, plants_.detail());
  set_near_plants({});
  world_ = &world;
  stand_plants();
  terrain_.update(next.ground);
  light_.set_canopy(canopy_shade(next));
  light_.set_sky(next.sky);
  sun_shadows_ = SunShadowMap(next.ground);
  shade_land(next.ground);
  picture_.sky_changed();
}

void SceneDrawing::shade_land(const Ground& ground) {
  light_.terrain_shade().set(SkyVisibility(ground));
  light_.set_land_colors(land_colors(ground));
  set_sun();
}

void SceneDrawing::set_sun() {
  sun_shadows_.set_sun(light_.sky().sun_direction());
  light_.terrain_shade().set(sun_shadows_);
}

std::size_t SceneDrawing::drawn_triangles() const {
  return terrain_.drawn_triangles() + plants_.choice().triangles;
}

}  // namespace wold
