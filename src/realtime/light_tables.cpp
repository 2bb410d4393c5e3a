#include "realtime/light_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "realtime/land_function.hpp"
#include "sky/haze.hpp"
#include "sky/sunlight.hpp"
#include "sky/sunlit_air.hpp"

namespace wold {

namespace {

constexpr int nodes = 17;
constexpr float lowest_root = -0.5F;   // of the sun's sine: 14° below the horizon
constexpr float upper_height = 12000;  // m
constexpr int rings = 12;
constexpr int angles = 8;

std::string vec3_text(Vec3 v) {
  return fmt::format("vec3({}, {}, {})", glsl_number(double{v.x}), glsl_number(double{v.y}),
                     glsl_number(double{v.z}));
}

float sine_of_node(int k) {
  const float root =
      lowest_root + (1 - lowest_root) * static_cast<float>(k) / static_cast<float>(nodes - 1);
  return std::copysign(root * root, root);
}

/// ∫ L cos dω of the sky over level ground.
Vec3 sky_on_ground(const SunlitAir& air, float sun_sine) {
  const float sun_across = std::sqrt(std::max(0.0F, 1 - sun_sine * sun_sine));
  Vec3 sum(0);
  for (int k = 0; k < rings * angles; ++k) {
    const int ring = k / angles;
    const float cosine = std::sqrt((static_cast<float>(ring) + 0.5F) / static_cast<float>(rings));
    const float turn = pi * (static_cast<float>(k % angles) + 0.5F) / static_cast<float>(angles);
    const float to_sun =
        cosine * sun_sine + std::sqrt(1 - cosine * cosine) * sun_across * std::cos(turn);
    const AirRay ray{0, cosine, sun_sine, to_sun};
    sum += with_phases(air.atmosphere(), air.seen(ray, INFINITY, 32), to_sun, Vec3(1)).light;
  }
  return sum * (pi / static_cast<float>(rings * angles));
}

std::string table(const std::string& name, const std::vector<std::string>& entries) {
  return fmt::format("const vec3 {0}[{1}] = vec3[{1}](\n    {2});\n", name, entries.size(),
                     fmt::join(entries, ",\n    "));
}

}  // namespace

Atmosphere shader_air(const SkySettings& settings) {
  Atmosphere a = settings.atmosphere;
  a.aerosol_scattering =
      aerosol_extinction(settings.visibility, wavelengths(a.air)) * a.aerosol_albedo;
  a.aerosol_height = settings.haze_height;
  a.ground_albedo = Vec3(settings.ground_albedo);
  return a;
}

Vec3 sun_outside(const SkySettings& settings) {
  const double radius = 0.5 * radians(0.53);
  const double solid_angle = 4 * pi_d * std::pow(std::sin(radius / 2), 2);
  return Vec3(sun_disc_radiance(0, 0) * solid_angle * 1e-3 *
              static_cast<double>(settings.sun_intensity));
}

std::string light_tables(const SkySettings& settings) {
  const SunlitAir air(shader_air(settings));
  std::vector<std::string> sky;
  std::vector<std::string> low;
  std::vector<std::string> high;
  for (int k = 0; k < nodes; ++k) {
    const float sine = sine_of_node(k);
    sky.push_back(vec3_text(settings.sky_intensity * sky_on_ground(air, sine)));
    low.push_back(vec3_text(air.light(0, sine).multiple));
    high.push_back(vec3_text(air.light(upper_height, sine).multiple));
  }
  return fmt::format(
      "\n// By the root of the sun's sine, from {0} to 1.\n{1}{2}{3}\n"
      "float sun_node(float sun_sine) {{\n"
      "  float root = sign(sun_sine) * sqrt(abs(sun_sine));\n"
      "  return clamp((root - ({0})) / {4}, 0.0, 1.0) * {5}.0;\n"
      "}}\n\n"
      "// Illuminance of level ground by the sky, per that of the sun outside the air.\n"
      "vec3 sky_on_ground(float sun_sine) {{\n"
      "  float x = sun_node(sun_sine);\n"
      "  int k = min(int(x), {6});\n"
      "  return mix(SKY_ON_GROUND[k], SKY_ON_GROUND[k + 1], x - float(k));\n"
      "}}\n\n"
      "// Light from all around in the air after two scatterings and more, 1/sr.\n"
      "vec3 multiple_scattering(float height, float sun_sine) {{\n"
      "  float x = sun_node(sun_sine);\n"
      "  int k = min(int(x), {6});\n"
      "  vec3 low = mix(MULTIPLE_LOW[k], MULTIPLE_LOW[k + 1], x - float(k));\n"
      "  vec3 high = mix(MULTIPLE_HIGH[k], MULTIPLE_HIGH[k + 1], x - float(k));\n"
      "  return mix(low, high, clamp(height / {7}, 0.0, 1.0));\n"
      "}}\n",
      glsl_number(double{lowest_root}), table("SKY_ON_GROUND", sky), table("MULTIPLE_LOW", low),
      table("MULTIPLE_HIGH", high), glsl_number(1 - double{lowest_root}), nodes - 1, nodes - 2,
      glsl_number(double{upper_height}));
}

}  // namespace wold
