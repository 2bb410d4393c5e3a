#pragma once
// Numbers and pictures of a heightfield: range, slope, curvature, normals, hillshade.
//
// Derivatives are central differences over two cells (one-sided at the border, so that a plane has
// its own slope up to the edge):
//
//   h_x = (h(i+1, j) - h(i-1, j)) / 2c      slope = atan |(h_x, h_y)|
//   curvature = h_xx + h_yy                 (1/m; positive in hollows, negative on crests)

#include "terrain/heightfield.hpp"

namespace wold {

struct HeightStatistics {
  float min = 0;    ///< m
  float max = 0;    ///< m
  double mean = 0;  ///< m
};

/// The same for any number of threads. An empty field has zeros.
HeightStatistics height_statistics(const Heightfield& field);

/// dh/dx and dh/dy at a sample.
Vec2 gradient_at_sample(const Heightfield& field, int i, int j);

/// Steepness at a sample, degrees from level.
float slope_at_sample(const Heightfield& field, int i, int j);

/// Steepness, degrees from level.
Grid<float> slope_map(const Heightfield& field);

/// Laplacian of the height, 1/m.
Grid<float> curvature_map(const Heightfield& field);

/// Upward unit normals.
Grid<Vec3> normal_map(const Heightfield& field);

/// Light from a direction, for previews.
struct Hillshade {
  float azimuth = 315;     ///< degrees clockwise from north: where the light comes from
  float elevation = 40;    ///< degrees above the horizon
  float exaggeration = 1;  ///< of heights
  float ambient = 0.15F;   ///< brightness of what the light does not reach
};

/// Lambert's cosine, 0 to 1, without cast shadows.
Grid<float> hillshade(const Heightfield& field, const Hillshade& light = {});

}  // namespace wold
