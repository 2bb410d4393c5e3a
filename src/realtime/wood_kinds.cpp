#include "realtime/wood_kinds.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "forest/species_mix.hpp"
#include "scene/dressing.hpp"
#include "scene/planting.hpp"

namespace wold {

namespace {

// Pointed crowns are both.
constexpr float pointed_taper = 0.4F;
constexpr float pointed_slenderness = 0.25F;

constexpr int slices = 6;  // of a model's height

/// What 9 of 10 keep.
float most(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto tenth = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
  std::nth_element(values.begin(), tenth, values.end());
  return *tenth;
}

/// Trees per m² of each species, at full density.
std::vector<double> densities(const Scene& scene) {
  std::vector<double> sum(scene.species.size(), 0.0);
  for (const ScatterSettings& scatter : scene.scatter) {
    if (!plants_trees(scene, scatter)) continue;
    const std::vector<double> shares = species_shares(scatter.species, scene.species, "scatter");
    for (std::size_t k = 0; k < sum.size(); ++k)
      if (is_tree(scene.species[k])) sum[k] += scatter.density * shares[k];
  }
  return sum;
}

/// One crown for several kinds: their mean by density, in the range of all.
class Mean {
 public:
  void add(const SpeciesSettings& species, float slenderness, double density) {
    const auto weight = static_cast<float>(density);
    weights_ += weight;
    low_ += weight * species.height.low;
    high_ += weight * species.height.high;
    slenderness_ += weight * slenderness;
  }
  float weight() const { return weights_; }
  CrownKind kind(float all) const {
    return {weights_ / all, {low_ / weights_, high_ / weights_}, slenderness_ / weights_};
  }

 private:
  float weights_ = 0;
  float low_ = 0;
  float high_ = 0;
  float slenderness_ = 0;
};

}  // namespace

CrownShape crown_shape(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return {};
  const float height = std::max(mesh.bounds().high.z, 1e-3F);
  std::array<std::vector<float>, slices> distances;
  std::vector<float> all;
  for (const Vec3& p : mesh.positions) {
    const float slice = std::clamp(slices * p.z / height, 0.0F, slices - 1.0F);
    const float distance = glm::length(Vec2(p.x, p.y));
    distances[static_cast<std::size_t>(slice)].push_back(distance);
    all.push_back(distance);
  }
  std::array<float, slices> reach{};
  std::transform(distances.begin(), distances.end(), reach.begin(), most);
  const float widest = *std::max_element(reach.begin(), reach.end());
  return {widest > 0 ? reach.back() / widest : 1, most(all) / height};
}

WoodKinds wood_kinds(const Scene& scene, Progress& progress) {
  const std::vector<double> density = densities(scene);
  Scene trees = scene;
  trees.species.clear();
  std::vector<double> weights;
  for (std::size_t k = 0; k < density.size(); ++k) {
    if (!(density[k] > 0)) continue;
    trees.species.push_back(scene.species[k]);
    trees.species.back().models = 1;
    weights.push_back(density[k]);
  }
  if (trees.species.empty()) return {};
  const PlantModels models = build_models(trees, progress);
  Mean pointed;
  Mean round;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const CrownShape shape = crown_shape(models.list[models.first_model[k]].mesh);
    const bool is_pointed = shape.taper < pointed_taper && shape.slenderness < pointed_slenderness;
    (is_pointed ? pointed : round).add(trees.species[k], shape.slenderness, weights[k]);
  }
  const float all = pointed.weight() + round.weight();
  WoodKinds kinds;
  kinds.pointed.share = kinds.round.share = 0;
  if (pointed.weight() > 0) kinds.pointed = pointed.kind(all);
  if (round.weight() > 0) kinds.round = round.kind(all);
  return kinds;
}

}  // namespace wold
