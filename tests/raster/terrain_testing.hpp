#pragma once
// A small land with all that a ground can have: surroundings, water, covers, distant forest.

#include <cmath>
#include <random>
#include <vector>

#include "noise/fractal.hpp"
#include "render/ground.hpp"

namespace wold::testing {

inline Heightfield hills(int samples, double cell, DVec2 middle, float height) {
  Heightfield field;
  field.height = Grid<float>(samples, samples);
  field.cell = cell;
  field.origin = middle - 0.5 * field.size();
  const FractalSampler noise({.octaves = 6, .hurst = 0.9F}, 5);
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const DVec2 place = field.origin + cell * DVec2(i, j) - middle;
      field.height(i, j) = height * (1 + noise(place / 300.0, 0).value);
    }
  return field;
}

/// 640 m of field in 2.5 km of land, about `middle`.
inline Ground varied_ground(DVec2 middle = {0, 0}, const GroundMaterial* own = nullptr) {
  GroundMaterial material;
  material.rock_slope = {18, 30};
  material.snow_height = {150, 190};
  if (own != nullptr) material = *own;
  Heightfield field = hills(65, 10, middle, 100);
  Heightfield around = hills(65, 40, middle, 110);  // not as high as the field at its border
  GroundDressing dressing;
  Grid<float> depth(65, 65, 0.0F);
  for (int j = 20; j < 40; ++j)
    for (int i = 10; i < 30; ++i) depth(i, j) = 4;
  dressing.inner_water = WaterLayer(field, depth, 0.05F);
  dressing.outer_water = WaterLayer(around, depth, 0.05F);
  for (int k = 0; k < 3; ++k) {
    GroundCover cover;
    cover.range = {0.6F, 0.8F};
    cover.feather = 0.2F;
    cover.detail = k == 0 ? 0.3F : 1.0F;
    cover.roughness = k == 1 ? 0.3F : 0.0F;
    cover.over_snow = k == 2;
    cover.color1 = Vec3(0.1F * static_cast<float>(k + 1), 0.2F, 0.1F);
    Heightfield inner{Grid<float>(65, 65), field.origin, field.cell};
    Heightfield outer{Grid<float>(65, 65), around.origin, around.cell};
    for (int j = 0; j < 65; ++j)
      for (int i = 0; i < 65; ++i) {
        inner.height(i, j) = 0.5F + 0.5F * std::sin(0.3F * static_cast<float>(i + k * j));
        outer.height(i, j) = 0.5F + 0.5F * std::cos(0.2F * static_cast<float>(j - k * i));
      }
    if (k == 1) outer = {};
    dressing.covers.emplace_back(cover, std::move(inner), std::move(outer),
                                 static_cast<std::uint32_t>(40 + k));
  }
  return {std::move(field), std::move(around), material, 7, std::move(dressing)};
}

/// Uniform places over a square about `middle`.
inline std::vector<DVec2> places(std::size_t count, DVec2 middle, double half, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-half, half);
  std::vector<DVec2> list(count);
  for (DVec2& p : list) p = middle + DVec2(offset(random), offset(random));
  return list;
}

}  // namespace wold::testing
