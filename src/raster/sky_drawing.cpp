#include "raster/sky_drawing.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "raster/scene_light.hpp"
#include "sky/air_view.hpp"

namespace wold {

namespace {

GpuTexture height_texture(const std::vector<LightInAir>& light) {
  std::vector<float> texels;
  for (const bool multiple : {false, true})
    for (const LightInAir& l : light) {
      const Vec3 v = multiple ? l.multiple : l.sun;
      texels.insert(texels.end(), {v.x, v.y, v.z, 1});
    }
  GpuTexture texture(static_cast<int>(light.size()), 2, {.format = PixelFormat::rgba32f});
  texture.upload(texels);
  return texture;
}

}  // namespace

void apply_atmosphere(const GpuProgram& program, const std::string& name, const Atmosphere& a) {
  const auto field = [&name](const char* of) { return name + "." + of; };
  program.set(field("air").c_str(), static_cast<int>(a.air));
  program.set(field("air_height").c_str(), a.air_height);
  program.set(field("aerosol_scattering").c_str(), a.aerosol_scattering);
  program.set(field("aerosol_height").c_str(), a.aerosol_height);
  program.set(field("aerosol_albedo").c_str(), a.aerosol_albedo);
  program.set(field("aerosol_forward").c_str(), a.aerosol_forward);
  program.set(field("ozone").c_str(), a.ozone);
  program.set(field("planet_radius").c_str(), a.planet_radius);
  program.set(field("air_thickness").c_str(), a.air_thickness);
  program.set(field("ground_albedo").c_str(), a.ground_albedo);
}

void apply_clouds(const GpuProgram& program, const std::string& name, const Clouds& c) {
  const auto field = [&name](const char* of) { return name + "." + of; };
  program.set(field("coverage").c_str(), c.coverage);
  program.set(field("height").c_str(), c.height);
  program.set(field("thickness").c_str(), c.thickness);
  program.set(field("feature_size").c_str(), c.feature_size);
  program.set(field("billows").c_str(), c.billows);
  program.set(field("scattering").c_str(), c.scattering);
  program.set(field("absorption").c_str(), c.absorption);
  program.set(field("forward").c_str(), c.forward);
  program.set(field("back").c_str(), c.back);
  program.set(field("back_share").c_str(), c.back_share);
  program.set(field("orders").c_str(), c.orders);
  program.set(field("seed").c_str(), c.seed);
}

void apply_picture(const GpuProgram& program, const DrawView& view, const GpuTexture& depth,
                   int unit) {
  program.set("depth_picture", unit);
  depth.bind(unit);
  program.set("depth_range", stored_depth_range());
  program.set("eye", view.eye);
  program.set("forward", view.forward);
  program.set("right", view.right);
  program.set("above", view.above);
  program.set("nearest", view.nearest);
}

SkyDrawing::SkyDrawing(const Sky& sky)
    : composite_(full_screen_program("raster/composite.frag.glsl")) {
  set_sky(sky);
}

void SkyDrawing::set_sky(const Sky& sky) {
  parts_ = sky.parts();
  sun_direction_ = sky.sun_direction();
  clear_sky_ = sky_texture(*parts_.behind_clouds);
  if (parts_.air != nullptr) air_table_ = sky_texture(*parts_.air);
  if (parts_.air_view != nullptr)
    light_by_height_ = height_texture(parts_.air_view->light_by_height());
}

void SkyDrawing::apply_air(const GpuProgram& program, int first_unit) const {
  const bool any = parts_.haze->enabled();
  program.set("air_kind", !any ? 0 : parts_.air_view == nullptr ? 1 : 2);
  program.set("haze.molecules", parts_.haze->molecules());
  program.set("haze.aerosol", parts_.haze->aerosol());
  program.set("haze.molecules_height", Haze::molecules_height());
  program.set("haze.aerosol_height", parts_.haze->aerosol_height());
  program.set("sun_direction", sun_direction_);
  apply_atmosphere(program, "planet", parts_.planet);
  program.set("air_table", first_unit);
  program.set("light_by_height", first_unit + 1);
  if (air_table_) air_table_.bind(first_unit);
  if (light_by_height_) light_by_height_.bind(first_unit + 1);
}

void SkyDrawing::draw_clouds(const Frame& frame, int width, int height) {
  if (!cloud_program_) cloud_program_ = full_screen_program("raster/clouds.frag.glsl");
  const auto scaled = [&](int size) {
    return std::max(1, static_cast<int>(std::lround(static_cast<float>(size) * frame.cloud_scale)));
  };
  if (!clouds_ || clouds_.width() != scaled(width) || clouds_.height() != scaled(height))
    clouds_ = GpuTarget(scaled(width), scaled(height), std::array{PixelFormat::rgba16f}, false);
  clouds_.bind();
  apply_picture(cloud_program_, *frame.view, *frame.depth, 0);
  apply_air(cloud_program_, 1);
  apply_clouds(cloud_program_, "clouds", parts_.clouds->clouds());
  cloud_program_.set("sun_on_clouds", parts_.sun_on_clouds);
  cloud_program_.set("sky_on_clouds", parts_.sky_on_clouds);
  cloud_program_.set("cloud_steps", frame.clouds.along);
  cloud_program_.set("cloud_light_steps", frame.clouds.to_sun);
  cloud_program_.set("start_turn", 0.61803399F * static_cast<float>(frame.number % 256));
  draw_full_screen();
}

void SkyDrawing::draw(const Frame& frame, const GpuTarget& out) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  const bool clouds = parts_.clouds != nullptr;
  if (clouds) draw_clouds(frame, out.width(), out.height());
  out.bind();
  apply_picture(composite_, *frame.view, *frame.depth, 0);
  apply_air(composite_, 1);
  composite_.set("surfaces", 3);
  frame.surfaces->bind(3);
  composite_.set("sky_table", 4);
  clear_sky_.bind(4);
  composite_.set("has_clouds", clouds);
  composite_.set("cloud_light", 5);
  if (clouds) clouds_.color().bind(5);
  composite_.set("sun_centre", parts_.sun_centre);
  composite_.set("limb_exponent", parts_.limb_exponent);
  composite_.set("sun_chord", parts_.sun_chord);
  draw_full_screen();
}

}  // namespace wold
