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

/// The surroundings are bent to meet the terrain: still water there would stand aslant, and is left
/// out with its shores. Rivers follow the ground.
Grid<float> without_slanting(Grid<float> depth, const Heightfield& bed, const Heightfield& inner) {
  constexpr float least_tilt = 0.01F;
  constexpr int shore = 2;  // samples
  const Grid<float> before = depth;
  const float across = 1 / static_cast<float>(2 * bed.cell);
  const auto place = [&](int i, int j) { return bed.origin + bed.cell * DVec2(i, j); };
  const auto lift = [&](int i, int j) { return border_lift(inner, bed, place(i, j)); };
  const auto level = [&](int i, int j) { return bed.height.clamped(i, j) + before.clamped(i, j); };
  // To dry ground water does not fall.
  const auto step = [&](int i, int j, int di, int dj) {
    return before.clamped(i + di, j + dj) > 0 ? level(i + di, j + dj) - level(i, j) : 0.0F;
  };
  Grid<float> tilts(depth.width(), depth.height(), 0.0F);
  Grid<std::uint8_t> slanting(depth.width(), depth.height(), std::uint8_t{0});
  parallel_for(0, depth.height(), [&](int j) {
    for (int i = 0; i < depth.width(); ++i) {
      if (before(i, j) <= 0 || inner.contains(place(i, j))) continue;
      tilts(i, j) = glm::length(
          across * Vec2(lift(i + 1, j) - lift(i - 1, j), lift(i, j + 1) - lift(i, j - 1)));
      const Vec2 fall =
          across * Vec2(step(i, j, 1, 0) - step(i, j, -1, 0), step(i, j, 0, 1) - step(i, j, 0, -1));
      const bool still = glm::length(fall) < 0.3F * tilts(i, j);
      slanting(i, j) = tilts(i, j) > least_tilt && still ? 1 : 0;
    }
  });
  parallel_for(0, depth.height(), [&](int j) {
    for (int i = 0; i < depth.width(); ++i) {
      if (tilts(i, j) <= least_tilt) continue;
      for (int dj = -shore; dj <= shore; ++dj)
        for (int di = -shore; di <= shore; ++di)
          if (slanting.clamped(i + di, j + dj) != 0) depth(i, j) = 0;
    }
  });
  return depth;
}

/// Share of trees among the plants of a scatter.
double tree_share(const Scene& scene, const ScatterSettings& scatter) {
  const std::vector<double> shares = species_shares(scatter.species, scene.species, "scatter");
  double trees = 0;
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (is_tree(scene.species[k])) trees += shares[k];
  return trees;
}

}  // namespace

GroundDressing dress_ground(const Scene& scene, const TerrainResult& terrain,
                            const TerrainResult& around, Progress& progress) {
  GroundDressing dressing;
  const std::string& map = scene.water.depth.path;
  const auto found = around.maps.find(map);
  TerrainResult dry_around;
  if (found != around.maps.end()) {
    dry_around = around;
    dry_around.maps[map] = without_slanting(found->second, around.field, terrain.field);
    dressing.outer_water = water_of(scene, around, dry_around.maps[map]);
  }
  // Nor is there the gravel of water that is left out.
  dressing.covers =
      covers_of(scene, terrain, dressing.outer_water.empty() ? around : dry_around, progress);
  dressing.water = scene.water;
  dressing.inner_water = water_of(
      scene, terrain,
      scene_map(scene, map, terrain.field, terrain.maps, place_of(terrain), progress).height);
  return dressing;
}

bool is_tree(const SpeciesSettings& species) {
  return species.height.high >= least_tree;
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
