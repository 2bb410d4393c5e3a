#include "terrain/diamond_square.hpp"

#include <algorithm>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "terrain/resample.hpp"

namespace wold {

namespace {

/// The map while it grows.
struct Lattice {
  Grid<float> height;
  std::uint64_t seed;

  float draw(int i, int j, float spread) const {
    return spread * (2 * uniform(random_bits(seed, i, j)) - 1);
  }

  void diamond(int i, int j, int half, float spread) {
    const float sum = height(i - half, j - half) + height(i + half, j - half) +
                      height(i - half, j + half) + height(i + half, j + half);
    height(i, j) = sum / 4 + draw(i, j, spread);
  }

  void square(int i, int j, int half, float spread) {
    float sum = 0;
    int count = 0;
    const auto add = [&](int x, int y) {
      if (x < 0 || y < 0 || x >= height.width() || y >= height.height()) return;
      sum += height(x, y);
      ++count;
    };
    add(i - half, j);
    add(i + half, j);
    add(i, j - half);
    add(i, j + half);
    height(i, j) = sum / static_cast<float>(count) + draw(i, j, spread);
  }
};

void move_lowest_to_zero(Grid<float>& height) {
  const std::span<float> values = height.values();
  const float lowest = *std::min_element(values.begin(), values.end());
  for (float& h : values) h -= lowest;
}

}  // namespace

Description<DiamondSquare> describe(const DiamondSquare&) {
  using D = DiamondSquare;
  return Description<D>("diamond_square", "Ground by repeated halving with random displacement.")
      .add("levels", &D::levels, {.min = 1, .max = 13},
           "N: the map has 2^N + 1 samples along a side.")
      .add("corner_height", &D::corner_height, {.unit = "m", .min = 0, .max = 20000},
           "The corners lie at most so far above or below the mean.")
      .add("spread", &D::spread, {.unit = "m", .min = 0, .max = 20000},
           "Largest displacement at the first level.")
      .add("spread_reduction", &D::spread_reduction, {.min = 0, .max = 0.999},
           "Displacement of a level as a part of that of the level before; less is smoother.")
      .add("size", &D::size, {.unit = "m", .min = 0, .max = 1e6},
           "Side of the map, around the middle of the terrain; 0 for the whole terrain.");
}

Grid<float> diamond_square_map(const DiamondSquare& parameters, std::uint64_t seed,
                               Progress& progress) {
  const int last = 1 << parameters.levels;
  Lattice lattice{Grid<float>(last + 1, last + 1), seed};
  for (const int j : {0, last})
    for (const int i : {0, last})
      lattice.height(i, j) = lattice.draw(i, j, parameters.corner_height);
  float spread = parameters.spread;
  for (int half = last / 2; half > 0; half /= 2) {
    progress.check();
    const int squares = last / (2 * half);
    parallel_for(0, squares, [&](int row) {
      for (int column = 0; column < squares; ++column)
        lattice.diamond((2 * column + 1) * half, (2 * row + 1) * half, half, spread);
    });
    parallel_for(0, 2 * squares + 1, [&](int row) {
      for (int i = row % 2 == 0 ? half : 0; i <= last; i += 2 * half)
        lattice.square(i, row * half, half, spread);
    });
    spread *= parameters.spread_reduction;
  }
  move_lowest_to_zero(lattice.height);
  return std::move(lattice.height);
}

Heightfield diamond_square(const Heightfield& input, const DiamondSquare& parameters,
                           const TerrainContext& context) {
  TerrainDomain place = context.domain;
  if (parameters.size > 0) {
    place.size = DVec2(static_cast<double>(parameters.size));
    place.origin = context.domain.center() - 0.5 * place.size;
  }
  return {resample(diamond_square_map(parameters, context.seed, context.progress), place,
                   Outside::mirror, input, context.progress),
          input.origin, input.cell};
}

}  // namespace wold
