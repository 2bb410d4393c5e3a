#include "realtime/landscape_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "realtime/land_function.hpp"

namespace wold {

namespace {

/// As GLSL writes it.
std::string value_text(const Parameter& p, const LandscapeSettings& settings) {
  const Value value = p.get(&settings);
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "1" : "0";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  return glsl_number(std::get<double>(value));
}

std::string range_text(const Parameter& p) {
  if (p.kind == ParameterKind::boolean) return "0 or 1";
  const std::string unit = p.limits.unit.empty() ? "" : p.limits.unit + ", ";
  const auto text = [](double x) {
    return std::abs(x) >= 1e5 ? fmt::format("{:.0f}", x) : fmt::format("{:g}", x);
  };
  return fmt::format("{}{} to {}", unit, text(p.limits.min), text(p.limits.max));
}

Value value_of(const Parameter& p, std::string_view name, std::string_view text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end || !std::isfinite(number))
    throw Error(ErrorKind::usage,
                fmt::format("{} is a number ({}), not '{}'", name, range_text(p), text));
  const bool whole = number == std::floor(number) && std::abs(number) < 1e9;
  if (p.kind == ParameterKind::boolean && (number == 0 || number == 1)) return number == 1;
  if (p.kind == ParameterKind::integer && whole) return static_cast<std::int64_t>(number);
  if (p.kind == ParameterKind::number) return number;
  throw Error(ErrorKind::usage,
              fmt::format("{} is {}, not '{}'", name,
                          p.kind == ParameterKind::boolean ? "0 or 1" : "a whole number", text));
}

}  // namespace

Description<LandscapeSettings> describe(const LandscapeSettings&) {
  using S = LandscapeSettings;
  const Limits steps{.min = 1, .max = 4096};
  const Limits octaves{.min = 1, .max = 24};
  return Description<S>("shader", "Knobs of the landscape shader, #defines of what is exported.")
      .add("LOW_QUALITY", &S::low_quality, "A coarser set of knobs without clouds.")
      .add("MAX_RENDERING_DISTANCE", &S::max_rendering_distance,
           {.unit = "m", .min = 100, .max = 1e6}, "Where the land ends in haze.")
      .add("MAX_MARCHING_STEPS", &S::max_marching_steps, steps, "Steps to find the land.")
      .add("MAX_MARCHING_STEPS_SHADOW", &S::max_marching_steps_shadow, steps,
           "Steps from the land towards the sun.")
      .add("MARCHING_FACTOR", &S::marching_factor, {.min = 0.05, .max = 1},
           "Step by height above the land; less is surer and slower.")
      .add("EPSILON", &S::epsilon, {.min = 1e-5, .max = 0.01},
           "Height over distance at which the land counts as met.")
      .add("OCTAVES", &S::octaves, octaves, "Detail of the land: halvings of its largest features.")
      .add("OCTAVES_SHADOW", &S::octaves_shadow, octaves, "Detail of what casts shadows.")
      .add("OCTAVES_NORMAL", &S::octaves_normal, octaves, "Detail of the slopes that are lit.")
      .add("TEXTURE_LOW_QUALITY", &S::texture_low_quality, "Plainer stone.")
      .add("TEXTURE_FILTERING", &S::texture_filtering, "Averages colours over a pixel's footprint.")
      .add("FILTERING_SAMPLES", &S::filtering_samples, {.min = 1, .max = 8},
           "Its samples in one direction; the square of it in all.")
      .add("ATMOS_STEPS", &S::atmos_steps, {.min = 2, .max = 256}, "Steps through the air.")
      .add("ATMOS_LIGHT_STEPS", &S::atmos_light_steps, {.min = 1, .max = 64},
           "Steps from each of them to the sun.")
      .add("CLOUD_STEPS", &S::cloud_steps, {.min = 0, .max = 1024},
           "Steps through the clouds; 0 for none.")
      .add("CLOUD_LIGHT_STEPS", &S::cloud_light_steps, {.min = 1, .max = 64},
           "Steps from each of them to the sun.")
      .add("CLOUD_EVEN_STEPS", &S::cloud_even_steps,
           "Steps through clouds all alike, instead of short ones where a cloud begins.")
      .add("SUN_ELEVATION", &S::sun_elevation, {.unit = "degrees", .min = -90, .max = 90},
           "Height of the sun.")
      .add("SUN_AZIMUTH", &S::sun_azimuth, {.unit = "degrees", .min = -360, .max = 360},
           "Where the sun stands, from north by east.")
      .add("DAY_SPEED", &S::day_speed, {.unit = "degrees per s", .min = -90, .max = 90},
           "How fast the sun goes round; 0 stands still.")
      .add("SUN_SOFTNESS", &S::sun_softness, {.min = 0.001, .max = 0.5},
           "Size of the sun as shadows see it.")
      .add("EXPOSURE", &S::exposure, {.unit = "stops", .min = -10, .max = 10},
           "Brightness of the picture.")
      .add("TERRAIN_HEIGHT", &S::terrain_height, {.min = 0, .max = 10}, "Factor on heights.")
      .add("TERRAIN_SCALE", &S::terrain_scale, {.min = 0.1, .max = 10}, "Factor on widths.")
      .add("SMOOTH_RIDGES", &S::smooth_ridges, "Rounds the crests as the scene has them.")
      .add("TREES", &S::trees, {.min = 0, .max = 1},
           "Share of gentle slopes under trees; of land that is a map: of the scene's trees.")
      .add("CLOUD_COVERAGE", &S::cloud_coverage, {.min = 0, .max = 1},
           "Share of the sky under clouds.")
      .add("CLOUDS_HEIGHT", &S::clouds_height, {.unit = "m", .min = 0, .max = 20000},
           "Height of their base.")
      .add("CLOUDS_THICKNESS", &S::clouds_thickness, {.unit = "m", .min = 1, .max = 20000},
           "From the base to the highest tops.")
      .add("CLOUD_SIZE", &S::cloud_size, {.unit = "m", .min = 10, .max = 1e5},
           "From cloud to cloud.")
      .add("CLOUD_DENSITY", &S::cloud_density, {.min = 0, .max = 10}, "Factor on their density.")
      .add("CLOUD_SCATTERING", &S::cloud_scattering, {.unit = "per m", .min = 0, .max = 1},
           "Light that they scatter.")
      .add("CLOUD_ABSORPTION", &S::cloud_absorption, {.unit = "per m", .min = 0, .max = 1},
           "Light that they absorb.")
      .add("CLOUD_FORWARD", &S::cloud_forward, {.min = 0, .max = 0.99},
           "Phase function: mean cosine of the light that goes on.")
      .add("CLOUD_BACK", &S::cloud_back, {.min = -0.99, .max = 0},
           "The same of the light that turns back.")
      .add("CLOUD_BACK_SHARE", &S::cloud_back_share, {.min = 0, .max = 1},
           "Share of the light that turns back.")
      .add("WIND_SPEED", &S::wind_speed, {.unit = "m/s", .min = 0, .max = 1000},
           "How fast clouds drift east.")
      .add("CLOUD_SHADOWS", &S::cloud_shadows, {.min = 0, .max = 1},
           "How dark their shadows on the land are.")
      .add("CAM_HEIGHT", &S::cam_height, {.unit = "m", .min = 1, .max = 1e6},
           "Height of the flight above the land.")
      .add("CAM_SPEED", &S::cam_speed, {.unit = "m/s", .min = -1e4, .max = 1e4}, "Its speed.")
      .add("CAM_EAST", &S::cam_east, {.unit = "m", .min = -1e6, .max = 1e6},
           "Where it begins, east of the middle.")
      .add("CAM_NORTH", &S::cam_north, {.unit = "m", .min = -1e6, .max = 1e6}, "And north of it.")
      .add("CAM_DIRECTION", &S::cam_direction, {.unit = "degrees", .min = -360, .max = 360},
           "Where it goes, from north by east.")
      .add("CAM_TILT", &S::cam_tilt, {.unit = "degrees", .min = -89, .max = 89},
           "How far up it looks.")
      .add("FIELD_OF_VIEW", &S::field_of_view, {.unit = "degrees", .min = 5, .max = 150},
           "Across the longer side.");
}

LandscapeSettings low_quality(const LandscapeSettings& settings) {
  LandscapeSettings low = settings;
  const auto at_most = [](auto& value, auto limit) {
    value = std::min(value, static_cast<std::decay_t<decltype(value)>>(limit));
  };
  at_most(low.max_marching_steps, 140);
  at_most(low.max_marching_steps_shadow, 24);
  low.marching_factor = std::max(low.marching_factor, 0.65F);
  at_most(low.octaves, 8);
  at_most(low.octaves_shadow, 5);
  at_most(low.octaves_normal, 10);
  low.texture_low_quality = true;
  low.texture_filtering = false;
  at_most(low.atmos_steps, 8);
  at_most(low.atmos_light_steps, 2);
  low.cloud_steps = 0;
  low.cloud_shadows = 0;
  return low;
}

void set_knob(LandscapeSettings& settings, std::string_view define) {
  const std::size_t equals = define.find('=');
  const std::string name(define.substr(0, equals));
  const ParameterSet set = describe(settings);
  const Parameter* p = set.find(name);
  if (p == nullptr)
    throw Error(ErrorKind::usage,
                fmt::format("the shader has no knob '{}'.{}", name, suggestion(name, set.names())));
  if (equals == std::string_view::npos)
    throw Error(ErrorKind::usage, fmt::format("--define {0} wants a value, as in {0}={1}", name,
                                              value_text(*p, settings)));
  const Value value = value_of(*p, name, define.substr(equals + 1));
  try {
    set.assign(&settings, name, value);
  } catch (const Error& error) {
    throw Error(ErrorKind::usage, error.message());
  }
}

void set_knobs(LandscapeSettings& settings, const std::vector<std::string>& defines) {
  for (const std::string& define : defines) set_knob(settings, define);
}

std::vector<KnobLine> knob_lines(const LandscapeSettings& settings) {
  const ParameterSet set = describe(settings);
  const LandscapeSettings low = low_quality(settings);
  std::vector<KnobLine> lines;
  for (const Parameter& p : set.parameters)
    lines.push_back({p.name, value_text(p, settings), value_text(p, low),
                     fmt::format("{} ({})", p.text.substr(0, p.text.size() - 1), range_text(p))});
  return lines;
}

std::string knob_text(const LandscapeSettings& settings, const std::vector<std::string>& uniforms) {
  const auto line = [](const std::string& name, const std::string& value,
                       const std::string& comment) {
    const std::string define = fmt::format("#define {} {}", name, value);
    return comment.empty() ? define + "\n" : fmt::format("{:<44} // {}\n", define, comment);
  };
  const auto is_uniform = [&](const std::string& name) {
    return std::find(uniforms.begin(), uniforms.end(), name) != uniforms.end();
  };
  std::string both;
  std::string high;
  std::string low;
  std::string declared;
  for (const KnobLine& knob : knob_lines(settings)) {
    if (is_uniform(knob.name)) {
      std::string small = knob.name;
      std::transform(small.begin(), small.end(), small.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      declared += fmt::format("uniform float {};\n", small);
      both += line(knob.name, small, knob.comment);
    } else if (knob.value == knob.low_value) {
      both += line(knob.name, knob.value, knob.comment);
    } else {
      high += line(knob.name, knob.value, knob.comment);
      low += line(knob.name, knob.low_value, "");
    }
  }
  return declared + both + "#if LOW_QUALITY\n" + low + "#else\n" + high + "#endif\n";
}

}  // namespace wold
