#pragma once
// Which plants are drawn in a view, and how finely: chosen anew for each view, for a million plants
// in some milliseconds.
//
// A plant wants as many leaves as its crown covers pixels, and as many are drawn of it: its share
// is λ = q · `leaves_per_pixel` · pixels / leaves, at most 1, with one q <= 1 for all such that
// their triangles keep the budget (and one for small plants, which have their part of it and hide
// each other). Trees lower than `card_height` pixels are drawn as pictures (cards) instead, and in
// between as both, in parts. Of small plants not only leaves go but whole plants, in an order of
// their own, and those that stay grow wider, until at `small_distance` the last are gone.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parameters.hpp"
#include "raster/draw_view.hpp"
#include "raster/plant_levels.hpp"

namespace wold {

struct PlantDetail {
  int triangle_budget = 2'000'000;
  float leaves_per_pixel = 1;
  float card_height = 90;      ///< pixels
  float small_distance = 120;  ///< m
  float small_height = 1;      ///< m
  float shadow_share = 1;      ///< of the budget, for a shadow map
};

Description<PlantDetail> describe(const PlantDetail&);

/// A plant as the vertex shader gets it.
struct DrawnPlant {
  Vec3 position{0};  ///< m
  float scale = 1;
  Vec4 turn{0, 0, 0, 1};                ///< quaternion
  float share = 1;                      ///< of leaves that are drawn
  float fade = 1;                       ///< part of it that is drawn, the card taking the rest
  Vec2 texture{0};                      ///< its piece of the materials' textures, in [0, 1)²
  std::array<std::uint32_t, 2> bits{};  ///< of the individual, low and high
  float growth = 1;                     ///< in area, for others that were left out
  float crowd = 0;                      ///< leaf area of small plants per m² of ground here
  float crowd_height = 1;               ///< m, mean over that area
};
static_assert(sizeof(DrawnPlant) == 68);

/// Plants that are drawn by one call.
struct PlantBatch {
  enum class Kind : std::uint8_t { fine, coarse, card };
  Kind kind = Kind::coarse;
  std::uint32_t model = 0;
  std::uint32_t level = 0;  ///< in PlantLevels::fine or coarse
  std::uint32_t first = 0;  ///< in PlantChoice::plants
  std::uint32_t count = 0;
};

struct PlantChoice {
  std::vector<DrawnPlant> plants;
  std::vector<PlantBatch> batches;  ///< the finest, which are nearest, first
  std::uint64_t triangles = 0;
  float density = 1;  ///< q
};

/// Models as the choice sees them.
struct PlantSizes {
  Vec3 middle{0};    ///< m
  float radius = 0;  ///< m, about the middle, holds all at any share
  float height = 0;  ///< m
  float crown = 0;   ///< m², seen from the side
  float area = 0;    ///< m² of leaves
  bool card = false;
};

PlantSizes plant_sizes(const PlantLevels& levels);

/// Plants in their places, in cells for culling.
class PlantField {
 public:
  PlantField() = default;
  PlantField(std::span<const ModelInstance> instances, std::span<const PlantSizes> sizes);

  struct Plant {
    DrawnPlant drawn;
    std::uint32_t model = 0;
    float rank = 0;  ///< in [0, 1): the order in which small plants go
  };
  struct Cell {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    Vec3 low{0};
    Vec3 high{0};
  };
  const std::vector<Plant>& plants() const { return plants_; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::vector<Plant> plants_;
  std::vector<Cell> cells_;
};

/// Depends on the arguments alone, not on threads.
PlantChoice choose_plants(std::span<const PlantField* const> fields,
                          std::span<const PlantLevels> levels, std::span<const PlantSizes> sizes,
                          const DrawView& view, const PlantDetail& detail);

}  // namespace wold
