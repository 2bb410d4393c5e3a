#include "raster/scene_light.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sky/sky_table.hpp"

namespace wold {

namespace {

/// The harmonics without their constants, in the order of "raster/light.glsl".
std::array<float, 9> harmonics_at(Vec3 n) {
  return {
      1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
}

/// Squares of the constants of the harmonics, times those of the cosine in their band: π, 2π/3,
/// π/4.
std::array<double, 9> harmonic_factors() {
  const double zero = 1 / (4 * pi_d) * pi_d;
  const double one = 3 / (4 * pi_d) * (2 * pi_d / 3);
  const double two = 15 / (4 * pi_d) * (pi_d / 4);
  return {zero, one, one, one, two, two, two / 12, two, two / 4};
}

}  // namespace

std::array<Vec3, 9> sky_harmonics(const Sky& sky) {
  constexpr int rows = 128;  // even in the sine of elevation
  constexpr int columns = 128;
  std::array<DVec3, 9> sums{};
  for (int j = 0; j < rows; ++j) {
    const float z = 2 * (static_cast<float>(j) + 0.5F) / rows - 1;
    const float across = std::sqrt(1 - z * z);
    for (int i = 0; i < columns; ++i) {
      const float turn = 2 * pi * (static_cast<float>(i) + 0.5F) / columns;
      const Vec3 d(across * std::cos(turn), across * std::sin(turn), z);
      const DVec3 radiance(sky.radiance(d));
      const std::array<float, 9> y = harmonics_at(d);
      for (std::size_t k = 0; k < 9; ++k) sums[k] += static_cast<double>(y[k]) * radiance;
    }
  }
  const std::array<double, 9> factors = harmonic_factors();
  std::array<Vec3, 9> out{};
  for (std::size_t k = 0; k < 9; ++k)
    out[k] = Vec3(sums[k] * (factors[k] * 4 * pi_d / (rows * columns)));
  return out;
}

Vec3 radiance_below(const Sky& sky) {
  constexpr int rows = 32;
  constexpr int columns = 64;
  DVec3 sum(0);
  for (int j = 0; j < rows; ++j) {
    // Even by cosine: in the square of the sine.
    const float z = -std::sqrt((static_cast<float>(j) + 0.5F) / rows);
    const float across = std::sqrt(1 - z * z);
    for (int i = 0; i < columns; ++i) {
      const float turn = 2 * pi * (static_cast<float>(i) + 0.5F) / columns;
      sum += DVec3(sky.radiance({across * std::cos(turn), across * std::sin(turn), z}));
    }
  }
  return Vec3(sum / double{rows * columns});
}

namespace {

GpuTexture color_texture(const Grid<Vec3>& colors, bool repeat) {
  std::vector<float> texels;
  texels.reserve(4 * colors.size());
  for (const Vec3& c : colors.values()) texels.insert(texels.end(), {c.x, c.y, c.z, 1});
  GpuTexture texture(colors.width(), colors.height(),
                     {.format = PixelFormat::rgba32f, .repeat = repeat});
  texture.upload(texels);
  return texture;
}

}  // namespace

GpuTexture sky_texture(const Grid<Vec3>& nodes) {
  // Rows do not repeat, but the outermost lie at zenith and nadir, where a mistake of half a texel
  // across them is not seen.
  return color_texture(nodes, true);
}

SceneLight::SceneLight(Sky sky, const ShadowSettings& shadows)
    : sky_(std::move(sky)), shadows_(shadows) {
  set_sky(sky_);
  set_land_colors({});
}

void SceneLight::set_sky(Sky sky) {
  sky_ = std::move(sky);
  harmonics_ = sky_harmonics(sky_);
  below_ = radiance_below(sky_);
  table_ = sky_texture(*sky_.parts().radiance);
}

void SceneLight::set_canopy(const CanopyShade& canopy) {
  canopy_place_ = canopy.place;
  if (canopy.texels.empty()) return;
  canopy_map_ = GpuTexture(canopy.width, canopy.height, {.format = PixelFormat::rgba32f});
  canopy_map_.upload(canopy.texels);
}

void SceneLight::set_undergrowth(const CanopyShade& undergrowth) {
  undergrowth_place_ = undergrowth.place;
  if (undergrowth.texels.empty()) return;
  if (!undergrowth_map_)
    undergrowth_map_ =
        GpuTexture(undergrowth.width, undergrowth.height, {.format = PixelFormat::rgba32f});
  undergrowth_map_.upload(undergrowth.texels);
}

void SceneLight::set_land_colors(const LandColors& colors) {
  land_place_ = colors.place;
  land_colors_ = color_texture(colors.reflectance, false);
}

void SceneLight::apply(const GpuProgram& program) const {
  program.set("sun_direction", sky_.sun_direction());
  program.set("sun_irradiance", sky_.sun_visible() ? sky_.sun_irradiance() : Vec3(0));
  program.set("sky_harmonics", std::span<const Vec3>(harmonics_));
  program.set("sky_table", first_light_unit);
  table_.bind(first_light_unit);
  shadows_.apply(program, first_light_unit + 1, 2.4F * static_cast<float>(frame_ % 64));
  program.set("canopy_map", first_light_unit + 2);
  program.set("canopy_place", canopy_place_);
  if (canopy_map_) canopy_map_.bind(first_light_unit + 2);
  program.set("undergrowth_map", first_light_unit - 1);
  program.set("undergrowth_place", undergrowth_place_);
  if (undergrowth_map_) undergrowth_map_.bind(first_light_unit - 1);
  terrain_shade_.apply(program, first_light_unit + 3);
  program.set("radiance_below", below_);
  program.set("land_colors", first_light_unit + 3 + TerrainShade::units);
  program.set("land_place", land_place_);
  land_colors_.bind(first_light_unit + 3 + TerrainShade::units);
}

}  // namespace wold
