#pragma once
// The world as Embree sees it: what a ray hits, and whether two places see each other.

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "render/camera.hpp"
#include "render/embree.hpp"
#include "render/ground_mesh.hpp"
#include "render/world.hpp"

namespace wold {

struct Hit {
  static constexpr std::uint32_t ground = 0xffffffffU;

  float distance = -1;              ///< m; negative when nothing is hit
  Vec3 position{0};                 ///< m
  Vec3 normal{0, 0, 1};             ///< unit, of the triangle, either side
  std::uint32_t instance = ground;  ///< index in World::instances, or `ground`
  std::uint32_t triangle = 0;       ///< of the instance's model
  float u = 0;                      ///< barycentric
  float v = 0;

  bool valid() const { return distance >= 0; }
};

/// Rays traced by one thread, and the time stamp counter's ticks spent inside Embree when `timed`.
struct RayCount {
  std::uint64_t rays = 0;
  std::uint64_t ticks = 0;
  bool timed = false;
};

/// The models of a world as Embree sees them: built once, shared by all RayScenes of that world and
/// its copies. Throws Error(cancelled), and Error(limit) when memory runs out.
class ModelTrees {
 public:
  ModelTrees(std::span<const Model> models, Progress& progress);

  RTCDevice device() const { return device_.get(); }
  std::size_t size() const { return scenes_.size(); }
  RTCScene model(std::size_t k) const { return scenes_[k].get(); }
  std::uint64_t triangles(std::size_t k) const { return triangles_[k]; }

 private:
  embree::Device device_;
  std::vector<embree::Scene> scenes_;
  std::vector<std::uint64_t> triangles_;
};

/// Holds references to the world and the trees of its models, which must outlive it. Building
/// throws as ModelTrees.
class RayScene {
 public:
  RayScene(const World& world, const ModelTrees& models, const std::vector<GroundTile>& tiles,
           Progress& progress);

  Hit intersect(const Ray& ray, float nearest, bool coherent, RayCount& count) const;
  bool occluded(const Ray& ray, float nearest, float farthest, RayCount& count) const;

  const World& world() const { return *world_; }
  /// Unique triangles, ground included, and triangles with every instance counted.
  std::uint64_t unique_triangles() const { return unique_triangles_; }
  std::uint64_t all_triangles() const { return all_triangles_; }

 private:
  void add_ground(const std::vector<GroundTile>& tiles, Progress& progress);
  void add_instances(Progress& progress);

  const World* world_;
  const ModelTrees* models_;
  std::vector<Vec3> ground_positions_;  // shared with Embree
  embree::Scene scene_;
  std::uint64_t unique_triangles_ = 0;
  std::uint64_t all_triangles_ = 0;
};

/// Columns of the rotation and scale of an instance.
Mat3 instance_matrix(const ModelInstance& instance);

}  // namespace wold
