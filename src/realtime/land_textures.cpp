#include "realtime/land_textures.hpp"

#include <algorithm>
#include <span>

namespace wold {

namespace {

/// Each sample the mean of four.
std::vector<float> halved(const std::vector<float>& fine, int width, int height) {
  const int w = std::max(1, width / 2);
  const int h = std::max(1, height / 2);
  std::vector<float> out;
  const auto at = [&](int i, int j) {
    return fine[static_cast<std::size_t>(std::min(j, height - 1)) *
                    static_cast<std::size_t>(width) +
                static_cast<std::size_t>(std::min(i, width - 1))];
  };
  for (int j = 0; j < h; ++j)
    for (int i = 0; i < w; ++i)
      out.push_back(0.25F * (at(2 * i, 2 * j) + at(2 * i + 1, 2 * j) + at(2 * i, 2 * j + 1) +
                             at(2 * i + 1, 2 * j + 1)));
  return out;
}

/// Calls body(level, channels) from the finest level on; each channel has the level's samples.
template <class Body>
void each_level(std::vector<std::vector<float>> channels, int width, int height, const Body& body) {
  for (int level = 0;; ++level) {
    body(level, channels);
    if (width == 1 && height == 1) return;
    for (std::vector<float>& c : channels) c = halved(c, width, height);
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
  }
}

std::vector<float> interleaved(const std::vector<float>& a, const std::vector<float>& b) {
  std::vector<float> out;
  out.reserve(2 * a.size());
  for (std::size_t k = 0; k < a.size(); ++k) out.insert(out.end(), {a[k], b[k]});
  return out;
}

template <class Value>
std::vector<float> samples(const HeightMap& map, const Value& value) {
  std::vector<float> out;
  out.reserve(map.samples.size());
  for (int j = 0; j < map.height; ++j)
    for (int i = 0; i < map.width; ++i) out.push_back(value(i, j));
  return out;
}

GpuTexture height_texture(const HeightMap& map) {
  GpuTexture texture(map.width, map.height,
                     {.format = PixelFormat::r32f, .filter = TextureFilter::nearest, .levels = 0});
  each_level({samples(map, [&](int i, int j) { return map.at(i, j); })}, map.width, map.height,
             [&](int level, const auto& channels) {
               texture.upload(std::span<const float>(channels[0]), 0, level);
             });
  return texture;
}

GpuTexture water_texture(const LandMap& map) {
  const HeightMap& heights = map.heights;
  GpuTexture texture(heights.width, heights.height,
                     {.format = PixelFormat::rg32f, .filter = TextureFilter::nearest, .levels = 0});
  const auto seen = [&](int i, int j) { return std::max(heights.at(i, j), map.water_level(i, j)); };
  const auto wet = [&](int i, int j) { return map.water->at(i, j) > 0 ? 1.0F : 0.0F; };
  each_level({samples(heights, seen), samples(heights, wet)}, heights.width, heights.height,
             [&](int level, const auto& channels) {
               texture.upload(std::span<const float>(interleaved(channels[0], channels[1])), 0,
                              level);
             });
  const auto level = [&](int i, int j) { return map.water_level(i, j); };
  texture.upload(
      std::span<const float>(interleaved(samples(heights, level), samples(heights, wet))));
  return texture;
}

/// Planes of bytes, one after the other.
GpuTexture byte_texture(const std::vector<std::uint8_t>& planes, int count, PixelFormat format,
                        const HeightMap& size) {
  GpuTexture texture(size.width, size.height,
                     {.format = format, .filter = TextureFilter::mipmap, .levels = 0});
  const std::size_t n = size.samples.size();
  std::vector<std::uint8_t> texels;
  texels.reserve(planes.size());
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t b = 0; b < static_cast<std::size_t>(count); ++b)
      texels.push_back(planes[b * n + k]);
  texture.upload(std::span<const std::uint8_t>(texels));
  texture.make_mipmaps();
  return texture;
}

}  // namespace

LandTextures::LandTextures(const LandMap& map) : heights_(height_texture(map.heights)) {
  if (map.water) water_ = water_texture(map);
  if (!map.covers.empty()) covers_ = byte_texture(map.covers, 4, PixelFormat::rgba8, map.heights);
  if (!map.trees.empty()) trees_ = byte_texture(map.trees, 1, PixelFormat::r8, map.heights);
}

void LandTextures::bind(const GpuProgram& program, int first) const {
  const auto bind = [&](const char* name, const GpuTexture& texture, int unit) {
    if (!texture) return;
    texture.bind(unit);
    program.set(name, unit);
  };
  bind("height_map", heights_, first);
  bind("water_map", water_, first + 1);
  bind("cover_map", covers_, first + 2);
  bind("tree_map", trees_, first + 3);
}

}  // namespace wold
