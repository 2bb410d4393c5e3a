#pragma once
// Land, sky and plants of a scene, from which pictures of many cameras can be made: those of a
// viewer that moves, and the path tracer's.
//
// Plants that stand wherever the eye is (trees) are in `world()`; those that a scene plants around
// the camera only (grass, ferns) are found for each eye. A plant near the eye is set on the ground
// as drawn there, which has more detail than the field.

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "render/ray_scene.hpp"
#include "scene/planting.hpp"
#include "scene/scene.hpp"

namespace wold {

/// A world made ready to be traced from one camera.
struct TracedWorld {
  std::unique_ptr<World> world;
  std::unique_ptr<RayScene> rays;  ///< refers to *world and to the trees of its models
};

class PlantedWorld {
 public:
  /// Builds terrain, models and plants. What is the same in the scene of `before` is taken from it
  /// (plant files that changed on disk are not seen then). Throws as `check_scene` and the
  /// operators.
  PlantedWorld(Scene scene, Progress& progress, const PlantedWorld* before = nullptr);
  PlantedWorld(const PlantedWorld&) = delete;
  PlantedWorld& operator=(const PlantedWorld&) = delete;

  const Scene& scene() const { return scene_; }
  const World& world() const { return *world_; }
  /// Maps of the terrain's steps, over world().ground.field().
  const std::map<std::string, Grid<float>>& maps() const { return land_->inner.maps; }
  /// By stage.
  const std::map<std::string, double>& seconds() const { return seconds_; }
  /// Plants in world() by species.
  const std::map<std::string, std::uint64_t>& plants() const { return plants_; }

  /// The camera of these settings for a picture of the scene's size, as given or found.
  Camera camera(const CameraSettings& settings, Progress& progress);
  /// The plants that stand around an eye only, at the height of the field. Any thread.
  std::vector<ModelInstance> plants_near(DVec2 eye, Progress& progress) const;
  /// Lifts plants from the field to the ground as drawn. `spacing_angle`: distance between samples
  /// of the drawn ground over distance from the eye.
  void set_on_drawn_ground(std::vector<ModelInstance>& plants, Vec3 eye, float spacing_angle) const;
  /// To the ground with all features down to `spacing` metres.
  void set_on_detailed_ground(std::vector<ModelInstance>& plants, float spacing) const;

  /// The world as the path tracer sees it from a camera; this must outlive it. `size` in pixels.
  /// Any thread. `sky`, if given, in place of the scene's.
  TracedWorld traced(const Camera& camera, IVec2 size, Progress& progress,
                     const SkySettings* sky = nullptr);

  /// What `traced` has built so far, with the ray tracer's trees of models, for one camera whose
  /// plants are already in the world. Leaves this without its world.
  struct Parts {
    std::unique_ptr<World> world;
    std::unique_ptr<ModelTrees> trees;
    std::map<std::string, Grid<float>> maps;
    std::map<std::string, double> seconds;
    std::map<std::string, std::uint64_t> plants;
  };
  Parts parts_for(const Camera& camera, IVec2 size, Progress& progress) &&;

 private:
  /// What the terrain's steps made, within and around.
  struct Land {
    TerrainResult inner;
    TerrainResult outer;
  };

  void build_land(const PlantedWorld* before, Progress& progress);
  PlantModels models_like(const PlantedWorld* before, Progress& progress) const;
  const ModelTrees& trees(Progress& progress);
  std::vector<ModelInstance> placed(Planting which, DVec2 eye, Progress& progress) const;
  void count(const std::vector<ModelInstance>& plants);
  std::string species_of(std::uint32_t model) const;

  Scene scene_;
  std::unique_ptr<World> world_;
  std::shared_ptr<Land> land_;
  std::vector<std::uint32_t> first_model_;
  std::unique_ptr<Planter> planter_;
  std::mutex trees_mutex_;  // guards trees_ and its time while pictures are made
  std::unique_ptr<ModelTrees> trees_;
  std::map<std::string, double> seconds_;
  std::map<std::string, std::uint64_t> plants_;
};

/// The ray tracer's scene of a world for one camera.
std::unique_ptr<RayScene> trace_scene(const World& world, const ModelTrees& trees,
                                      const Camera& camera, const RenderSettings& render,
                                      IVec2 size, Progress& progress);

/// The samples of the land around, as wide as the terrain's sides ask for.
TerrainWindow surrounding_window(const Scene& scene, const TerrainWindow& inner);

}  // namespace wold
