#include "realtime/land_map.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace wold {

namespace {

// The shader's trees stand in cells of 7 m; where every cell has one, the ground is full.
constexpr float full_woods = 1.15F / (7 * 7);  // per m²

std::uint8_t byte_of(float share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F)));
}

/// The samples of a map as those of the land it is made from.
struct Samples {
  const Heightfield& field;
  int width;
  int height;

  DVec2 step() const { return field.size() / DVec2(width - 1, height - 1); }
  DVec2 place(int i, int j) const { return field.origin + step() * DVec2(i, j); }
  std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  /// Calls body(k, place) for every sample, in parallel.
  template <class Body>
  void each(const Body& body) const {
    parallel_for(0, height, [&](int j) {
      for (int i = 0; i < width; ++i)
        body(static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(i),
             place(i, j));
    });
  }
};

/// Where a sample of the map stands for several of the land, water counts where it covers half.
float water_over(const Heightfield& field, const Heightfield& levels, DVec2 place, double reach) {
  const int across = std::max(1, static_cast<int>(std::lround(reach / field.cell)));
  float wet_level = 0;
  float dry_level = 0;
  int wet = 0;
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < across; ++i) {
      const DVec2 part = (DVec2(i, j) + 0.5) / static_cast<double>(across) - 0.5;
      const DVec2 at = glm::clamp(place + reach * part, field.origin, field.origin + field.size());
      const float level = height_at(levels, at);
      const bool is_wet = level > height_at(field, at);
      wet += is_wet ? 1 : 0;
      (is_wet ? wet_level : dry_level) += level;
    }
  const int all = across * across;
  return 2 * wet >= all ? wet_level / static_cast<float>(wet)
                        : dry_level / static_cast<float>(all - wet);
}

HeightMap water_map(const Samples& samples, const HeightMap& heights, const Heightfield& levels) {
  std::vector<float> over(samples.count());
  const double reach = samples.step().x;
  samples.each([&](std::size_t k, DVec2 place) {
    const auto width = static_cast<std::size_t>(samples.width);
    const float ground = heights.at(static_cast<int>(k % width), static_cast<int>(k / width));
    over[k] = water_over(samples.field, levels, place, reach) - ground;
  });
  return height_map(over, samples.width, samples.height, heights.cell);
}

std::vector<std::uint8_t> cover_map(const Samples& samples, const std::vector<CoverLayer>& covers) {
  struct Cover {
    Vec3 color{0};
    float share = 0;
  };
  std::vector<Cover> laid(samples.count());
  samples.each([&](std::size_t k, DVec2 place) {
    Cover& c = laid[k];
    for (const CoverLayer& layer : covers) {
      const float share = layer.share(place, 0);
      const float feature = 1000 * layer.settings().feature_size;
      c.color = glm::mix(c.color, layer.color(Vec3(place, 0), feature), share);
      c.share += share * (1 - c.share);
    }
  });
  Cover all;
  for (const Cover& c : laid) {
    all.color += c.color;
    all.share += c.share;
  }
  if (!(all.share > 0)) return {};
  const std::size_t n = samples.count();
  std::vector<std::uint8_t> planes(4 * n);
  for (std::size_t k = 0; k < n; ++k) {
    // Bare places have the mean colour: what lies between them and covered ones is not dark.
    const Cover& c = laid[k].share > 0.004F ? laid[k] : all;
    for (std::size_t b = 0; b < 3; ++b)
      planes[b * n + k] = byte_of(std::sqrt(c.color[static_cast<int>(b)] / c.share));
    planes[3 * n + k] = byte_of(laid[k].share);
  }
  return planes;
}

std::vector<std::uint8_t> tree_map(const Samples& samples, const Grid<float>& density,
                                   const std::optional<HeightMap>& water) {
  const Heightfield trees{density, samples.field.origin, samples.field.cell};
  std::vector<std::uint8_t> shares(samples.count());
  const auto width = static_cast<std::size_t>(samples.width);
  samples.each([&](std::size_t k, DVec2 place) {
    if (water && water->at(static_cast<int>(k % width), static_cast<int>(k / width)) > 0) return;
    shares[k] = byte_of(height_at(trees, place) / full_woods);
  });
  return shares;
}

}  // namespace

LandMap land_map(const Heightfield& field, const GroundDressing& dressing, const Grid<float>& trees,
                 int most_samples) {
  LandMap map{height_map(field, most_samples), {}, {}, {}};
  const Samples samples{field, map.heights.width, map.heights.height};
  if (!dressing.inner_water.empty())
    map.water = water_map(samples, map.heights, dressing.inner_water.levels());
  if (map.water && map.water->heights.high <= 0) map.water.reset();
  if (!dressing.covers.empty()) map.covers = cover_map(samples, dressing.covers);
  if (!trees.empty()) map.trees = tree_map(samples, trees, map.water);
  return map;
}

}  // namespace wold
