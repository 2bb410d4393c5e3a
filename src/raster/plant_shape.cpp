#include "raster/plant_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "mesh/parts.hpp"

namespace wold {

namespace {

/// A forest of disjoint sets of vertices.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The triangles of one element with vertices numbered from 0.
struct Surface {
  std::vector<Vec3> positions;
  std::vector<UVec3> triangles;
  std::vector<std::vector<std::uint32_t>> neighbours;
};

Surface surface_of(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  // Equal positions are one vertex: seams of textures are no ends.
  std::vector<Vec3> all;
  for (const std::uint32_t t : triangles)
    for (int k = 0; k < 3; ++k) all.push_back(mesh.positions[mesh.triangles[t][k]]);
  const auto less = [](const Vec3& a, const Vec3& b) {
    if (a.x != b.x) return a.x < b.x;
    return a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  Surface s;
  s.positions = all;
  std::sort(s.positions.begin(), s.positions.end(), less);
  s.positions.erase(std::unique(s.positions.begin(), s.positions.end()), s.positions.end());
  s.neighbours.resize(s.positions.size());
  const auto index = [&](const Vec3& p) {
    const auto at = std::lower_bound(s.positions.begin(), s.positions.end(), p, less);
    return static_cast<std::uint32_t>(at - s.positions.begin());
  };
  for (std::size_t k = 0; k + 2 < all.size(); k += 3) {
    const UVec3 t(index(all[k]), index(all[k + 1]), index(all[k + 2]));
    s.triangles.push_back(t);
    for (int e = 0; e < 3; ++e) {
      s.neighbours[t[e]].push_back(t[(e + 1) % 3]);
      s.neighbours[t[(e + 1) % 3]].push_back(t[e]);
    }
  }
  return s;
}

/// Distance along edges from one vertex (Dijkstra).
std::vector<float> distances(const Surface& s, std::uint32_t from) {
  std::vector<float> d(s.positions.size(), std::numeric_limits<float>::max());
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  d[from] = 0;
  queue.emplace(0.0F, from);
  while (!queue.empty()) {
    const auto [near, v] = queue.top();
    queue.pop();
    if (near > d[v]) continue;
    for (const std::uint32_t n : s.neighbours[v]) {
      const float next = near + glm::distance(s.positions[v], s.positions[n]);
      if (next >= d[n]) continue;
      d[n] = next;
      queue.emplace(next, n);
    }
  }
  return d;
}

std::uint32_t farthest(const std::vector<float>& d) {
  return static_cast<std::uint32_t>(std::max_element(d.begin(), d.end()) - d.begin());
}

/// Where distance crosses `value`: the middle of the two points farthest apart on the crossing
/// edges, weighted evenly over all, and the direction across.
struct Crossing {
  Vec3 centre{0};
  Vec3 across{0};
};

Crossing crossing(const Surface& s, const std::vector<float>& d, float value) {
  std::vector<Vec3> points;
  for (const UVec3& t : s.triangles)
    for (int e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e];
      const std::uint32_t b = t[(e + 1) % 3];
      if ((d[a] < value) == (d[b] < value)) continue;
      points.push_back(glm::mix(s.positions[a], s.positions[b], (value - d[a]) / (d[b] - d[a])));
    }
  Crossing c;
  if (points.empty()) return c;
  for (const Vec3& p : points) c.centre += p;
  c.centre /= static_cast<float>(points.size());
  Vec3 far = points.front();
  for (const Vec3& p : points)
    if (glm::distance(p, c.centre) > glm::distance(far, c.centre)) far = p;
  c.across = far - c.centre;
  return c;
}

/// Area per length about the centres: each triangle's area is spread evenly over the distances that
/// it spans.
std::vector<float> widths(const Surface& s, const std::vector<float>& d, float length,
                          int segments) {
  constexpr int finer = 4;
  const int bins = finer * segments;
  const float step = length / static_cast<float>(bins);
  std::vector<float> area(static_cast<std::size_t>(bins), 0.0F);
  for (const UVec3& t : s.triangles) {
    const Vec3& a = s.positions[t.x];
    const float size = 0.5F * glm::length(glm::cross(s.positions[t.y] - a, s.positions[t.z] - a));
    const float low = std::min({d[t.x], d[t.y], d[t.z]});
    const float high = std::max({d[t.x], d[t.y], d[t.z], low + 1e-3F * step});
    const int first = std::clamp(static_cast<int>(low / step), 0, bins - 1);
    const int last = std::clamp(static_cast<int>(high / step), 0, bins - 1);
    for (int k = first; k <= last; ++k) {
      const float from = std::max(low, static_cast<float>(k) * step);
      const float to = k == last ? high : std::min(high, static_cast<float>(k + 1) * step);
      area[static_cast<std::size_t>(k)] += size * std::max(0.0F, to - from) / (high - low);
    }
  }
  std::vector<float> width;
  for (int j = 0; j <= segments; ++j) {
    const int first = std::max(0, finer * j - finer / 2);
    const int last = std::min(bins, finer * j + finer / 2);
    float sum = 0;
    for (int k = first; k < last; ++k) sum += area[static_cast<std::size_t>(k)];
    width.push_back(sum / (static_cast<float>(last - first) * step));
  }
  return width;
}

}  // namespace

float triangle_area(const TriangleMesh& mesh, std::uint32_t triangle) {
  const UVec3& t = mesh.triangles[triangle];
  const Vec3& a = mesh.positions[t.x];
  return 0.5F * glm::length(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
}

PlantElements plant_elements(const TriangleMesh& mesh) {
  constexpr std::uint32_t none = 0xffffffffU;
  Sets sets(mesh.positions.size());
  for (const UVec3& t : mesh.triangles) {
    sets.join(t.x, t.y);
    sets.join(t.y, t.z);
  }
  PlantElements elements;
  std::vector<std::uint32_t> element_of_triangle(mesh.triangles.size());
  std::vector<std::uint32_t> element_of_root(mesh.positions.size(), none);
  const std::vector<MeshPart> parts = all_parts(mesh);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto begin = static_cast<std::ptrdiff_t>(elements.list.size());
    const std::uint32_t end = parts[p].first_triangle + parts[p].triangle_count;
    for (std::uint32_t t = parts[p].first_triangle; t < end; ++t) {
      std::uint32_t& e = element_of_root[sets.find(mesh.triangles[t].x)];
      if (e == none || std::cmp_less(e, begin)) {
        e = static_cast<std::uint32_t>(elements.list.size());
        elements.list.push_back({.part = static_cast<std::uint32_t>(p)});
      }
      element_of_triangle[t] = e;
      ++elements.list[e].count;
      elements.list[e].area += triangle_area(mesh, t);
    }
  }
  std::uint32_t first = 0;
  for (PlantElement& e : elements.list) {
    e.first = first;
    first += e.count;
    e.count = 0;
  }
  elements.triangles.resize(first);
  for (std::uint32_t t = 0; t < element_of_triangle.size(); ++t) {
    if (element_of_triangle[t] >= elements.list.size()) continue;
    PlantElement& e = elements.list[element_of_triangle[t]];
    elements.triangles[e.first + e.count++] = t;
  }
  return elements;
}

PlantCurve plant_curve(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                       int segments) {
  const Surface s = surface_of(mesh, triangles);
  const std::uint32_t start = farthest(distances(s, 0));
  const std::vector<float> d = distances(s, start);
  const std::uint32_t end = farthest(d);
  PlantCurve curve;
  curve.length = d[end];
  if (!(curve.length > 0)) {
    curve.centre.assign(static_cast<std::size_t>(segments) + 1, s.positions[start]);
    curve.width.assign(static_cast<std::size_t>(segments) + 1, 0);
    curve.side = Vec3(1, 0, 0);
    return curve;
  }
  for (int j = 0; j <= segments; ++j) {
    const float share = static_cast<float>(j) / static_cast<float>(segments);
    curve.centre.push_back(j == 0          ? s.positions[start]
                           : j == segments ? s.positions[end]
                                           : crossing(s, d, share * curve.length).centre);
  }
  curve.width = widths(s, d, curve.length, segments);
  const Vec3 along = glm::normalize(crossing(s, d, 0.55F * curve.length).centre -
                                    crossing(s, d, 0.25F * curve.length).centre);
  Vec3 across = crossing(s, d, 0.4F * curve.length).across;
  across -= glm::dot(across, along) * along;
  if (!(glm::length(across) > 1e-4F * curve.length))
    across = glm::cross(along, std::abs(along.x) < 0.7F ? Vec3(1, 0, 0) : Vec3(0, 1, 0));
  curve.side = glm::normalize(across);
  return curve;
}

}  // namespace wold
