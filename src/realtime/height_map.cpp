#include "realtime/height_map.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

/// The mean height of the field about a place, over a square of this many samples.
float mean_about(const Heightfield& field, double x, double y, double samples) {
  const auto low = [](double c, double half) { return static_cast<int>(std::ceil(c - half)); };
  const auto high = [](double c, double half) { return static_cast<int>(std::floor(c + half)); };
  const double half = 0.5 * samples;
  if (half < 0.75) return height_at(field, field.origin + field.cell * DVec2(x, y));
  double sum = 0;
  int count = 0;
  for (int j = low(y, half); j <= high(y, half); ++j)
    for (int i = low(x, half); i <= high(x, half); ++i) {
      const int ci = std::clamp(i, 0, field.height.width() - 1);
      const int cj = std::clamp(j, 0, field.height.height() - 1);
      sum += static_cast<double>(field.height(ci, cj));
      ++count;
    }
  return static_cast<float>(sum / std::max(count, 1));
}

}  // namespace

HeightMap height_map(const std::vector<float>& heights, int width, int height, double cell) {
  HeightMap map{width, height, cell, {}, {}};
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  map.heights = {*low, std::max(*high, *low + 1)};
  map.samples.reserve(heights.size());
  for (const float h : heights) {
    const float share = (h - map.heights.low) / (map.heights.high - map.heights.low);
    map.samples.push_back(static_cast<std::uint16_t>(std::lround(65535 * share)));
  }
  return map;
}

HeightMap height_map(const Heightfield& field, int most_samples) {
  const int longest = std::max(field.height.width(), field.height.height());
  const double ratio = std::max(1.0, double{longest - 1.0} / (most_samples - 1));
  const int width =
      std::max(2, static_cast<int>(std::lround((field.height.width() - 1) / ratio)) + 1);
  const int height =
      std::max(2, static_cast<int>(std::lround((field.height.height() - 1) / ratio)) + 1);
  const double step_x = double{field.height.width() - 1.0} / (width - 1);
  const double step_y = double{field.height.height() - 1.0} / (height - 1);
  std::vector<float> heights;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      heights.push_back(mean_about(field, i * step_x, j * step_y, ratio));
  return height_map(heights, width, height, field.size().x / (width - 1));
}

}  // namespace wold
