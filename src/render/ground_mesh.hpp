#pragma once
// The ground diced for a camera: a quadtree of square tiles, each a small grid, whose samples lie
// about as far apart as a given number of pixels seen from the camera.
//
// Tiles of different fineness do not share all border samples; a skirt hangs from each border and
// hides the cracks, which are narrower than a pixel.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/progress.hpp"
#include "render/camera.hpp"
#include "render/ground.hpp"

namespace wold {

inline constexpr int ground_tile_cells = 32;
/// Samples on a side of a tile, with its skirts.
inline constexpr int ground_tile_samples = ground_tile_cells + 3;

struct GroundTile {
  DVec2 low{0};     ///< south-west corner
  double size = 0;  ///< m
  double spacing() const { return size / ground_tile_cells; }
};

struct GroundDicing {
  float spacing_pixels = 2;     ///< between samples, in view
  float spacing_outside = 10;   ///< out of view, which only shadows and indirect light see
  float least_spacing = 0.02F;  ///< m
  float most_spacing = 1e9F;    ///< m
  std::uint64_t most_tiles = 40000;
};

/// Tiles that cover the ground for a camera, in a fixed order; the fineness is lowered as a whole
/// until no more than `most_tiles` are needed.
std::vector<GroundTile> dice_ground(const Ground& ground, const Camera& camera,
                                    const CameraRays& rays, const GroundDicing& dicing);

/// Tiles of one size, for tests of visibility from many places.
std::vector<GroundTile> dice_ground_evenly(const Ground& ground, double spacing);

/// Positions, row by row, ground_tile_samples² of them, of one tile; `out` has room for them.
void tile_positions(const Ground& ground, const GroundTile& tile, Vec3* out);

}  // namespace wold
