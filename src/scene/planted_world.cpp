#include "scene/planted_world.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/parallel.hpp"
#include "render/ground_mesh.hpp"
#include "scene/build.hpp"
#include "scene/dressing.hpp"
#include "scene/same_scene.hpp"

namespace wold {

TerrainWindow surrounding_window(const Scene& scene, const TerrainWindow& inner) {
  const DVec2 inner_size = inner.cell * DVec2(inner.width - 1, inner.height - 1);
  const DVec2 size = inner_size * static_cast<double>(scene.surroundings.factor);
  const DVec2 middle = inner.origin + 0.5 * inner_size;
  TerrainWindow window;
  window.cell = std::max(size.x, size.y) / (scene.surroundings.resolution - 1);
  window.width = std::max(2, static_cast<int>(std::ceil(size.x / window.cell - 1e-6)) + 1);
  window.height = std::max(2, static_cast<int>(std::ceil(size.y / window.cell - 1e-6)) + 1);
  window.origin = middle - 0.5 * window.cell * DVec2(window.width - 1, window.height - 1);
  return window;
}

namespace {

using Clock = std::chrono::steady_clock;

// Plants lower than this do not count when a view is chosen.
constexpr float least_landmark = 1.2F;  // m
constexpr int camera_ground_samples = 512;

/// Runs a stage and adds its time to the table.
template <class Work>
auto timed(std::map<std::string, double>& seconds, const char* stage, const Work& work) {
  const auto began = Clock::now();
  auto result = work();
  seconds[stage] += std::chrono::duration<double>(Clock::now() - began).count();
  return result;
}

TerrainResult build_surroundings(const Scene& scene, Progress& progress) {
  if (scene.surroundings.factor <= 1) return {};
  const TerrainWindow window = surrounding_window(scene, window_of(scene.terrain));
  return evaluate(scene.terrain, window, scene.steps, scene_operators(), scene.header.seed,
                  scene.folder, progress);
}

/// Without trees in the scene there are none in the distance.
GroundMaterial ground_material(const Scene& scene) {
  GroundMaterial material = scene.ground;
  const bool trees = std::any_of(
      scene.scatter.begin(), scene.scatter.end(),
      [&](const ScatterSettings& s) { return s.where.within <= 0 && plants_trees(scene, s); });
  if (!trees) material.distant_forest = 0;
  return material;
}

}  // namespace

void PlantedWorld::build_land(const PlantedWorld* before, Progress& progress) {
  if (before != nullptr && same_land(before->scene_, scene_)) {
    land_ = before->land_;
    return;
  }
  land_ = std::make_shared<Land>();
  land_->inner = build_terrain(scene_, progress);
  land_->outer = build_surroundings(scene_, progress);
}

PlantModels PlantedWorld::models_like(const PlantedWorld* before, Progress& progress) const {
  if (before == nullptr || !same_models(before->scene_, scene_))
    return build_models(scene_, progress);
  return {before->world_->models, before->world_->materials, before->first_model_};
}

PlantedWorld::PlantedWorld(Scene scene, Progress& progress, const PlantedWorld* before)
    : scene_(std::move(scene)) {
  check_scene(scene_);
  timed(seconds_, "terrain", [&] {
    build_land(before, progress);
    return 0;
  });
  GroundDressing dressing = dress_ground(scene_, land_->inner, land_->outer, progress);
  PlantModels models = timed(seconds_, "plants", [&] { return models_like(before, progress); });
  first_model_ = std::move(models.first_model);
  world_ = std::make_unique<World>(
      World{Ground(land_->inner.field, land_->outer.field, ground_material(scene_),
                   scene_.header.seed, std::move(dressing)),
            std::move(models.materials),
            std::move(models.list),
            {},
            Sky(scene_.sky)});
  planter_ = std::make_unique<Planter>(scene_, world_->ground.field(), land_->inner.maps);
  world_->instances =
      timed(seconds_, "scatter", [&] { return placed(Planting::everywhere, DVec2(0), progress); });
  count(world_->instances);
}

std::vector<ModelInstance> PlantedWorld::placed(Planting which, DVec2 eye,
                                                Progress& progress) const {
  std::vector<ModelInstance> list;
  for (const Instance& p : planter_->plants(which, eye, progress)) {
    if (world_->ground.water_depth(DVec2(p.position.x, p.position.y)) > 0) continue;
    list.push_back(
        {p.position, p.up, p.yaw, p.scale, first_model_[p.species] + p.model, p.individual});
  }
  return list;
}

std::string PlantedWorld::species_of(std::uint32_t model) const {
  const auto after = std::upper_bound(first_model_.begin(), first_model_.end(), model);
  return scene_.species[static_cast<std::size_t>(after - first_model_.begin()) - 1].name;
}

void PlantedWorld::count(const std::vector<ModelInstance>& plants) {
  for (const ModelInstance& plant : plants) ++plants_[species_of(plant.model)];
}

const ModelTrees& PlantedWorld::trees(Progress& progress) {
  const std::scoped_lock lock(trees_mutex_);
  if (!trees_)
    trees_ = timed(seconds_, "ray tracer",
                   [&] { return std::make_unique<ModelTrees>(world_->models, progress); });
  return *trees_;
}

Camera PlantedWorld::camera(const CameraSettings& settings, Progress& progress) {
  const Ground& ground = world_->ground;
  if (is_placed(settings)) return placed_camera(ground, settings);
  // Chosen among the views of the ground and of what can be a landmark.
  const ModelTrees& models = trees(progress);
  return timed(seconds_, "camera", [&] {
    World landmarks{ground, {}, {}, {}, world_->sky};
    std::vector<float> heights;
    for (const Model& model : world_->models) heights.push_back(model.mesh.bounds().high.z);
    for (const ModelInstance& m : world_->instances)
      if (heights[m.model] * m.scale >= least_landmark) landmarks.instances.push_back(m);
    const DVec2 extent = ground.high() - ground.low();
    const double spacing = std::max(extent.x, extent.y) / camera_ground_samples;
    const RayScene rays(landmarks, models, dice_ground_evenly(ground, spacing), progress);
    const float aspect =
        static_cast<float>(scene_.render.size.x) / static_cast<float>(scene_.render.size.y);
    return find_camera(rays, settings, aspect, scene_.header.seed, progress);
  });
}

std::vector<ModelInstance> PlantedWorld::plants_near(DVec2 eye, Progress& progress) const {
  return placed(Planting::near_camera, eye, progress);
}

namespace {

/// `spacing(foot)` in m.
template <class Spacing>
void lift(std::vector<ModelInstance>& plants, const Ground& ground, const Spacing& spacing) {
  parallel_for(0, static_cast<int>(plants.size()), [&](int k) {
    Vec3& foot = plants[static_cast<std::size_t>(k)].position;
    const DVec2 place(foot.x, foot.y);
    foot.z += ground.detailed(place, spacing(foot)).height - ground.base(place).height;
  });
}

}  // namespace

void PlantedWorld::set_on_drawn_ground(std::vector<ModelInstance>& plants, Vec3 eye,
                                       float spacing_angle) const {
  lift(plants, world_->ground, [&](Vec3 foot) { return spacing_angle * glm::distance(foot, eye); });
}

void PlantedWorld::set_on_detailed_ground(std::vector<ModelInstance>& plants, float spacing) const {
  lift(plants, world_->ground, [spacing](Vec3) { return spacing; });
}

std::unique_ptr<RayScene> trace_scene(const World& world, const ModelTrees& trees,
                                      const Camera& camera, const RenderSettings& render,
                                      IVec2 size, Progress& progress) {
  const CameraRays rays(camera, size.x, size.y);
  GroundDicing dicing;
  dicing.spacing_pixels = render.dicing;
  dicing.spacing_outside = 5 * render.dicing;
  return std::make_unique<RayScene>(world, trees, dice_ground(world.ground, camera, rays, dicing),
                                    progress);
}

PlantedWorld::Parts PlantedWorld::parts_for(const Camera& camera, IVec2 size,
                                            Progress& progress) && {
  trees(progress);
  const std::vector<ModelInstance> around = timed(seconds_, "scatter", [&] {
    return plants_near(DVec2(camera.position.x, camera.position.y), progress);
  });
  count(around);
  std::vector<ModelInstance>& plants = world_->instances;
  plants.insert(plants.end(), around.begin(), around.end());
  const CameraRays rays(camera, size.x, size.y);
  set_on_drawn_ground(plants, camera.position, scene_.render.dicing * rays.pixel_angle());
  return {std::move(world_), std::move(trees_), std::move(land_->inner.maps), std::move(seconds_),
          std::move(plants_)};
}

TracedWorld PlantedWorld::traced(const Camera& camera, IVec2 size, Progress& progress,
                                 const SkySettings* sky) {
  TracedWorld out;
  out.world = std::make_unique<World>(*world_);
  if (sky != nullptr) out.world->sky = Sky(*sky);
  std::vector<ModelInstance>& plants = out.world->instances;
  const std::vector<ModelInstance> around =
      plants_near(DVec2(camera.position.x, camera.position.y), progress);
  plants.insert(plants.end(), around.begin(), around.end());
  const CameraRays rays(camera, size.x, size.y);
  set_on_drawn_ground(plants, camera.position, scene_.render.dicing * rays.pixel_angle());
  out.rays = trace_scene(*out.world, trees(progress), camera, scene_.render, size, progress);
  return out;
}

}  // namespace wold
