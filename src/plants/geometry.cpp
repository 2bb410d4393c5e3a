#include "plants/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/hash.hpp"
#include "plants/branch_mesh.hpp"
#include "plants/polygon.hpp"
#include "plants/skeleton.hpp"

namespace wold {

namespace {

enum class Draw : std::uint8_t { thinning = 64, roots };

/// More than any plant needs; 3 GB of vertices.
constexpr std::int64_t max_triangles = 30'000'000;

float top_of(const Skeleton& skeleton) {
  float top = 0;
  for (const auto& axis : skeleton.axes)
    for (const auto& node : axis.nodes) top = std::max(top, node.position.z);
  for (const auto& polygon : skeleton.polygons)
    for (const Vec3& v : polygon.vertices) top = std::max(top, v.z);
  return top;
}

/// Triangles collected by material.
class PartList {
 public:
  std::vector<UVec3>& of(const std::string& material) {
    for (auto& [name, triangles] : parts_)
      if (name == material) return triangles;
    return parts_.emplace_back(material, std::vector<UVec3>{}).second;
  }
  /// Moves the triangles that were added to `mesh` to a material.
  void take(TriangleMesh& mesh, const std::string& material) {
    auto& list = of(material);
    list.insert(list.end(), mesh.triangles.begin(), mesh.triangles.end());
    mesh.triangles.clear();
  }
  void put_into(TriangleMesh& mesh) const {
    for (const auto& [name, triangles] : parts_) {
      if (triangles.empty()) continue;
      mesh.parts.push_back({name, static_cast<std::uint32_t>(mesh.triangles.size()),
                            static_cast<std::uint32_t>(triangles.size())});
      mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
    }
  }

 private:
  std::vector<std::pair<std::string, std::vector<UVec3>>> parts_;
};

class PlantBuilder {
 public:
  PlantBuilder(const Skeleton& skeleton, const GeometrySettings& geometry,
               const std::vector<Organ>& organs, const BuildSettings& settings, Progress& progress)
      : skeleton_(skeleton),
        geometry_(geometry),
        organs_(organs),
        settings_(settings),
        top_(top_of(skeleton)),
        scale_(settings.height > 0 && top_ > 0 ? settings.height / top_ : 1.0F),
        progress_(progress) {
    continued_.assign(skeleton.axes.size(), false);
    for (const Skeleton::Axis& axis : skeleton.axes) {
      if (axis.parent < 0) continue;
      const auto parent = static_cast<std::size_t>(axis.parent);
      if (axis.parent_node + 1 == std::ssize(skeleton.axes[parent].nodes))
        continued_[parent] = true;
    }
    for (const std::string& colour : geometry.colours) parts_.of(colour);
    for (const Organ& organ : organs) {
      parts_.of(organ.material);
      organ_meshes_.push_back(organ_mesh(organ));
    }
  }

  TriangleMesh build() {
    for (std::size_t a = 0; a < skeleton_.axes.size(); ++a) branch(a);
    for (const Skeleton::Polygon& p : skeleton_.polygons) polygon(p);
    check_organs();
    for (std::size_t k = 0; k < skeleton_.organs.size(); ++k) place_organ(k);
    parts_.put_into(mesh_);
    return std::move(mesh_);
  }

 private:
  const std::string& material(int colour) const {
    const int last = static_cast<int>(geometry_.colours.size()) - 1;
    return geometry_.colours[static_cast<std::size_t>(std::clamp(colour, 0, last))];
  }

  void branch(std::size_t a) {
    if (a % 256 == 0) progress_.check();
    const Skeleton::Axis& axis = skeleton_.axes[a];
    float widest = 0;
    for (const Skeleton::Node& n : axis.nodes) widest = std::max(widest, n.radius);
    if (widest <= 0) return;
    const float world_radius = widest * scale_;
    BranchStyle style;
    // What a plant that fills a picture of 1000 lines hides, and no less than 1.5 mm.
    const float hidden = std::max(0.0006F * top_, 0.0015F / scale_);
    style.tolerance = (0.08F * widest + hidden) / settings_.detail;
    style.sides = sides(world_radius);
    style.pointed =
        !continued_[a] && (axis.nodes.back().radius < 0.4F * widest || geometry_.twig_radius > 0);
    if (axis.parent < 0) {
      style.sink = geometry_.sink;
      style.flare = geometry_.flare;
      style.seed = random_bits(settings_.seed, Draw::roots, a);
      if (style.flare > 0) {
        style.sides = std::max(style.sides, 2 * style.sides - 6);
        style.tolerance = std::min(style.tolerance, 0.02F * widest / settings_.detail);
      }
    }
    const std::size_t first = mesh_.uvs.size();
    add_branch(mesh_, axis.nodes, style);
    for (std::size_t k = first; k < mesh_.uvs.size(); ++k) mesh_.uvs[k] *= scale_;
    parts_.take(mesh_, material(axis.colour));
  }

  /// Sides of a cylinder of this radius (m): 3 for a twig, 6 for 1 cm, 16 for 15 cm.
  int sides(float radius) const {
    const float count = 2.0F + 36.0F * std::sqrt(radius) * std::sqrt(settings_.detail);
    return std::clamp(static_cast<int>(count), 3, 48);
  }

  void polygon(const Skeleton::Polygon& p) {
    const Vec3 normal = polygon_normal(p.vertices);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    const std::vector<UVec3> triangles = triangulate(p.vertices);
    if (triangles.empty()) return;
    Vec3 low = p.vertices[0];
    Vec3 high = low;
    for (const Vec3& v : p.vertices) {
      low = glm::min(low, v);
      high = glm::max(high, v);
    }
    const Vec3 size = glm::max(high - low, Vec3(1e-12F));
    for (const Vec3& v : p.vertices) {
      mesh_.positions.push_back(v);
      mesh_.normals.push_back(normal);
      const Vec3 place = (v - low) / size;
      mesh_.uvs.emplace_back(place.z, size.x > size.y ? place.x : place.y);
    }
    for (const UVec3& t : triangles) mesh_.triangles.push_back(t + first);
    parts_.take(mesh_, material(p.colour));
  }

  std::size_t organ_index(char name) const {
    for (std::size_t k = 0; k < organs_.size(); ++k)
      if (organs_[k].name == name) return k;
    std::vector<std::string> known;
    for (const Organ& o : organs_) known.emplace_back(1, o.name);
    throw Error(ErrorKind::input, fmt::format("the organ '~{}' is not described by an 'organ {}' "
                                              "line.{}",
                                              name, name, suggestion({&name, 1}, known)));
  }

  void check_organs() const {
    std::int64_t triangles = 0;
    for (const Skeleton::OrganPlace& o : skeleton_.organs)
      triangles += std::ssize(organ_meshes_[organ_index(o.name)].triangles);
    if (triangles > max_triangles)
      throw Error(ErrorKind::limit,
                  fmt::format("the organs of this plant would have {} triangles; the limit is {}",
                              triangles, max_triangles));
  }

  void place_organ(std::size_t place) {
    if (place % 4096 == 0) progress_.check();
    const Skeleton::OrganPlace& o = skeleton_.organs[place];
    float size = o.size;
    // Fewer and larger, of the same area (Cook et al., "Stochastic simplification of aggregate
    // detail", 2007).
    if (settings_.detail < 1) {
      if (uniform(random_bits(settings_.seed, Draw::thinning, place)) >= settings_.detail) return;
      size /= std::sqrt(settings_.detail);
    }
    const std::size_t k = organ_index(o.name);
    const TriangleMesh& organ = organ_meshes_[k];
    const Vec3 left = glm::cross(o.up, o.heading);
    const Mat3 frame(o.heading, left, o.up);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (const Vec3& p : organ.positions)
      mesh_.positions.push_back(o.position + frame * (size * p));
    for (const Vec3& n : organ.normals) mesh_.normals.push_back(glm::normalize(frame * n));
    mesh_.uvs.insert(mesh_.uvs.end(), organ.uvs.begin(), organ.uvs.end());
    auto& triangles = parts_.of(organs_[k].material);
    for (const UVec3& t : organ.triangles) triangles.push_back(t + first);
  }

  const Skeleton& skeleton_;
  const GeometrySettings& geometry_;
  const std::vector<Organ>& organs_;
  const BuildSettings& settings_;
  float top_;    // highest point without organs, turtle's units
  float scale_;  // metres per turtle's unit, but for organs above the top
  Progress& progress_;
  TriangleMesh mesh_;
  PartList parts_;
  std::vector<bool> continued_;  // axes that another goes on from at their end
  std::vector<TriangleMesh> organ_meshes_;
};

/// Scales to a height exactly.
void scale_to(TriangleMesh& mesh, float height) {
  const auto [low, high] = mesh.bounds();
  const float top = high.z;
  if (!(top > 1e-6F * glm::length(high - low)))
    throw Error(ErrorKind::input,
                "this plant has no point above the ground, so no height to scale");
  const float scale = height / top;
  for (Vec3& p : mesh.positions)
    p = p.z == top ? Vec3(p.x * scale, p.y * scale, height) : p * scale;
}

}  // namespace

Description<GeometrySettings> describe(const GeometrySettings&) {
  return Description<GeometrySettings>("geometry", "The surface of a plant.")
      .add("twig_radius", &GeometrySettings::twig_radius, {.unit = "m", .min = 0, .max = 1e4},
           "Radius of the thinnest twigs; radii then follow from da Vinci's rule. 0: from !(r).")
      .add("flare", &GeometrySettings::flare, {.min = 0, .max = 5},
           "Widening of the foot of the stem by roots, relative to its radius.")
      .add("sink", &GeometrySettings::sink, {.unit = "m", .min = 0, .max = 1e4},
           "How far the stem continues below the ground.")
      .add("colours", &GeometrySettings::colours,
           "Materials of branches and polygons: the first, and those that ' changes to.");
}

TriangleMesh build_mesh(Skeleton skeleton, const GeometrySettings& geometry,
                        const std::vector<Organ>& organs, const BuildSettings& settings,
                        Progress& progress) {
  const bool by_radius = geometry.twig_radius <= 0;
  continue_axes(skeleton, by_radius);
  if (!by_radius) set_radii(skeleton, geometry.twig_radius, settings.foot_radius);
  TriangleMesh mesh = PlantBuilder(skeleton, geometry, organs, settings, progress).build();
  if (settings.height > 0) scale_to(mesh, settings.height);
  return mesh;
}

}  // namespace wold
