#include "plants/skeleton.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

using Axis = Skeleton::Axis;
/// For each axis and node.
using NodeValues = std::vector<std::vector<double>>;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

double mean_length_per_axis(const Skeleton& skeleton) {
  double length = 0;
  for (const Axis& axis : skeleton.axes)
    for (std::size_t k = 1; k < axis.nodes.size(); ++k)
      length += glm::distance(axis.nodes[k].position, axis.nodes[k - 1].position);
  return length / static_cast<double>(std::max<std::size_t>(skeleton.axes.size(), 1));
}

/// How much is carried at each node: tips beyond it, and wood at half a tip per mean length.
NodeValues loads(const Skeleton& skeleton) {
  NodeValues load;
  for (const Axis& axis : skeleton.axes) load.emplace_back(axis.nodes.size(), 0.0);
  const double per_length = 0.5 / std::max(mean_length_per_axis(skeleton), 1e-12);
  for (std::size_t a = skeleton.axes.size(); a-- > 0;) {
    const Axis& axis = skeleton.axes[a];
    auto& own = load[a];
    if (own.back() == 0) own.back() = 1;
    for (std::size_t k = own.size() - 1; k-- > 0;)
      own[k] += own[k + 1] +
                per_length * glm::distance(axis.nodes[k].position, axis.nodes[k + 1].position);
    if (axis.parent >= 0) load[index(axis.parent)][index(axis.parent_node)] += own.front();
  }
  return load;
}

float straightness(const Axis& parent, const Axis& child) {
  const std::size_t end = parent.nodes.size() - 1;
  const Vec3 before = parent.nodes[end].position - parent.nodes[end - 1].position;
  const Vec3 after = child.nodes[1].position - child.nodes[0].position;
  return glm::dot(before, after) / (glm::length(before) * glm::length(after) + 1e-20F);
}

/// The branch at the end of `axis` that continues it, or -1.
int continuation(const Skeleton& skeleton, const Axis& axis, const std::vector<int>& children,
                 const std::vector<double>& strength) {
  const int end = static_cast<int>(axis.nodes.size()) - 1;
  double strongest = 0;
  const auto eligible = [&](int c) {
    const Axis& child = skeleton.axes[index(c)];
    return child.parent_node == end && child.colour == axis.colour;
  };
  for (const int c : children)
    if (eligible(c)) strongest = std::max(strongest, strength[index(c)]);
  int best = -1;
  float best_straightness = -2;
  for (const int c : children) {
    if (!eligible(c) || strength[index(c)] < 0.95 * strongest) continue;
    const float s = straightness(axis, skeleton.axes[index(c)]);
    if (s > best_straightness) {
      best = c;
      best_straightness = s;
    }
  }
  return best;
}

}  // namespace

void continue_axes(Skeleton& skeleton, bool by_radius) {
  auto& axes = skeleton.axes;
  std::vector<double> strength;
  const NodeValues load = by_radius ? NodeValues{} : loads(skeleton);
  std::vector<std::vector<int>> children(axes.size());
  for (std::size_t a = 0; a < axes.size(); ++a) {
    strength.push_back(by_radius ? axes[a].nodes[1].radius : load[a].front());
    if (axes[a].parent >= 0) children[index(axes[a].parent)].push_back(static_cast<int>(a));
  }
  std::vector<bool> merged(axes.size(), false);
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (merged[a]) continue;
    for (int c = 0; (c = continuation(skeleton, axes[a], children[a], strength)) >= 0;) {
      const int shift = static_cast<int>(axes[a].nodes.size()) - 1;
      const auto& tail = axes[index(c)].nodes;
      axes[a].nodes.insert(axes[a].nodes.end(), tail.begin() + 1, tail.end());
      std::erase(children[a], c);
      for (const int grandchild : children[index(c)]) {
        axes[index(grandchild)].parent = static_cast<int>(a);
        axes[index(grandchild)].parent_node += shift;
        children[a].push_back(grandchild);
      }
      merged[index(c)] = true;
    }
  }
  std::vector<int> new_index(axes.size(), -1);
  std::vector<Axis> kept;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (merged[a]) continue;
    new_index[a] = static_cast<int>(kept.size());
    Axis& axis = kept.emplace_back(std::move(axes[a]));
    if (axis.parent >= 0) axis.parent = new_index[index(axis.parent)];
  }
  axes = std::move(kept);
}

void set_radii(Skeleton& skeleton, float twig, float foot) {
  const NodeValues load = loads(skeleton);
  double most = 1;
  for (std::size_t a = 0; a < load.size(); ++a)
    if (skeleton.axes[a].parent < 0) most = std::max(most, load[a].front());
  const double ratio = std::log(std::max(static_cast<double>(foot) / twig, 1.0 + 1e-9));
  const double exponent = std::max(std::log(most) / ratio, 1.0);
  for (std::size_t a = 0; a < load.size(); ++a)
    for (std::size_t k = 0; k < load[a].size(); ++k)
      skeleton.axes[a].nodes[k].radius =
          static_cast<float>(twig * std::pow(load[a][k], 1 / exponent));
}

}  // namespace wold
