#include "plants/branch_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "base/hash.hpp"

namespace wold {

namespace {

using Node = Skeleton::Node;

/// A node of the smoothed axis; `flare` is the widening by roots there.
struct Sample {
  Vec3 position;
  float radius = 0;
  float flare = 0;

  Vec4 shape() const { return {position, radius * (1 + flare)}; }
};

/// Tangents of a Catmull-Rom curve with chord-length parameters, per unit of length.
std::vector<Vec3> tangents(const std::vector<Node>& nodes) {
  const std::size_t n = nodes.size();
  const auto slope = [&](std::size_t k) {
    const Vec3 d = nodes[k + 1].position - nodes[k].position;
    return d / std::max(glm::length(d), 1e-12F);
  };
  const auto length = [&](std::size_t k) {
    return glm::distance(nodes[k + 1].position, nodes[k].position);
  };
  std::vector<Vec3> result(n);
  result.front() = slope(0);
  result.back() = slope(n - 2);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const float a = length(k - 1);
    const float b = length(k);
    result[k] = (b * slope(k - 1) + a * slope(k)) / std::max(a + b, 1e-12F);
  }
  return result;
}

/// Cubic Hermite interpolation.
Vec3 hermite(const Node& a, const Node& b, Vec3 from, Vec3 to, float t) {
  const float length = glm::distance(a.position, b.position);
  const float t2 = t * t;
  const float t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * a.position + (t3 - 2 * t2 + t) * length * from +
         (3 * t2 - 2 * t3) * b.position + (t3 - t2) * length * to;
}

/// The widening of a foot, `height` above the ground relative to its radius.
float flare_at(const BranchStyle& style, float height) {
  return style.flare * std::exp(-0.8F * std::max(height, 0.0F)) *
         (1 + 0.25F * std::max(-height, 0.0F));
}

std::vector<Sample> sample_curve(const std::vector<Node>& nodes, const BranchStyle& style) {
  const std::vector<Vec3> tangent = tangents(nodes);
  std::vector<Sample> samples;
  const float foot_radius = std::max(nodes.front().radius, 1e-12F);
  if (style.sink > 0) {
    constexpr int steps = 3;
    for (int k = steps; k > 0; --k) {
      const float depth = style.sink * static_cast<float>(k) / steps;
      samples.push_back({nodes.front().position - depth * tangent.front(), nodes.front().radius,
                         flare_at(style, -depth / foot_radius)});
    }
  }
  float travelled = 0;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const Node& a = nodes[k];
    const Node& b = nodes[k + 1];
    const float length = glm::distance(a.position, b.position);
    const bool in_flare = style.flare > 0 && travelled < 6 * foot_radius;
    const int steps = in_flare ? 16 : 4;
    for (int i = 0; i < steps; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(steps);
      const float flare = in_flare ? flare_at(style, (travelled + t * length) / foot_radius) : 0.0F;
      samples.push_back({hermite(a, b, tangent[k], tangent[k + 1], t),
                         a.radius + t * (b.radius - a.radius), flare});
    }
    travelled += length;
  }
  samples.push_back({nodes.back().position, nodes.back().radius, 0});
  return samples;
}

/// Douglas and Peucker's thinning, of position and radius together.
std::vector<Sample> thin(const std::vector<Sample>& samples, float tolerance) {
  std::vector<bool> keep(samples.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, samples.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const Vec4 a = samples[first].shape();
    const Vec4 d = samples[last].shape() - a;
    const float length2 = std::max(glm::dot(d, d), 1e-20F);
    float worst = tolerance;
    std::size_t split = 0;
    for (std::size_t k = first + 1; k < last; ++k) {
      const Vec4 v = samples[k].shape() - a;
      const float t = std::clamp(glm::dot(v, d) / length2, 0.0F, 1.0F);
      const float distance = glm::length(v - t * d);
      if (distance > worst) {
        worst = distance;
        split = k;
      }
    }
    if (split == 0) continue;
    keep[split] = true;
    open.emplace_back(first, split);
    open.emplace_back(split, last);
  }
  std::vector<Sample> kept;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool repeats =
        !kept.empty() && glm::distance(kept.back().position, samples[k].position) < 1e-9F;
    if (keep[k] && !repeats) kept.push_back(samples[k]);
  }
  return kept;
}

struct RingFrame {
  Vec3 tangent;
  Vec3 normal;
};

Vec3 any_perpendicular(Vec3 v) {
  const Vec3 other = std::abs(v.x) < 0.7F ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return glm::normalize(glm::cross(v, other));
}

Vec3 reflected(Vec3 v, Vec3 plane_normal) {
  const float length2 = glm::dot(plane_normal, plane_normal);
  return length2 < 1e-20F ? v : v - 2 * glm::dot(plane_normal, v) / length2 * plane_normal;
}

/// Frames of least rotation, by double reflection.
std::vector<RingFrame> frames(const std::vector<Sample>& samples) {
  const std::size_t n = samples.size();
  const auto direction = [&](std::size_t k) {
    return glm::normalize(samples[k + 1].position - samples[k].position);
  };
  std::vector<RingFrame> result(n);
  for (std::size_t k = 0; k < n; ++k) {
    Vec3 t = direction(std::min(k, n - 2));
    if (k > 0 && k + 1 < n) {
      t += direction(k - 1);
      t = glm::length(t) < 1e-4F ? direction(k) : glm::normalize(t);
    }
    result[k].tangent = t;
  }
  result[0].normal = any_perpendicular(result[0].tangent);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const Vec3 across = samples[k + 1].position - samples[k].position;
    const Vec3 normal = reflected(result[k].normal, across);
    const Vec3 tangent = reflected(result[k].tangent, across);
    Vec3 next = reflected(normal, result[k + 1].tangent - tangent);
    next -= glm::dot(next, result[k + 1].tangent) * result[k + 1].tangent;
    result[k + 1].normal = glm::normalize(next);
  }
  return result;
}

/// Roots: the widening of a foot by direction, between 0.35 and 1.5, made of a few waves.
float root_shape(float around, std::uint64_t seed) {
  float sum = 0;
  for (const int waves : {3, 5, 8}) {
    const std::uint64_t bits = random_bits(seed, waves);
    const float phase = 2 * pi * uniform(bits);
    const float amount = 0.14F + 0.1F * uniform(mix_bits(bits));
    sum += amount * std::cos(static_cast<float>(waves) * around + phase);
  }
  return 0.9F + sum;
}

class BranchBuilder {
 public:
  BranchBuilder(TriangleMesh& mesh, std::vector<Sample> samples, const BranchStyle& style)
      : mesh_(mesh), samples_(std::move(samples)), style_(style), frames_(frames(samples_)) {
    for (const Sample& s : samples_) widest_ = std::max(widest_, s.radius);
  }

  void build() {
    const std::size_t n = samples_.size();
    const std::size_t rings = style_.pointed ? n - 1 : n;
    float along = 0;
    for (std::size_t k = 0; k < rings; ++k) {
      if (k > 0) along += glm::distance(samples_[k].position, samples_[k - 1].position);
      ring(k, along);
      if (k > 0) join(mesh_first_ + static_cast<std::uint32_t>(k - 1) * ring_size());
    }
    const std::uint32_t last = mesh_first_ + static_cast<std::uint32_t>(rings - 1) * ring_size();
    const Sample& end = samples_.back();
    const Vec3 forward = frames_.back().tangent;
    const Vec3 tip = style_.pointed ? end.position : end.position + 0.6F * end.radius * forward;
    close(last, tip, forward, false);
    close(mesh_first_, samples_.front().position, -frames_.front().tangent, true);
  }

 private:
  std::uint32_t ring_size() const { return static_cast<std::uint32_t>(style_.sides) + 1; }

  void ring(std::size_t k, float along) {
    const Sample& s = samples_[k];
    const RingFrame& f = frames_[k];
    const Vec3 binormal = glm::cross(f.tangent, f.normal);
    const float slope = taper(k);
    for (int i = 0; i <= style_.sides; ++i) {
      const float turn = static_cast<float>(i) / static_cast<float>(style_.sides);
      // The seam's second vertex repeats the first exactly.
      const float around = i == style_.sides ? 0.0F : 2 * pi * turn;
      const Vec3 out = std::cos(around) * f.normal + std::sin(around) * binormal;
      const float roots = s.flare > 0 ? s.flare * root_shape(around, style_.seed) : 0.0F;
      mesh_.positions.push_back(s.position + s.radius * (1 + roots) * out);
      mesh_.normals.push_back(glm::normalize(out - slope * f.tangent));
      mesh_.uvs.emplace_back(2 * pi * widest_ * turn, along);
    }
  }

  /// dr/ds at a ring.
  float taper(std::size_t k) const {
    const Vec4 a = samples_[k > 0 ? k - 1 : 0].shape();
    const Vec4 b = samples_[std::min(k + 1, samples_.size() - 1)].shape();
    return (b.w - a.w) / std::max(glm::distance(Vec3(a), Vec3(b)), 1e-9F);
  }

  void join(std::uint32_t below) {
    const std::uint32_t above = below + ring_size();
    for (std::uint32_t i = 0; i + 1 < ring_size(); ++i) {
      mesh_.triangles.emplace_back(below + i, below + i + 1, above + i + 1);
      mesh_.triangles.emplace_back(below + i, above + i + 1, above + i);
    }
  }

  void close(std::uint32_t ring_first, Vec3 point, Vec3 normal, bool backward) {
    const auto centre = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(point);
    mesh_.normals.push_back(normal);
    mesh_.uvs.push_back(mesh_.uvs[ring_first]);
    for (std::uint32_t i = 0; i + 1 < ring_size(); ++i) {
      const std::uint32_t a = ring_first + i;
      if (backward) {
        mesh_.triangles.emplace_back(centre, a + 1, a);
      } else {
        mesh_.triangles.emplace_back(centre, a, a + 1);
      }
    }
  }

  TriangleMesh& mesh_;
  std::vector<Sample> samples_;
  const BranchStyle& style_;
  std::vector<RingFrame> frames_;
  float widest_ = 0;
  std::uint32_t mesh_first_ = static_cast<std::uint32_t>(mesh_.positions.size());
};

}  // namespace

void add_branch(TriangleMesh& mesh, const std::vector<Skeleton::Node>& nodes,
                const BranchStyle& style) {
  if (nodes.size() < 2) return;
  std::vector<Sample> samples = thin(sample_curve(nodes, style), style.tolerance);
  if (samples.size() < 2) return;
  BranchBuilder(mesh, std::move(samples), style).build();
}

}  // namespace wold
