#include "raster/canopy_shade.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

constexpr double cell_size = 3;  // m
constexpr int most_cells = 1024;
constexpr int undergrowth_cells = 256;
constexpr double wide = 12;  // m, reach of the mean over what stands around, to each side

/// The crown of a model, in its own metres.
struct Crown {
  float leaf_area = 0;
  float radius = 0;
  float foot = 0;
  float top = 0;
  Vec3 scattering{0};  // of the light on leaves, the part that goes on, either side
};

Crown crown_of(const Model& model, const std::vector<SurfaceMaterial>& materials) {
  Crown crown;
  crown.top = model.mesh.bounds().high.z;
  double area = 0;
  double foot_sum = 0;
  double spread = 0;
  DVec3 scattered(0);
  const auto& mesh = model.mesh;
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    const Material& leaf = materials[model.part_materials[p]].settings();
    if (leaf.transmission == Vec3(0)) continue;
    const DVec3 scattering(0.5F * (leaf.color1 + leaf.color2) + leaf.transmission);
    const std::size_t end =
        p + 1 < mesh.parts.size() ? mesh.parts[p + 1].first_triangle : mesh.triangles.size();
    for (std::size_t t = mesh.parts[p].first_triangle; t < end; ++t) {
      const UVec3 corner = mesh.triangles[t];
      const Vec3 a = mesh.positions[corner.x];
      const Vec3 b = mesh.positions[corner.y];
      const Vec3 c = mesh.positions[corner.z];
      const double part = 0.5 * static_cast<double>(glm::length(glm::cross(b - a, c - a)));
      area += part;
      scattered += part * scattering;
      foot_sum += part * static_cast<double>(a.z);
      spread += part * static_cast<double>(a.x * a.x + a.y * a.y);
    }
  }
  if (!(area > 0)) return crown;
  crown.leaf_area = static_cast<float>(area);
  crown.scattering = glm::min(Vec3(scattered / area), Vec3(1));
  // A disc's mean square distance is half the square of its radius.
  crown.radius = static_cast<float>(std::sqrt(2 * spread / area));
  const auto middle = static_cast<float>(foot_sum / area);
  crown.foot = std::max(0.0F, 2 * middle - crown.top);
  return crown;
}

struct Cells {
  DVec2 low{0};
  double cell = 1;
  int width = 0;
  int height = 0;
  std::vector<float> area;  // m² of leaves over each cell
  std::vector<float> foot;  // weighted by area
  std::vector<float> top;
  std::vector<Vec3> scattered;
};

/// Adds a crown as a disc, spread evenly over the cells whose middle it covers.
void add_crown(Cells& cells, const Crown& crown, const ModelInstance& plant) {
  const double r = std::max(cells.cell, static_cast<double>(crown.radius * plant.scale));
  const DVec2 at = (DVec2(plant.position.x, plant.position.y) - cells.low) / cells.cell;
  const double reach = r / cells.cell;
  const auto within = [](double x, int count) {
    return std::clamp(static_cast<int>(std::floor(x)), 0, count - 1);
  };
  const int i1 = within(at.x + reach, cells.width);
  const int j1 = within(at.y + reach, cells.height);
  const float leaf_area = crown.leaf_area * plant.scale * plant.scale;
  const auto per_cell = static_cast<float>(leaf_area * cells.cell * cells.cell / (pi_d * r * r));
  for (int j = within(at.y - reach, cells.height); j <= j1; ++j)
    for (int i = within(at.x - reach, cells.width); i <= i1; ++i) {
      if (glm::distance(at, DVec2(i + 0.5, j + 0.5)) > reach) continue;
      const std::size_t k = static_cast<std::size_t>(j) * static_cast<std::size_t>(cells.width) +
                            static_cast<std::size_t>(i);
      cells.area[k] += per_cell;
      cells.foot[k] += per_cell * (plant.position.z + crown.foot * plant.scale);
      cells.top[k] += per_cell * (plant.position.z + crown.top * plant.scale);
      cells.scattered[k] += per_cell * crown.scattering;
    }
}

/// Means over boxes of `reach` cells to each side, along rows or columns.
std::vector<float> box_means(const std::vector<float>& values, int width, int height, int reach,
                             bool rows) {
  std::vector<float> out(values.size());
  const int length = rows ? width : height;
  const auto at = [&](int line, int k) {
    return rows ? static_cast<std::size_t>(line) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(k)
                : static_cast<std::size_t>(k) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(line);
  };
  for (int line = 0; line < (rows ? height : width); ++line) {
    double sum = 0;
    for (int k = -reach; k < length; ++k) {
      if (k + reach < length) sum += static_cast<double>(values[at(line, k + reach)]);
      if (k - reach > 0) sum -= static_cast<double>(values[at(line, k - reach - 1)]);
      if (k < 0) continue;
      const int count = std::min(k + reach, length - 1) - std::max(k - reach, 0) + 1;
      out[at(line, k)] = static_cast<float>(std::max(sum, 0.0) / count);
    }
  }
  return out;
}

std::vector<Crown> crowns_of(const World& world) {
  std::vector<Crown> crowns;
  for (const Model& model : world.models) crowns.push_back(crown_of(model, world.materials));
  return crowns;
}

Cells empty_cells(DVec2 low, DVec2 size, double cell) {
  Cells cells;
  cells.low = low;
  cells.cell = cell;
  cells.width = std::max(1, static_cast<int>(std::ceil(size.x / cell)));
  cells.height = std::max(1, static_cast<int>(std::ceil(size.y / cell)));
  const auto count = static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height);
  for (auto* list : {&cells.area, &cells.foot, &cells.top}) list->assign(count, 0);
  cells.scattered.assign(count, Vec3(0));
  return cells;
}

CanopyShade empty_shade(const Cells& cells) {
  CanopyShade shade;
  shade.width = cells.width;
  shade.height = cells.height;
  shade.texels.reserve(4 * cells.area.size());
  const DVec2 scale = 1.0 / (cells.cell * DVec2(cells.width, cells.height));
  shade.place = Vec4(Vec2(scale), Vec2(-cells.low * scale));
  return shade;
}

CanopyShade shade_of_crowns(const Cells& cells) {
  CanopyShade shade = empty_shade(cells);
  const int reach = std::max(1, static_cast<int>(std::lround(wide / cells.cell)));
  const std::vector<float> around =
      box_means(box_means(cells.area, cells.width, cells.height, reach, true), cells.width,
                cells.height, reach, false);
  const auto cell_area = static_cast<float>(cells.cell * cells.cell);
  for (std::size_t k = 0; k < cells.area.size(); ++k)
    for (const float sum : {cells.area[k], cells.foot[k], cells.top[k], around[k]})
      shade.texels.push_back(sum / cell_area);
  return shade;
}

CanopyShade shade_of_small_plants(const Cells& cells) {
  CanopyShade shade = empty_shade(cells);
  const auto cell_area = static_cast<float>(cells.cell * cells.cell);
  for (std::size_t k = 0; k < cells.area.size(); ++k) {
    const Vec3& scattered = cells.scattered[k];
    for (const float sum : {cells.area[k], scattered.x, scattered.y, scattered.z})
      shade.texels.push_back(sum / cell_area);
  }
  return shade;
}

}  // namespace

CanopyShade canopy_shade(const World& world, float least_height) {
  const std::vector<Crown> crowns = crowns_of(world);
  const Heightfield& field = world.ground.field();
  const DVec2 size = field.size();
  Cells cells =
      empty_cells(field.origin, size, std::max(cell_size, std::max(size.x, size.y) / most_cells));
  bool any = false;
  for (const ModelInstance& plant : world.instances) {
    const Crown& crown = crowns[plant.model];
    if (crown.leaf_area <= 0 || crown.top * plant.scale < least_height) continue;
    add_crown(cells, crown, plant);
    any = true;
  }
  return any ? shade_of_crowns(cells) : CanopyShade{};
}

CanopyShade undergrowth_shade(const World& world, std::span<const ModelInstance> plants, DVec2 eye,
                              double half_width) {
  if (plants.empty()) return {};
  const std::vector<Crown> crowns = crowns_of(world);
  Cells cells =
      empty_cells(eye - half_width, DVec2(2 * half_width), 2 * half_width / undergrowth_cells);
  for (const ModelInstance& plant : plants) {
    const DVec2 off = glm::abs(DVec2(plant.position.x, plant.position.y) - eye);
    const Crown& crown = crowns[plant.model];
    if (crown.leaf_area > 0 && std::max(off.x, off.y) < half_width) add_crown(cells, crown, plant);
  }
  return shade_of_small_plants(cells);
}

}  // namespace wold
