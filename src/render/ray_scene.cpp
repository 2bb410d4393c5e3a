#include "render/ray_scene.hpp"

#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <x86intrin.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace wold {

namespace {

constexpr unsigned ground_id = 0;
constexpr unsigned first_instance_id = 1;

// How Embree splits its work, and with that the order of what it builds, follows the number of
// threads that it could have. Building always in an arena of this size makes the result the same
// for any number that it does have.
constexpr int build_slots = 64;

tbb::task_arena build_arena() {
  const auto threads = static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  // Slots that are reserved for callers are counted but never filled by workers.
  const int workers = std::clamp(threads - 1, 0, build_slots - 1);
  return tbb::task_arena(build_slots, static_cast<unsigned>(build_slots - workers));
}

void check_device(RTCDevice device) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE || code == RTC_ERROR_CANCELLED) return;
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    throw Error(ErrorKind::limit,
                "not enough memory for the scene's geometry; lower the terrain's resolution, the "
                "density of plants or the picture's size");
  throw Error(ErrorKind::internal,
              fmt::format("Embree failed with code {}", static_cast<int>(code)));
}

bool go_on(void* progress, double) {
  return !static_cast<Progress*>(progress)->cancelled();
}

bool finite(const Ray& ray) {
  const Vec3 sum = ray.origin + ray.direction;
  return std::isfinite(sum.x + sum.y + sum.z);
}

void commit(RTCDevice device, RTCScene scene, RTCBuildQuality quality, Progress& progress) {
  rtcSetSceneBuildQuality(scene, quality);
  rtcSetSceneProgressMonitorFunction(scene, go_on, &progress);
  rtcCommitScene(scene);
  progress.check();
  check_device(device);
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
}

void attach_mesh(RTCDevice device, RTCScene scene, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            sizeof(Vec3), mesh.positions.size());
  std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(UVec3), mesh.triangles.size());
  std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(UVec3));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

RTCRay embree_ray(const Ray& ray, float nearest, float farthest) {
  RTCRay r{};
  r.org_x = ray.origin.x;
  r.org_y = ray.origin.y;
  r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  r.tnear = nearest;
  r.tfar = farthest;
  r.mask = 0xffffffffU;
  return r;
}

}  // namespace

Mat3 instance_matrix(const ModelInstance& instance) {
  const Vec3 z = instance.up;
  const Vec3 east = std::abs(z.x) < 0.9F ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 x0 = glm::normalize(east - glm::dot(east, z) * z);
  const Vec3 y0 = glm::cross(z, x0);
  const float c = std::cos(instance.yaw);
  const float s = std::sin(instance.yaw);
  return instance.scale * Mat3(c * x0 + s * y0, c * y0 - s * x0, z);
}

ModelTrees::ModelTrees(std::span<const Model> models, Progress& progress)
    : device_(rtcNewDevice(nullptr)), scenes_(models.size()) {
  for (const Model& model : models) triangles_.push_back(model.mesh.triangles.size());
  progress.begin("indexing plants", static_cast<double>(models.size()), "models");
  build_arena().execute([&] {
    parallel_for(0, static_cast<int>(models.size()), [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      scenes_[k].reset(rtcNewScene(device_.get()));
      attach_mesh(device_.get(), scenes_[k].get(), models[k].mesh);
      commit(device_.get(), scenes_[k].get(), RTC_BUILD_QUALITY_MEDIUM, progress);
      progress.advance();
    });
  });
  progress.end();
}

RayScene::RayScene(const World& world, const ModelTrees& models,
                   const std::vector<GroundTile>& tiles, Progress& progress)
    : world_(&world), models_(&models), scene_(rtcNewScene(models.device())) {
  build_arena().execute([&] {
    add_ground(tiles, progress);
    add_instances(progress);
    progress.begin("indexing the scene", 0, "");
    commit(models_->device(), scene_.get(), RTC_BUILD_QUALITY_MEDIUM, progress);
    progress.end();
  });
}

void RayScene::add_ground(const std::vector<GroundTile>& tiles, Progress& progress) {
  constexpr std::size_t samples = std::size_t{ground_tile_samples} * ground_tile_samples;
  constexpr std::uint64_t triangles = 2ULL * (ground_tile_samples - 1) * (ground_tile_samples - 1);
  progress.begin("dicing the ground", static_cast<double>(tiles.size()), "tiles");
  // Embree reads 16 bytes at the last position.
  ground_positions_.resize(tiles.size() * samples + 1);
  parallel_for(0, static_cast<int>(tiles.size()), [&](int t) {
    const auto k = static_cast<std::size_t>(t);
    tile_positions(world_->ground, tiles[k], &ground_positions_[k * samples]);
    progress.advance();
  });
  progress.end();
  RTCGeometry geometry = rtcNewGeometry(models_->device(), RTC_GEOMETRY_TYPE_GRID);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             ground_positions_.data(), 0, sizeof(Vec3), tiles.size() * samples);
  auto* grids = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), tiles.size()));
  for (std::size_t k = 0; k < tiles.size(); ++k)
    grids[k] = {static_cast<unsigned>(k * samples), ground_tile_samples, ground_tile_samples,
                ground_tile_samples};
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_.get(), geometry, ground_id);
  rtcReleaseGeometry(geometry);
  unique_triangles_ += triangles * tiles.size();
  all_triangles_ += triangles * tiles.size();
}

void RayScene::add_instances(Progress& progress) {
  for (std::size_t k = 0; k < models_->size(); ++k) unique_triangles_ += models_->triangles(k);
  progress.begin("placing plants", static_cast<double>(world_->instances.size()), "plants");
  unsigned id = first_instance_id;
  for (const ModelInstance& instance : world_->instances) {
    const Mat3 m = instance_matrix(instance);
    const Vec3& p = instance.position;
    const float columns[12] = {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y, m[1].z,
                               m[2].x, m[2].y, m[2].z, p.x,    p.y,    p.z};
    RTCGeometry geometry = rtcNewGeometry(models_->device(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, models_->model(instance.model));
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.get(), geometry, id++);
    rtcReleaseGeometry(geometry);
    all_triangles_ += models_->triangles(instance.model);
    if (id % 1024 == 0) progress.advance(1024);
  }
  check_device(models_->device());
  progress.end();
}

Hit RayScene::intersect(const Ray& ray, float nearest, bool coherent, RayCount& count) const {
  ++count.rays;
  // Debian's Embree is built with assertions: a ray that is not finite would end the program.
  if (!finite(ray)) return {};
  RTCRayHit query{};
  query.ray = embree_ray(ray, nearest, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  const std::uint64_t before = count.timed ? __rdtsc() : 0;
  embree::intersect(scene_.get(), query, coherent);
  if (count.timed) count.ticks += __rdtsc() - before;
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  Hit hit;
  hit.distance = query.ray.tfar;
  hit.position = ray.origin + hit.distance * ray.direction;
  Vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  if (query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID) {
    hit.instance = query.hit.instID[0] - first_instance_id;
    hit.triangle = query.hit.primID;
    // Rotation and one scale for all axes: the same matrix turns normals.
    normal = instance_matrix(world_->instances[hit.instance]) * normal;
  }
  const float length = glm::length(normal);
  hit.normal = length > 0 ? normal / length : Vec3(0, 0, 1);
  return hit;
}

bool RayScene::occluded(const Ray& ray, float nearest, float farthest, RayCount& count) const {
  ++count.rays;
  if (!finite(ray)) return true;
  RTCRay query = embree_ray(ray, nearest, farthest);
  const std::uint64_t before = count.timed ? __rdtsc() : 0;
  const bool blocked = embree::occluded(scene_.get(), query);
  if (count.timed) count.ticks += __rdtsc() - before;
  return blocked;
}

}  // namespace wold
