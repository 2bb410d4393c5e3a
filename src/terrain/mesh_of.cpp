#include "terrain/mesh_of.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "terrain/field_map.hpp"

namespace wold {

namespace {

void check_size(const Heightfield& field) {
  const int width = field.height.width();
  const int height = field.height.height();
  if (width < 2 || height < 2)
    throw Error(ErrorKind::input, "a mesh of ground needs at least 2 x 2 samples");
  const auto samples = static_cast<double>(field.height.size());
  const double bytes = samples * (2 * sizeof(Vec3) + sizeof(Vec2) + 2 * sizeof(UVec3));
  const auto available = static_cast<double>(available_memory());
  if (samples > static_cast<double>(std::numeric_limits<std::uint32_t>::max()) ||
      (available > 0 && bytes > 0.9 * available))
    throw Error(ErrorKind::limit,
                fmt::format("a mesh of {} x {} samples needs {}, but {} are free", width, height,
                            memory_text(bytes), memory_text(available)));
}

/// The two triangles of the cell whose south-west corner is (i, j), counter-clockwise from above.
void add_cell(const Heightfield& field, int i, int j, std::uint32_t first, UVec3* out) {
  const auto row = static_cast<std::uint32_t>(field.height.width());
  const std::uint32_t sw = first;
  const std::uint32_t se = first + 1;
  const std::uint32_t nw = first + row;
  const std::uint32_t ne = first + row + 1;
  const float rising = std::abs(field.height(i, j) - field.height(i + 1, j + 1));
  const float falling = std::abs(field.height(i + 1, j) - field.height(i, j + 1));
  if (rising <= falling) {
    out[0] = {sw, se, ne};
    out[1] = {sw, ne, nw};
  } else {
    out[0] = {sw, se, nw};
    out[1] = {se, ne, nw};
  }
}

}  // namespace

TriangleMesh mesh_of(const Heightfield& field) {
  check_size(field);
  const int width = field.height.width();
  const int height = field.height.height();
  const auto cells = static_cast<std::size_t>(width - 1) * static_cast<std::size_t>(height - 1);
  TriangleMesh mesh;
  mesh.positions.resize(field.height.size());
  mesh.normals.resize(field.height.size());
  mesh.uvs.resize(field.height.size());
  mesh.triangles.resize(2 * cells);
  parallel_for(0, height, [&](int j) {
    for (int i = 0; i < width; ++i) {
      const auto k = static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(i);
      const DVec2 place = place_of(field, i, j);
      mesh.positions[k] = Vec3(Vec2(place), field.height(i, j));
      mesh.normals[k] = normal_of(ground_at(field, place).gradient);
      mesh.uvs[k] = Vec2(i, j) / Vec2(width - 1, height - 1);
      if (i + 1 == width || j + 1 == height) continue;
      const std::size_t cell = static_cast<std::size_t>(j) * static_cast<std::size_t>(width - 1) +
                               static_cast<std::size_t>(i);
      add_cell(field, i, j, static_cast<std::uint32_t>(k), &mesh.triangles[2 * cell]);
    }
  });
  mesh.parts = {{"ground", 0, static_cast<std::uint32_t>(2 * cells)}};
  return mesh;
}

}  // namespace wold
