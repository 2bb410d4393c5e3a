#pragma once
// A plant's mesh at every level of detail, ready to be drawn.
//
// Stochastic simplification of aggregate detail (Cook, Halstead, Planck, Ryu, "Stochastic
// simplification of aggregate detail", ACM TOG 26(3), 2007): the leaves stand in a random order,
// fixed once; of a level with share λ those of rank below λ are drawn, enlarged so that their area
// stays what it was. All levels are beginnings of one list of triangles, and between them nothing
// jumps: a leaf of rank r shrinks by
//   f(r) = clamp((λ (1 + τ) - r) / (τ λ), 0, 1),   τ = 1/4,
// before it goes, and the others grow by 1 / ∫ f² dr in area (1 / ∫ f dr where only the width
// changes). A needle or blade first grows in width, until it is 2/5 as wide as long, then in both.
//
// There are two such lists. `fine` has the mesh itself. `coarse`, for where a pixel is wider than a
// twig, has thin branches and bent blades as strips along their middle line with half the surface
// of the tube (which shows as much as the tube, on average over all directions), in random order as
// the leaves, and the few thick branches, which stay, as tubes of few sides.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "render/world.hpp"

namespace wold {

/// A vertex as it lies in a buffer. `across` and `along` are its offsets from the middle of its
/// leaf, as halves, in m.
struct PlantVertex {
  Vec3 position{0};                       ///< m, of the model
  std::uint32_t identity = 0;             ///< slot in PlantLevels::materials << 24 | leaf
  std::array<std::uint16_t, 4> across{};  ///< w: length over width of the leaf, see `aspect_…`
  std::array<std::uint16_t, 4> along{};   ///< w: rank in [0, 1)
  std::array<std::int8_t, 4> normal{};    ///< times 127
  std::array<std::int8_t, 4> light{};     ///< PlantOpenness: moment times 63, mean times 127
};
static_assert(sizeof(PlantVertex) == 40);

inline constexpr float aspect_fixed = 0;       ///< neither goes nor grows
inline constexpr float aspect_strip = 3.0e4F;  ///< changes in width alone
inline constexpr float plant_fade = 0.25F;     ///< τ

/// Triangles [0, count) of a list serve every share up to `share`.
struct PlantLevel {
  float share = 1;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
};

struct PlantLevels {
  std::vector<PlantVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> materials;  ///< of the slots: indices in World::materials
  std::vector<PlantLevel> fine;          ///< by falling share, halving by two
  std::vector<PlantLevel> coarse;
  float fine_pixel = 0;  ///< m; a pixel up to this shows `fine`
  float area = 0;        ///< m² of leaves and of half the wood: what is seen from all sides
  float extinction = 0;  ///< 1/m, PlantOpenness::mean_extinction
  Vec3 low{0};
  Vec3 high{0};

  /// The level with the least share that is no less than `share`.
  const PlantLevel& level(bool is_fine, float share) const;
};

/// Of one model. Depends on nothing but the model.
PlantLevels plant_levels(const Model& model, const std::vector<SurfaceMaterial>& materials);

/// Of all models, in parallel. Throws Error(cancelled).
std::vector<PlantLevels> plant_levels(const World& world, Progress& progress);

}  // namespace wold
