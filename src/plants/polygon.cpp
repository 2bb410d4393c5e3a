#include "plants/polygon.hpp"

#include <cmath>
#include <numeric>

namespace wold {

namespace {

float cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

bool inside(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

/// Projection onto the plane of the polygon, counter-clockwise.
std::vector<Vec2> flattened(std::span<const Vec3> vertices) {
  const Vec3 n = polygon_normal(vertices);
  const Vec3 other = std::abs(n.x) < 0.7F ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(other, n));
  const Vec3 v = glm::cross(n, u);
  std::vector<Vec2> flat;
  for (const Vec3& p : vertices) flat.emplace_back(glm::dot(p, u), glm::dot(p, v));
  return flat;
}

bool is_ear(const std::vector<Vec2>& points, const std::vector<std::uint32_t>& ring,
            std::size_t k) {
  const std::size_t n = ring.size();
  const std::uint32_t before = ring[(k + n - 1) % n];
  const std::uint32_t after = ring[(k + 1) % n];
  const Vec2 a = points[before];
  const Vec2 b = points[ring[k]];
  const Vec2 c = points[after];
  if (cross(b - a, c - b) <= 0) return false;
  for (const std::uint32_t other : ring) {
    const Vec2 p = points[other];
    // A vertex visited twice, as at the foot of a lobe, does not block.
    if (p == a || p == b || p == c) continue;
    if (inside(p, a, b, c)) return false;
  }
  return true;
}

}  // namespace

Vec3 polygon_normal(std::span<const Vec3> vertices) {
  DVec3 sum(0);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const DVec3 a(vertices[k] - vertices[0]);
    const DVec3 b(vertices[(k + 1) % vertices.size()] - vertices[0]);
    sum += glm::cross(a, b);
  }
  const double length = glm::length(sum);
  return length > 0 ? Vec3(sum / length) : Vec3(0);
}

std::vector<UVec3> triangulate(std::span<const Vec3> vertices) {
  std::vector<UVec3> triangles;
  if (vertices.size() < 3 || polygon_normal(vertices) == Vec3(0)) return triangles;
  const std::vector<Vec2> points = flattened(vertices);
  std::vector<std::uint32_t> ring(vertices.size());
  std::iota(ring.begin(), ring.end(), 0U);
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    std::size_t ear = 0;
    while (ear < n && !is_ear(points, ring, ear)) ++ear;
    if (ear == n) ear = 0;
    triangles.emplace_back(ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.emplace_back(ring[0], ring[1], ring[2]);
  return triangles;
}

}  // namespace wold
