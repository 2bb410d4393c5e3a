#include "raster/terrain_shade.hpp"

#include <algorithm>

namespace wold {

namespace {

GpuTexture texture_of(int width, int height, std::span<const float> values, PixelFormat format) {
  GpuTexture texture(width, height, {.format = format, .filter = TextureFilter::nearest});
  texture.upload(values);
  return texture;
}

GpuTexture texture_of(const SunShadowMap::Layer& layer) {
  if (layer.edges.empty()) return texture_of(1, 1, std::vector<float>(2, 0), PixelFormat::rg32f);
  std::vector<float> values;
  values.reserve(2 * layer.edges.size());
  for (const Vec2& e : layer.edges.values()) {
    values.push_back(e.x);
    values.push_back(e.y);
  }
  return texture_of(layer.edges.width(), layer.edges.height(), values, PixelFormat::rg32f);
}

/// Origin, cells per metre, and whether there is one.
Vec4 place_of(DVec2 origin, double cell, bool empty) {
  return empty ? Vec4(0) : Vec4(Vec2(origin), static_cast<float>(1 / cell), 1);
}

}  // namespace

TerrainShade::TerrainShade()
    : sun_field_(texture_of(SunShadowMap::Layer{})),
      sun_around_(texture_of(SunShadowMap::Layer{})),
      sky_(texture_of(1, 1, std::vector<float>(2, 1), PixelFormat::rg32f)) {}

void TerrainShade::set(const SunShadowMap& shadows) {
  const SunShadowMap::Layer& field = shadows.field();
  const SunShadowMap::Layer& around = shadows.around();
  sun_field_ = texture_of(field);
  sun_around_ = texture_of(around);
  places_[0] = place_of(field.origin, field.cell, field.edges.empty());
  places_[1] = place_of(around.origin, around.cell, around.edges.empty());
}

void TerrainShade::set(const SkyVisibility& visibility) {
  const Heightfield& field = visibility.field();
  const Heightfield& around = visibility.around();
  // Field and surroundings in two channels of one texture.
  const int width = std::max(field.height.width(), around.height.width());
  const int height = std::max(field.height.height(), around.height.height());
  std::vector<float> values(2 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                            1);
  const auto put = [&](const Grid<float>& grid, std::size_t channel) {
    for (int j = 0; j < (grid.empty() ? 0 : height); ++j)
      for (int i = 0; i < width; ++i)
        values[2 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(i)) +
               channel] = grid.clamped(i, j);
  };
  put(field.height, 0);
  put(around.height, 1);
  sky_ = texture_of(width, height, values, PixelFormat::rg32f);
  places_[2] = place_of(field.origin, field.cell, field.height.empty());
  places_[3] = place_of(around.origin, around.cell, around.height.empty());
}

void TerrainShade::apply(const GpuProgram& program, int first_unit) const {
  program.set("sun_edges_field", first_unit);
  program.set("sun_edges_around", first_unit + 1);
  program.set("sky_shares", first_unit + 2);
  sun_field_.bind(first_unit);
  sun_around_.bind(first_unit + 1);
  sky_.bind(first_unit + 2);
  program.set("terrain_shade_places", std::span<const Vec4>(places_));
}

}  // namespace wold
