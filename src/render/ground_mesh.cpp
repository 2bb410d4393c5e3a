#include "render/ground_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

/// About the distance from the camera to the nearest point of a tile. Its ground is taken to be as
/// high as the higher of its middle and the place nearest to the camera.
double distance_to(const GroundTile& tile, const Ground& ground, const Vec3& eye) {
  const DVec2 place(eye.x, eye.y);
  const DVec2 nearest = glm::clamp(place, tile.low, tile.low + DVec2(tile.size));
  const float height =
      std::max(ground.base(tile.low + DVec2(tile.size / 2)).height, ground.base(nearest).height);
  const double across = glm::distance(place, nearest);
  const double above = std::max(0.0, static_cast<double>(eye.z - height));
  return std::hypot(across, across < tile.size ? 0.7 * above : above);
}

/// Whether any of the tile may be seen: its bounding sphere against the view's cone.
bool in_view(const GroundTile& tile, const Ground& ground, const Camera& camera, float half_angle) {
  const DVec2 middle = tile.low + DVec2(tile.size / 2);
  const float height = ground.base(middle).height;
  const Vec3 d = Vec3(Vec2(middle), height) - camera.position;
  const auto radius = static_cast<float>(tile.size);
  const float distance = glm::length(d);
  if (distance <= 1.5F * radius) return true;
  const float angle =
      std::acos(std::clamp(glm::dot(d, glm::normalize(camera.direction)) / distance, -1.0F, 1.0F));
  return angle < half_angle + std::asin(std::min(1.0F, radius / distance));
}

struct Dicer {
  const Ground& ground;
  const Camera& camera;
  GroundDicing dicing;
  float pixel_angle;
  float half_angle;
  std::vector<GroundTile> tiles;

  double wanted_spacing(const GroundTile& tile) const {
    const double distance = distance_to(tile, ground, camera.position);
    const bool seen = in_view(tile, ground, camera, half_angle);
    const double pixels =
        static_cast<double>(seen ? dicing.spacing_pixels : dicing.spacing_outside);
    const double spacing = distance * static_cast<double>(pixel_angle) * pixels;
    return std::clamp(spacing, static_cast<double>(dicing.least_spacing),
                      static_cast<double>(dicing.most_spacing));
  }

  bool dice(const GroundTile& tile) {
    if (tile.spacing() <= wanted_spacing(tile)) {
      tiles.push_back(tile);
      return tiles.size() <= dicing.most_tiles;
    }
    const double half = tile.size / 2;
    for (const DVec2 corner : {DVec2(0, 0), DVec2(half, 0), DVec2(0, half), DVec2(half, half)})
      if (!dice({tile.low + corner, half})) return false;
    return true;
  }
};

/// Square root tiles that cover the ground.
std::vector<GroundTile> roots(const Ground& ground) {
  const DVec2 extent = ground.high() - ground.low();
  const double size = std::min(extent.x, extent.y);
  std::vector<GroundTile> list;
  for (double y = 0; y < extent.y - 1e-6 * size; y += size)
    for (double x = 0; x < extent.x - 1e-6 * size; x += size)
      list.push_back({ground.low() + DVec2(x, y), size});
  return list;
}

}  // namespace

std::vector<GroundTile> dice_ground(const Ground& ground, const Camera& camera,
                                    const CameraRays& rays, const GroundDicing& dicing) {
  const Vec3 corner = rays.ray(Vec2(0), Vec2(0.5F)).direction;
  const float cosine = glm::dot(corner, glm::normalize(camera.direction));
  const float half_angle = 1.05F * std::acos(std::clamp(cosine, -1.0F, 1.0F));
  GroundDicing coarser = dicing;
  for (;;) {
    Dicer dicer{ground, camera, coarser, rays.pixel_angle(), half_angle, {}};
    bool complete = true;
    for (const GroundTile& root : roots(ground)) complete = complete && dicer.dice(root);
    if (complete || roots(ground).size() >= dicing.most_tiles) return std::move(dicer.tiles);
    coarser.spacing_pixels *= 1.3F;
    coarser.spacing_outside *= 1.3F;
    coarser.least_spacing *= 1.3F;
  }
}

std::vector<GroundTile> dice_ground_evenly(const Ground& ground, double spacing) {
  std::vector<GroundTile> tiles;
  const DVec2 extent = ground.high() - ground.low();
  const double size = spacing * ground_tile_cells;
  for (double y = 0; y < extent.y; y += size)
    for (double x = 0; x < extent.x; x += size) tiles.push_back({ground.low() + DVec2(x, y), size});
  return tiles;
}

void tile_positions(const Ground& ground, const GroundTile& tile, Vec3* out) {
  const double spacing = tile.spacing();
  const DVec2 end = ground.high();
  for (int j = 0; j < ground_tile_samples; ++j) {
    for (int i = 0; i < ground_tile_samples; ++i) {
      const int column = std::clamp(i - 1, 0, ground_tile_cells);
      const int row = std::clamp(j - 1, 0, ground_tile_cells);
      const DVec2 place = glm::min(tile.low + spacing * DVec2(column, row), end);
      const bool skirt = column != i - 1 || row != j - 1;
      const float drop = skirt ? static_cast<float>(spacing) : 0.0F;
      const float height = ground.detailed(place, static_cast<float>(spacing)).height - drop;
      out[j * ground_tile_samples + i] = Vec3(Vec2(place), height);
    }
  }
}

}  // namespace wold
