#include "scene/dressing.hpp"

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "forest/species_mix.hpp"
#include "scene/planting.hpp"
#include "scene/scene_maps.hpp"

namespace wold {

namespace {

constexpr float least_tree = 4;  // m

TerrainDomain place_of(const TerrainResult& terrain) {
  return {terrain.field.origin, terrain.field.size()};
}

std::vector<CoverLayer> covers_of(const Scene& scene, const TerrainResult& terrain,
                                  const TerrainResult& around, Progress& progress) {
  std::vector<CoverLayer> layers;
  for (const GroundCover& cover : scene.covers) {
    const std::string& map = cover.map.path;
    Heightfield inner =
        scene_map(scene, map, terrain.field, terrain.maps, place_of(terrain), progress);
    Heightfield outer;
    if (around.maps.contains(map))
      outer = {around.maps.at(map), around.field.origin, around.field.cell};
    const auto seed = static_cast<std::uint32_t>(
        random_bits(scene.header.seed, hash_text(std::string_view("cover")), layers.size()));
    layers.emplace_back(cover, std::move(inner), std::move(outer), seed);
  }
  return layers;
}

WaterLayer water_of(const Scene& scene, const TerrainResult& ground, const Grid<float>& depth) {
  return depth.empty() ? WaterLayer() : WaterLayer(ground.field, depth, scene.water.least_depth);
}

double tree_share(const Scene& scene, const ScatterSettings& scatter) {
  const std::vector<double> shares = species_shares(scatter.species, scene.species, "scatter");
  double trees = 0;
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (scene.species[k].height.high >= least_tree) trees += shares[k];
  return trees;
}

}  // namespace

GroundDressing dress_ground(const Scene& scene, const TerrainResult& terrain,
                            const TerrainResult& around, Progress& progress) {
  GroundDressing dressing;
  dressing.covers = covers_of(scene, terrain, around, progress);
  dressing.water = scene.water;
  const std::string& map = scene.water.depth.path;
  dressing.inner_water = water_of(
      scene, terrain,
      scene_map(scene, map, terrain.field, terrain.maps, place_of(terrain), progress).height);
  if (around.maps.contains(map)) dressing.outer_water = water_of(scene, around, around.maps.at(map));
  return dressing;
}

bool plants_trees(const Scene& scene, const ScatterSettings& scatter) {
  return scatter.density > 0 && tree_share(scene, scatter) > 0;
}

Grid<float> tree_density(const Scene& scene, const Heightfield& field,
                         const std::map<std::string, Grid<float>>& maps, Progress& progress) {
  Grid<float> density;
  for (std::size_t k = 0; k < scene.scatter.size(); ++k) {
    ScatterSettings scatter = scene.scatter[k];
    const double trees = scatter.density * tree_share(scene, scatter);
    if (!(trees > 0)) continue;
    scatter.where.within = 0;
    const Heightfield mask = scene_map(scene, scatter.mask.path, field, maps,
                                       TerrainDomain{field.origin, field.size()}, progress);
    const SuitabilityMap suits = scatter_suitability(
        field, scatter, {.mask = mask.height.empty() ? nullptr : &mask}, scatter_seed(scene, k));
    if (density.empty()) density = Grid<float>(field.height.width(), field.height.height(), 0);
    parallel_for(0, density.height(), [&](int j) {
      for (int i = 0; i < density.width(); ++i)
        density(i, j) +=
            static_cast<float>(trees) * suits.at(field.origin + field.cell * DVec2(i, j)).part;
    });
  }
  return density;
}

}  // namespace wold
