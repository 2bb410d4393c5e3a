#include "mesh/edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace wold::mesh_edit {

namespace {

/// For each point the first with the same position and normal: where a file has it more than once
/// (a seam of texture coordinates) the surface was smooth, and stays so.
std::vector<std::uint32_t> same_points(const Content& content) {
  // By bits: numbers that are none have no order.
  const auto key = [&](std::uint32_t k) {
    const DVec3& p = content.positions[content.points[k].position];
    const DVec3 n(content.points[k].normal);
    return std::bit_cast<std::array<std::uint64_t, 6>>(
        std::array<double, 6>{p.x, p.y, p.z, n.x, n.y, n.z});
  };
  std::vector<std::uint32_t> order(content.points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto of_a = key(a);
    const auto of_b = key(b);
    return of_a == of_b ? a < b : of_a < of_b;
  });
  std::vector<std::uint32_t> same(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    same[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? same[order[k - 1]] : order[k];
  return same;
}

/// A triangle's unit normal and angles; all 0 for one without area.
struct Corners {
  DVec3 normal{0};
  DVec3 angles{0};
};

Corners corners_of(const std::vector<DVec3>& positions, const UVec3& t) {
  const std::array<DVec3, 3> p{positions[t.x], positions[t.y], positions[t.z]};
  const DVec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double area = glm::length(cross);
  if (!(area > 0) || !std::isfinite(area)) return {};
  Corners corners{cross / area, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const DVec3 a = p[(k + 1) % 3] - p[k];
    const DVec3 b = p[(k + 2) % 3] - p[k];
    corners.angles[static_cast<int>(k)] = std::atan2(area, glm::dot(a, b));
  }
  return corners;
}

/// Per point the sum of the faces' normals.
std::vector<DVec3> sums(const Content& content, const std::vector<DVec3>& positions,
                        const std::vector<std::uint32_t>& same) {
  std::vector<DVec3> sums(content.points.size(), DVec3(0));
  for (std::size_t k = 0; k < content.triangle_points.size(); ++k) {
    const Corners corners = corners_of(positions, content.triangles[k]);
    for (int c = 0; c < 3; ++c)
      if (const std::uint32_t point = content.triangle_points[k][c]; point != no_point)
        sums[same[point]] += corners.angles[c] * corners.normal;
  }
  return sums;
}

}  // namespace

Edit edit_of(const Content& before, const std::vector<DVec3>& positions) {
  Edit edit{before, positions, {}, std::vector<std::uint8_t>(before.points.size(), 0)};
  edit.normals.reserve(before.points.size());
  for (const Point& point : before.points) edit.normals.push_back(point.normal);
  if (before.points.empty()) return edit;
  const std::vector<std::uint32_t> same = same_points(before);
  std::vector<std::uint8_t> touched(before.points.size(), 0);
  for (std::size_t k = 0; k < before.triangle_points.size(); ++k) {
    const UVec3& t = before.triangles[k];
    if (!edit.moved(t.x) && !edit.moved(t.y) && !edit.moved(t.z)) continue;
    for (int c = 0; c < 3; ++c)
      if (const std::uint32_t point = before.triangle_points[k][c]; point != no_point)
        touched[same[point]] = 1;
  }
  const std::vector<DVec3> old_sums = sums(before, before.positions, same);
  const std::vector<DVec3> new_sums = sums(before, positions, same);
  for (std::size_t k = 0; k < before.points.size(); ++k) {
    if (touched[same[k]] == 0) continue;
    const DVec3 sum = new_sums[same[k]];
    const double length = glm::length(sum);
    if (!(length > 0)) continue;
    // Normals against the order of corners stay against it.
    const double side =
        glm::dot(old_sums[same[k]], DVec3(before.points[k].normal)) < 0 ? -1.0 : 1.0;
    edit.normals[k] = Vec3(sum * (side / length));
    edit.turned[k] = 1;
  }
  return edit;
}

std::string number_text(double value) {
  return fmt::format("{:.9g}", value);
}

}  // namespace wold::mesh_edit
