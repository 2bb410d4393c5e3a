#pragma once
// The knobs of the landscape shader: each is a #define of what is exported, under this name.

#include <string>
#include <string_view>
#include <vector>

#include "base/parameters.hpp"

namespace wold {

struct LandscapeSettings {
  bool low_quality = false;

  float max_rendering_distance = 90000;  ///< m
  int max_marching_steps = 320;
  int max_marching_steps_shadow = 64;
  float marching_factor = 0.45F;
  float epsilon = 4e-4F;
  int octaves = 10;
  int octaves_shadow = 7;
  int octaves_normal = 14;
  bool texture_low_quality = false;
  bool texture_filtering = true;
  int filtering_samples = 2;
  int atmos_steps = 16;
  int atmos_light_steps = 4;
  int cloud_steps = 64;
  int cloud_light_steps = 12;
  bool cloud_even_steps = false;

  float sun_elevation = 30;  ///< degrees
  float sun_azimuth = 200;   ///< degrees
  float day_speed = 0;       ///< degrees per second
  float sun_softness = 0.02F;
  float exposure = 0;  ///< stops

  float terrain_height = 1;
  float terrain_scale = 1;
  bool smooth_ridges = true;
  float trees = 0;

  float cloud_coverage = 0.4F;
  float clouds_height = 2500;     ///< m
  float clouds_thickness = 1200;  ///< m
  float cloud_size = 2500;        ///< m
  float cloud_density = 1;
  float cloud_scattering = 0.03F;  ///< 1/m
  float cloud_absorption = 0;      ///< 1/m
  float cloud_forward = 0.7F;
  float cloud_back = -0.5F;
  float cloud_back_share = 0.3F;
  float wind_speed = 8;  ///< m/s
  float cloud_shadows = 0.6F;

  float cam_height = 250;    ///< m
  float cam_speed = 60;      ///< m/s
  float cam_east = 0;        ///< m
  float cam_north = 0;       ///< m
  float cam_direction = 0;   ///< degrees
  float cam_tilt = -4;       ///< degrees
  float field_of_view = 55;  ///< degrees
};

Description<LandscapeSettings> describe(const LandscapeSettings&);

/// With the values that LOW_QUALITY sets: coarser in all, and no clouds.
LandscapeSettings low_quality(const LandscapeSettings& settings);

/// Sets a knob from "NAME=VALUE". Throws Error(usage) for an unknown name, with the nearest one,
/// and for a value that is none or out of range.
void set_knob(LandscapeSettings& settings, std::string_view define);
/// Sets one after the other. Throws as set_knob.
void set_knobs(LandscapeSettings& settings, const std::vector<std::string>& defines);

/// One knob as a line of GLSL: its value, what it does and its range.
struct KnobLine {
  std::string name;
  std::string value;
  std::string low_value;  ///< with LOW_QUALITY
  std::string comment;
};
std::vector<KnobLine> knob_lines(const LandscapeSettings& settings);

/// The knobs as #defines with comments. Those named in `uniforms` become uniforms: floats of the
/// knob's name in small letters.
std::string knob_text(const LandscapeSettings& settings,
                      const std::vector<std::string>& uniforms = {});

}  // namespace wold
