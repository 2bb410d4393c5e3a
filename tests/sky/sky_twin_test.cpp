// sky/*.glsl against sky/*.hpp at random heights, directions and suns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "gpu/context.hpp"
#include "gpu/evaluate.hpp"
#include "gpu/objects.hpp"
#include "sky/atmosphere.hpp"
#include "sky/clouds.hpp"
#include "sky/phase_functions.hpp"
#include "sky/sunlit_air.hpp"

namespace wold {
namespace {

float random(std::uint64_t what, std::size_t which) {
  return uniform(random_bits(11, what, which));
}

/// Greatest difference, relative to what is expected or to `floor` if that is more.
float difference(const std::vector<Vec4>& expected, const std::vector<Vec4>& actual, int components,
                 float floor) {
  float most = 0;
  for (std::size_t k = 0; k < expected.size(); ++k)
    for (int c = 0; c < components; ++c) {
      const float scale = std::max(std::abs(expected[k][c]), floor);
      const float d = std::abs(actual[k][c] - expected[k][c]) / scale;
      if (std::isnan(d)) return d;
      most = std::max(most, d);
    }
  return most;
}

template <class Function>
std::vector<Vec4> expect(std::size_t count, const Function& function) {
  std::vector<Vec4> out(count);
  parallel_for(0, static_cast<int>(count), [&](int k) {
    out[static_cast<std::size_t>(k)] = function(static_cast<std::size_t>(k));
  });
  return out;
}

class SkyTwin : public testing::Test {
 protected:
  /// Compares `components` of function(k) with those of `body`, GLSL of `evaluate`, at a and b.
  template <class Function>
  void compare(const std::string& name, const std::string& includes, const std::string& body,
               const std::vector<Vec4>& a, const std::vector<Vec4>& b, int components,
               const Function& function, float allowed, float floor,
               const std::function<void(const GpuProgram&)>& prepare = {}) {
    const std::vector<Vec4> actual = evaluate_shader(
        includes + "vec4 evaluate(vec4 a, vec4 b) {\n" + body + "\n}\n", a, b, {}, prepare);
    const float found = difference(expect(a.size(), function), actual, components, floor);
    RecordProperty(name, fmt::format("{:.2g}", found));
    EXPECT_LE(found, allowed) << name;
  }

  OffscreenContext context_;
};

struct NamedPhase {
  std::string name;
  std::string call;
  float (*function)(float cosine, float g);
  std::vector<float> parameters;
};

const std::vector<float> many_g{-0.9F, -0.5F, 0.0F, 0.3F, 0.76F, 0.95F};

std::vector<NamedPhase> phases() {
  return {
      {"isotropic", "isotropic_phase()", [](float, float) { return isotropic_phase(); }, {0}},
      {"rayleigh", "rayleigh_phase(a.x)", [](float c, float) { return rayleigh_phase(c); }, {0}},
      {"mie", "mie_phase(a.x, a.y)", mie_phase, many_g},
      {"henyey_greenstein", "henyey_greenstein(a.x, a.y)", henyey_greenstein, many_g},
      {"double_henyey_greenstein", "double_henyey_greenstein(a.x, a.y, -0.5, 0.3)",
       [](float c, float g) { return double_henyey_greenstein(c, g, -0.5F, 0.3F); }, many_g},
      {"schlick", "schlick_phase(a.x, schlick_k(a.y))",
       [](float c, float g) { return schlick_phase(c, schlick_k(g)); }, many_g}};
}

TEST_F(SkyTwin, PhaseFunctionsAgreeAndIntegrateToOne) {
  constexpr std::size_t count = 50000;  // angles, even
  for (const NamedPhase& phase : phases())
    for (const float g : phase.parameters) {
      std::vector<Vec4> points(count);
      for (std::size_t k = 0; k < count; ++k)
        points[k] = {std::cos(pi * (static_cast<float>(k) + 0.5F) / count), g, 0, 0};
      const std::vector<Vec4> actual = evaluate_shader(
          "#include \"sky/phase_functions.glsl\"\n"
          "vec4 evaluate(vec4 a, vec4 b) { return vec4(" +
              phase.call + "); }\n",
          points);
      const auto expected =
          expect(count, [&](std::size_t k) { return Vec4(phase.function(points[k].x, g)); });
      const float found = difference(expected, actual, 1, 0);
      RecordProperty(fmt::format("{} {}", phase.name, g), fmt::format("{:.2g}", found));
      EXPECT_LE(found, 1e-5F) << phase.name << ' ' << g;
      double sum = 0;
      for (std::size_t k = 0; k < count; ++k)
        sum += static_cast<double>(actual[k].x) *
               std::sin(pi_d * (static_cast<double>(k) + 0.5) / count);
      EXPECT_NEAR(sum * 2 * pi_d * pi_d / count, 1, 3e-4) << phase.name << ' ' << g;
    }
}

/// Rays at heights up to 100 km, most of them low, half of them near the horizon; suns at any
/// height. `b` holds a distance.
struct AirRays {
  explicit AirRays(std::size_t count) : a(count), b(count) {
    for (std::size_t k = 0; k < count; ++k) {
      const float height = 1e5F * std::pow(random(1, k), 3.0F);
      const float up = 2 * random(2, k) - 1;
      const float cosine = k % 2 == 0 ? up : up * up * up;
      const float sun = 2 * random(3, k) - 1;
      const float sun_cosine = k % 3 == 0 ? sun : sun * sun * sun;
      const float to_sun =
          cosine * sun_cosine + std::sqrt((1 - cosine * cosine) * (1 - sun_cosine * sun_cosine)) *
                                    std::cos(2 * pi * random(4, k));
      a[k] = {height, cosine, sun_cosine, to_sun};
      b[k] = {std::pow(10.0F, 7 * random(5, k)), 0, 0, 0};
    }
  }
  AirRay ray(std::size_t k) const { return {a[k].x, a[k].y, a[k].z, a[k].w}; }
  std::vector<Vec4> a;
  std::vector<Vec4> b;
};

constexpr const char* air_head = "#include \"sky/atmosphere.glsl\"\n";
constexpr const char* ray_line =
    "AirRay ray = AirRay(a.x, a.y, a.z, a.w); Atmosphere air = default_atmosphere();\n";

TEST_F(SkyTwin, PlacesInTheAirAgree) {
  const AirRays rays(100000);
  const Atmosphere air;
  compare(
      "height_after", air_head, "return vec4(height_after(default_atmosphere(), a.x, a.y, b.x));",
      rays.a, rays.b, 1,
      [&](std::size_t k) { return Vec4(height_after(air, rays.a[k].x, rays.a[k].y, rays.b[k].x)); },
      1e-5F, 1);
  compare(
      "spans", air_head,
      std::string(ray_line) +
          "AirSpan s = span_in_air(air, ray.height, ray.cosine);"
          "AirSpan l = span_in_layer(air, ray.height, ray.cosine, 1500.0, 2700.0);"
          "return vec4(s.end, s.ground ? 1.0 : 0.0, l.begin, l.end);",
      rays.a, rays.b, 4,
      [&](std::size_t k) {
        const AirSpan s = span_in_air(air, rays.a[k].x, rays.a[k].y);
        const AirSpan l = span_in_layer(air, rays.a[k].x, rays.a[k].y, 1500, 2700);
        return Vec4(s.end, s.ground ? 1 : 0, l.begin, l.end);
      },
      1e-3F, 1);
}

TEST_F(SkyTwin, TransmittancesAgree) {
  const AirRays rays(100000);
  const Atmosphere air;
  compare(
      "transmittance", air_head,
      std::string(ray_line) +
          "return vec4(transmittance(air, ray.height, ray.cosine, b.x, 20), 0.0);",
      rays.a, rays.b, 3,
      [&](std::size_t k) {
        return Vec4(transmittance(air, rays.a[k].x, rays.a[k].y, rays.b[k].x, 20), 0);
      },
      1e-3F, 1e-5F);
  compare(
      "sun_transmittance", air_head,
      std::string(ray_line) + "return vec4(sun_transmittance(air, a.x, a.z, 20), 0.0);", rays.a,
      rays.b, 3,
      [&](std::size_t k) { return Vec4(sun_transmittance(air, rays.a[k].x, rays.a[k].z, 20), 0); },
      1e-3F, 1e-5F);
}

TEST_F(SkyTwin, RadianceScatteredOnceAgrees) {
  const AirRays rays(20000);
  for (const AirCoefficients set :
       {AirCoefficients::rec709, AirCoefficients::popular, AirCoefficients::penndorf}) {
    const Atmosphere air{.air = set, .aerosol_scattering = Vec3{2e-5F, 3e-5F, 4e-5F}};
    compare(
        fmt::format("radiance_{}", static_cast<int>(set)), air_head,
        std::string(ray_line) +
            fmt::format("air.air = {}; air.aerosol_scattering = vec3(2e-5, 3e-5, 4e-5);\n",
                        static_cast<int>(set)) +
            "return vec4(single_scattering(air, ray, b.x, vec3(1.0), 16, 6).light, 0.0);",
        rays.a, rays.b, 3,
        [&](std::size_t k) {
          return Vec4(single_scattering(air, rays.ray(k), rays.b[k].x, Vec3(1), 16, 6).light, 0);
        },
        1e-3F, 1e-5F);
  }
}

GpuTexture table_texture(const Grid<Vec3>& grid) {
  GpuTexture texture(grid.width(), grid.height(), {.format = PixelFormat::rgba32f});
  std::vector<float> values;
  for (int j = 0; j < grid.height(); ++j)
    for (int i = 0; i < grid.width(); ++i)
      for (int c = 0; c < 4; ++c) values.push_back(c < 3 ? grid(i, j)[c] : 1);
  texture.upload(values);
  return texture;
}

TEST_F(SkyTwin, RadianceByTablesAgrees) {
  const AirRays rays(20000);
  const SunlitAir air{Atmosphere{}};
  const GpuTexture transmittances = table_texture(air.transmittance_table());
  const GpuTexture multiples = table_texture(air.multiple_table());
  const auto bind = [&](const GpuProgram& program) {
    transmittances.bind(0);
    multiples.bind(1);
    program.set("transmittances", 0);
    program.set("multiples", 1);
  };
  const std::string head =
      "#include \"sky/sunlit_air.glsl\"\n"
      "uniform sampler2D transmittances;\n"
      "uniform sampler2D multiples;\n";
  compare(
      "radiance_by_tables", head,
      std::string(ray_line) +
          "ScatteredSums s = seen_in_sunlit_air(air, transmittances, multiples, ray, b.x, 16);\n"
          "return vec4(with_phases(air, s, ray.to_sun, vec3(1.0)).light, 0.0);",
      rays.a, rays.b, 3,
      [&](std::size_t k) {
        const AirRay ray = rays.ray(k);
        const ScatteredSums sums = air.seen(ray, rays.b[k].x, 16);
        return Vec4(with_phases(air.atmosphere(), sums, ray.to_sun, Vec3(1)).light, 0);
      },
      1e-3F, 1e-5F, bind);
}

TEST_F(SkyTwin, MarchTakesTheLightOfTheIncludingShader) {
  const AirRays rays(5000);
  const Atmosphere air;
  const auto light_at = [](float height, float sun_cosine) {
    return LightInAir{Vec3(0.5F + 0.5F * sun_cosine), Vec3(1e-5F * height)};
  };
  compare(
      "march",
      "#include \"sky/air_march.glsl\"\n"
      "LightInAir light_in_air(Atmosphere a, float height, float sun_cosine) {\n"
      "  return LightInAir(vec3(0.5 + 0.5 * sun_cosine), vec3(1e-5 * height));\n}\n",
      std::string(ray_line) +
          "ScatteredSums s = march(air, ray, b.x, 16);\n"
          "return vec4(s.by_air.x + s.by_aerosol.x, s.by_air.z, s.multiple.y, s.transmittance.y);",
      rays.a, rays.b, 4,
      [&](std::size_t k) {
        const ScatteredSums s = march(air, rays.ray(k), rays.b[k].x, 16, light_at);
        return Vec4(s.by_air.x + s.by_aerosol.x, s.by_air.z, s.multiple.y, s.transmittance.y);
      },
      1e-3F, 1e-5F);
}

constexpr const char* cloud_head = "#include \"sky/clouds.glsl\"\n";
constexpr const char* cloud_line =
    "CloudLayer layer = cloud_layer(default_clouds()); Atmosphere air = default_atmosphere();\n";

/// Places within 50 km and heights in the layer (a), unit directions (b).
struct CloudRays {
  explicit CloudRays(std::size_t count) : a(count), b(count) {
    for (std::size_t k = 0; k < count; ++k) {
      a[k] = {1e5F * random(6, k) - 5e4F, 1e5F * random(7, k) - 5e4F, 1400 + 1400 * random(8, k),
              random(12, k)};
      const float up = 2 * random(9, k) - 1;
      const float turn = 2 * pi * random(10, k);
      const float across = std::sqrt(1 - up * up);
      b[k] = {across * std::cos(turn), across * std::sin(turn), up, 0};
    }
  }
  std::vector<Vec4> a;
  std::vector<Vec4> b;
};

TEST_F(SkyTwin, CloudsAgree) {
  const CloudRays rays(40000);
  const CloudLayer layer{Clouds{}};
  const Atmosphere air;
  compare(
      "cloud_density", cloud_head,
      std::string(cloud_line) + "return vec4(cloud_density(layer, a.xy, a.z));", rays.a, rays.b, 1,
      [&](std::size_t k) { return Vec4(layer.density(DVec2(rays.a[k]), rays.a[k].z)); }, 1e-4F, 1);
  const auto ray = [&](std::size_t k) {
    const Vec3 d(rays.b[k]);
    const Vec3 sun(0.6F, 0, 0.8F);
    return AirRay{rays.a[k].z, d.z, sun.z, glm::dot(d, sun)};
  };
  const std::string ray_there =
      std::string(cloud_line) +
      "vec3 sun = vec3(0.6, 0.0, 0.8); AirRay ray = AirRay(a.z, b.z, sun.z, dot(b.xyz, sun));\n";
  compare(
      "cloud_transmittance", cloud_head,
      ray_there + "return vec4(cloud_transmittance(layer, air, a.xy, ray, b.xyz, 3000.0, 12));",
      rays.a, rays.b, 1,
      [&](std::size_t k) {
        return Vec4(layer.transmittance(air, DVec2(rays.a[k]), ray(k), Vec3(rays.b[k]), 3000, 12));
      },
      1e-3F, 1e-3F);
}

TEST_F(SkyTwin, LightOfCloudsAgrees) {
  const CloudRays rays(2000);
  const CloudLayer layer{Clouds{}};
  const Atmosphere air;
  const Vec3 sun(0.6F, 0, 0.8F);
  compare(
      "cloud_light", cloud_head,
      std::string(cloud_line) +
          "vec3 sun = vec3(0.6, 0.0, 0.8); AirRay ray = AirRay(a.z, b.z, sun.z, dot(b.xyz, sun));\n"
          "CloudLight c = clouds_seen(layer, air, a.xy, ray, b.xyz, sun, 5000.0, vec3(1.0),\n"
          "                           vec3(0.05, 0.07, 0.1), a.w, CloudSteps(12, 4));\n"
          "return vec4(c.light, c.transmittance);",
      rays.a, rays.b, 4,
      [&](std::size_t k) {
        const Vec3 d(rays.b[k]);
        const CloudLight c =
            layer.seen(air, DVec2(rays.a[k]), {rays.a[k].z, d.z, sun.z, glm::dot(d, sun)}, d, sun,
                       5000, Vec3(1), {0.05F, 0.07F, 0.1F}, rays.a[k].w, {12, 4});
        return Vec4(c.light, c.transmittance);
      },
      1e-3F, 0.03F);  // thin shreds are as exact as places in float are: to 1e-5 of density
}

}  // namespace
}  // namespace wold
