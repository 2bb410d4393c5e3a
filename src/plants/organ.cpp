#include "plants/organ.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

/// Half the width of a blade at t in [0, 1] from base to tip, relative to the greatest: an ovate
/// outline, t^p (1 - t)^q scaled to 1, whose greatest width is at p / (p + q) = `widest`.
float outline(float t, float widest) {
  const float w = std::clamp(widest, 0.05F, 0.95F);
  const float p = 1.4F * w;
  const float q = 1.4F * (1 - w);
  const float top = std::pow(w, p) * std::pow(1 - w, q);
  return std::pow(t, p) * std::pow(1 - t, q) / top;
}

/// Adds a triangle with its own three vertices and flat normal.
void add_flat(TriangleMesh& mesh, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {a, b, c}) {
    mesh.positions.push_back(p);
    mesh.normals.push_back(normal);
  }
  mesh.uvs.insert(mesh.uvs.end(), {Vec2(0, 0), Vec2(0, 1), Vec2(1, 0.5F)});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

/// A blade's midrib: an arc in the plane of heading and up, with its tangent and normal.
struct Midrib {
  const Organ& organ;

  float stalk() const { return organ.stalk * organ.length; }
  Vec3 point(float t) const {
    const float length = organ.length - stalk();
    const float b = radians(organ.bend);
    if (std::abs(b) < 1e-3F) return {stalk() + length * t, 0, 0};
    return {stalk() + length * std::sin(b * t) / b, 0, -length * (1 - std::cos(b * t)) / b};
  }
  Vec3 normal(float t) const {
    const float a = radians(organ.bend) * t;
    return {std::sin(a), 0, std::cos(a)};
  }
};

/// Adds vertices to a mesh that has normals and texture coordinates.
std::uint32_t add_vertex(TriangleMesh& mesh, Vec3 position, Vec3 normal, Vec2 uv) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.uvs.push_back(uv);
  return static_cast<std::uint32_t>(mesh.positions.size()) - 1;
}

/// A row of three vertices, right edge, midrib, left edge; returns the first.
std::uint32_t add_row(TriangleMesh& mesh, const Organ& organ, const Midrib& midrib, float t) {
  const float fold = radians(organ.fold);
  const float w = 0.5F * organ.width * organ.length * outline(t, organ.widest);
  const Vec3 centre = midrib.point(t);
  const Vec3 up = midrib.normal(t);
  const Vec3 left(0, 1, 0);
  const Vec3 out = std::cos(fold) * left;
  const Vec3 rise = std::sin(fold) * up;
  const Vec3 tilt = std::sin(fold) * left;
  const std::uint32_t first =
      add_vertex(mesh, centre + w * (rise - out), std::cos(fold) * up + tilt, {t, 0});
  add_vertex(mesh, centre, up, {t, 0.5F});
  add_vertex(mesh, centre + w * (rise + out), std::cos(fold) * up - tilt, {t, 1});
  return first;
}

/// A blade of rows across the midrib, pointed at both ends. Of one segment: two triangles that meet
/// in the midrib.
TriangleMesh leaf(const Organ& organ) {
  TriangleMesh mesh;
  const Midrib midrib{organ};
  const std::uint32_t base = add_vertex(mesh, midrib.point(0), midrib.normal(0), {0, 0.5F});
  if (organ.segments <= 1) {
    const std::uint32_t row = add_row(mesh, organ, midrib, organ.widest);
    mesh.positions[row + 1] = midrib.point(1);
    mesh.uvs[row + 1] = {1, 0.5F};
    mesh.triangles = {{base, row, row + 1}, {base, row + 1, row + 2}};
    return mesh;
  }
  std::uint32_t before = 0;
  for (int k = 1; k < organ.segments; ++k) {
    const float t = static_cast<float>(k) / static_cast<float>(organ.segments);
    const std::uint32_t row = add_row(mesh, organ, midrib, t);
    for (const std::uint32_t side : {0U, 1U}) {
      if (k == 1) {
        mesh.triangles.emplace_back(base, row + side, row + side + 1);
        continue;
      }
      mesh.triangles.emplace_back(before + side, row + side, row + side + 1);
      mesh.triangles.emplace_back(before + side, row + side + 1, before + side + 1);
    }
    before = row;
  }
  const std::uint32_t tip = add_vertex(mesh, midrib.point(1), midrib.normal(1), {1, 0.5F});
  mesh.triangles.emplace_back(before, tip, before + 1);
  mesh.triangles.emplace_back(before + 1, tip, before + 2);
  return mesh;
}

/// Needles around a twig, each one thin triangle, by the golden angle.
TriangleMesh shoot(const Organ& organ) {
  TriangleMesh mesh;
  const int count = std::max(organ.needles, 1);
  const float length = organ.needle_length * organ.length;
  const float half_width = 0.5F * organ.width * organ.length;
  for (int k = 0; k < count; ++k) {
    const float t = (static_cast<float>(k) + 0.5F) / static_cast<float>(count);
    const float around = radians(137.508F) * static_cast<float>(k);
    // Needles lean forward more and grow shorter towards the tip.
    const float angle = radians(organ.needle_angle) * (1 - 0.6F * t * t);
    const Vec3 out(0, std::cos(around), std::sin(around));
    const Vec3 across(0, -std::sin(around), std::cos(around));
    const Vec3 base(organ.length * (organ.stalk + (1 - organ.stalk) * 0.92F * t), 0, 0);
    const Vec3 direction = std::cos(angle) * Vec3(1, 0, 0) + std::sin(angle) * out;
    const Vec3 tip = base + length * (1 - 0.3F * t) * direction;
    add_flat(mesh, base - half_width * across, base + half_width * across, tip);
  }
  return mesh;
}

/// A low cone of six triangles, facing the heading.
TriangleMesh disc(const Organ& organ) {
  TriangleMesh mesh;
  constexpr int sides = 6;
  const float r = 0.5F * organ.width * organ.length;
  const Vec3 top(organ.length, 0, 0);
  const auto rim = [&](int k) {
    const float a = 2 * pi * static_cast<float>(k) / sides;
    return Vec3(0.6F * organ.length, r * std::cos(a), r * std::sin(a));
  };
  for (int k = 0; k < sides; ++k) {
    add_flat(mesh, rim(k), rim(k + 1), top);
    add_flat(mesh, rim(k + 1), rim(k), Vec3(0));
  }
  return mesh;
}

}  // namespace

Description<Organ> describe(const Organ&) {
  return Description<Organ>("organ", "A leaf, a shoot with needles or a flower part.")
      .choice("shape", &Organ::shape, {"leaf", "shoot", "disc"}, "What it is made like.")
      .add("material", &Organ::material, "Name of its material.")
      .add("length", &Organ::length, {.unit = "m", .min = 1e-6, .max = 1e6},
           "From its base to its tip, stalk included.")
      .add("width", &Organ::width, {.min = 0, .max = 10},
           "Of the blade, or of a needle, relative to length.")
      .add("widest", &Organ::widest, {.min = 0.05, .max = 0.95},
           "Where the blade is widest, from its base.")
      .add("stalk", &Organ::stalk, {.min = 0, .max = 0.9}, "Bare part, relative to length.")
      .add("fold", &Organ::fold, {.unit = "degrees", .min = -80, .max = 80},
           "By which each half of a blade is raised.")
      .add("bend", &Organ::bend, {.unit = "degrees", .min = -360, .max = 360},
           "By which the tip is turned down.")
      .add("segments", &Organ::segments, {.min = 1, .max = 64}, "Of a blade, along its length.")
      .add("needles", &Organ::needles, {.min = 1, .max = 10000}, "Of a shoot.")
      .add("needle_length", &Organ::needle_length, {.min = 0, .max = 10},
           "Relative to the shoot's length.")
      .add("needle_angle", &Organ::needle_angle, {.unit = "degrees", .min = 0, .max = 180},
           "Between needle and shoot.");
}

TriangleMesh organ_mesh(const Organ& organ) {
  TriangleMesh mesh = organ.shape == OrganShape::leaf    ? leaf(organ)
                      : organ.shape == OrganShape::shoot ? shoot(organ)
                                                         : disc(organ);
  mesh.parts = {{organ.material, 0, static_cast<std::uint32_t>(mesh.triangles.size())}};
  return mesh;
}

}  // namespace wold
