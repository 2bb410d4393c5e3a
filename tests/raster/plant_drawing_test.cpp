#include "raster/plant_drawing.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/hash.hpp"
#include "gpu/context.hpp"
#include "gpu/evaluate.hpp"
#include "plants/plant.hpp"
#include "render/ray_scene.hpp"

namespace wold {
namespace {

constexpr int width = 128;
constexpr int height = 128;

class PlantPicture : public testing::Test {
 protected:
  PlantPicture() { use_reversed_depth(); }

  OffscreenContext context_;
  Progress progress_;
};

World empty_world() {
  return {Ground({Grid<float>(2, 2, 0.0F), DVec2(0), 100}, {}, {}, 1), {}, {}, {}, Sky()};
}

/// A world with one model of a plant file.
World world_of(const std::string& name, float tall) {
  Progress progress;
  World world = empty_world();
  const Plant plant = load_plant(std::string(WOLD_SOURCE_DIR) + "/plants/" + name + ".lsys");
  Model model;
  model.mesh = grow(plant, {.seed = 3, .height = tall, .detail = 0.6F}, progress);
  for (const MeshPart& part : model.mesh.parts) {
    Material m;
    m.name = part.material;
    if (const PlantMaterial* p = plant.find_material(part.material); p != nullptr) {
      m.color1 = 0.8F * p->reflectance;
      m.color2 = 1.2F * p->reflectance;
      m.transmission = p->transmittance;
      m.roughness = p->roughness;
    }
    model.part_materials.push_back(static_cast<std::uint32_t>(world.materials.size()));
    world.materials.emplace_back(m, 0.0F);
  }
  world.models.push_back(std::move(model));
  world.instances.push_back({.position = Vec3(0), .individual = 7});
  return world;
}

Camera camera_at(float distance, float tall) {
  Camera camera;
  camera.position = Vec3(0, -distance, 0.5F * tall);
  camera.field_of_view = 2 * degrees(std::atan(0.6F * tall / distance));
  return camera;
}

/// The picture: R, G, B in 10000 cd/m² and coverage.
struct Drawn {
  std::vector<float> pixels;
  double coverage = 0;
  DVec3 color{0};  // mean of what is covered
};

Drawn drawn(PlantDrawing& plants, const SceneLight& light, const Camera& camera,
            int frames_across = 2) {
  const int w = frames_across * width;
  const int h = frames_across * height;
  GpuTarget target(w, h, std::array{PixelFormat::rgba32f}, true);
  target.bind();
  glEnable(GL_DEPTH_TEST);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  plants.draw(camera_view(camera, w, h), &light);
  const std::vector<float> fine = target.read();
  Drawn d;
  d.pixels.assign(std::size_t{4} * width * height, 0);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (int c = 0; c < 4; ++c) {
        const float v = fine[4 * (static_cast<std::size_t>(y) * w + x) + c];
        const std::size_t at =
            4 * (static_cast<std::size_t>(y / frames_across) * width + x / frames_across) + c;
        d.pixels[at] +=
            (c < 3 ? 1e-4F : 1.0F) * v / static_cast<float>(frames_across * frames_across);
      }
  for (std::size_t k = 0; k < d.pixels.size(); k += 4) {
    d.coverage += static_cast<double>(d.pixels[k + 3]) / (width * height);
    d.color += DVec3(d.pixels[k], d.pixels[k + 1], d.pixels[k + 2]) / double{width * height};
  }
  d.color /= std::max(d.coverage, 1e-9);
  return d;
}

/// Of colours on a display that shows the mean at one fifth.
double psnr(const Drawn& a, const Drawn& b) {
  const double white = 5 * a.color.y;
  double sum = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k) {
    if (k % 4 == 3) continue;
    const auto shown = [&](float v) {
      return std::pow(std::min(1.0, static_cast<double>(v) / white), 1 / 2.2);
    };
    sum += std::pow(shown(a.pixels[k]) - shown(b.pixels[k]), 2);
  }
  return -10 * std::log10(sum / (3.0 * width * height));
}

TEST_F(PlantPicture, ATriangleIsDrawnWhereThePathTracerHasIt) {
  World world = empty_world();
  Model model;
  model.mesh.positions = {{1.5F, 0.2F, 2}, {1.7F, 0.2F, 2}, {1.6F, 0.35F, 2.2F}};
  model.mesh.triangles = {{0, 1, 2}};
  model.mesh.parts = {{"leaf", 0, 1}};
  model.part_materials = {0};
  world.models.push_back(model);
  Material leaf;
  leaf.transmission = Vec3(0.1F);
  world.materials.emplace_back(leaf, 0.2F);
  ModelInstance instance;
  instance.position = Vec3(812, -340, 120);
  instance.up = glm::normalize(Vec3(0.2F, -0.1F, 1));
  instance.yaw = 2.3F;
  instance.scale = 1.4F;
  world.instances.push_back(instance);
  PlantDrawing plants(world, progress_, {.small_height = 100});
  const SceneLight light(world.sky, {.size = 0});
  Vec3 middle(0);
  for (const Vec3& p : model.mesh.positions)
    middle += (instance.position + instance_matrix(instance) * p) / 3.0F;
  Camera camera;
  camera.position = middle + Vec3(3, -4, 1);
  camera.direction = glm::normalize(middle + Vec3(0.3F, 0, 0.2F) - camera.position);
  camera.field_of_view = 20;
  const Drawn d = drawn(plants, light, camera, 1);
  const Vec3 at = CameraRays(camera, width, height).project(middle);
  DVec2 sum(0);
  double weight = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto a = static_cast<double>(
          d.pixels[4 * (static_cast<std::size_t>(height - 1 - y) * width + x) + 3]);
      sum += a * DVec2(x + 0.5, y + 0.5);
      weight += a;
    }
  ASSERT_GT(weight, 4);
  EXPECT_NEAR(sum.x / weight, at.x, 1);
  EXPECT_NEAR(sum.y / weight, at.y, 1);
}

TEST_F(PlantPicture, ColoursOfLeavesAreThoseOfThePathTracer) {
  Material m = standard_materials()[5];  // birch.leaf
  const SurfaceMaterial material(m, 0.15F);
  std::vector<Vec4> a;
  std::vector<Vec4> b;
  std::vector<Vec3> expected;
  for (std::uint32_t k = 0; k < 200; ++k) {
    const Vec3 p(3 * uniform(random_bits(k, 0)), 3 * uniform(random_bits(k, 1)),
                 9 * uniform(random_bits(k, 2)));
    const auto individual = static_cast<std::uint32_t>(random_bits(k, 3));
    const std::uint32_t leaf = k * 37;
    const std::uint64_t bits = random_bits(individual, 1);
    a.emplace_back(p, static_cast<float>(leaf));
    b.emplace_back(static_cast<float>(bits & 0xffffU), static_cast<float>(bits >> 16U & 0xffffU),
                   static_cast<float>(bits >> 32U & 0xffffU), static_cast<float>(bits >> 48U));
    expected.push_back(material.at(p, 0.02F, individual, leaf).reflectance);
  }
  const auto number = [](float v) { return std::to_string(v); };
  const auto vec = [&](Vec3 v) {
    return "vec3(" + number(v.x) + "," + number(v.y) + "," + number(v.z) + ")";
  };
  const auto seed = static_cast<std::uint32_t>(hash_text(m.name));
  const std::string body =
      "#include \"render/material.glsl\"\n"
      "vec4 evaluate(vec4 a, vec4 b) {\n"
      "  uvec4 u = uvec4(b);\n"
      "  uvec2 bits = uvec2(u.x | (u.y << 16u), u.z | (u.w << 16u));\n"
      "  vec2 own = vec2(uniform_of(bits), uniform_of(mix_bits64(bits)));\n"
      "  TwoColors t = TwoColors(" +
      vec(m.color1) + "," + vec(m.color2) + "," + number(m.feature_size) + "," +
      number(m.contrast) + "," + number(m.stretch) + "," + std::to_string(seed) +
      "u);\n"
      "  vec3 c = two_colors(t, a.xyz + 100.0 * vec3(own, 0.0), 0.02);\n"
      "  c *= material_tint(own, 0.15) * material_tint(random_bits(bits, uint(a.w)), " +
      number(m.variation) +
      ");\n"
      "  return vec4(c, 1.0);\n"
      "}";
  const std::vector<Vec4> out = evaluate_shader(body, a, b);
  for (std::size_t k = 0; k < out.size(); ++k)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(out[k][c], expected[k][c], 2e-3F * expected[k][c]) << k;
}

class PlantPictureOf : public PlantPicture, public testing::WithParamInterface<const char*> {};

TEST_P(PlantPictureOf, WithFewerLeavesAndOnACardLooksAsInFull) {
  const World world = world_of(GetParam(), 12);
  PlantDrawing plants(world, progress_);
  const SceneLight light(world.sky, {.size = 0});
  const Camera camera = camera_at(40, 12);
  plants.set_detail({.leaves_per_pixel = 16, .card_height = 1});
  const Drawn full = drawn(plants, light, camera);
  for (const float leaves : {1.0F, 0.5F}) {
    plants.set_detail({.leaves_per_pixel = leaves, .card_height = 1});
    const Drawn fewer = drawn(plants, light, camera);
    EXPECT_LT(plants.choice().triangles, 200000U);
    EXPECT_NEAR(fewer.coverage, full.coverage, 0.04 * full.coverage) << leaves;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(fewer.color[c], full.color[c], 0.1 * full.color[c]) << leaves;
    EXPECT_GT(psnr(full, fewer), 24) << leaves;
  }
  // And on a card as its mesh.
  for (const float turn : {0.0F, 0.35F, 2.0F}) {
    Camera far = camera_at(200, 12);
    far.position = Vec3(200 * std::sin(turn), -200 * std::cos(turn), 6);
    far.direction = Vec3(-std::sin(turn), std::cos(turn), 0);
    plants.set_detail({.card_height = 1});
    const Drawn mesh = drawn(plants, light, far, 1);
    plants.set_detail({.card_height = 2000});
    const Drawn card = drawn(plants, light, far, 1);
    ASSERT_EQ(plants.choice().triangles, 2U);
    EXPECT_NEAR(card.coverage, mesh.coverage, 0.08 * mesh.coverage) << turn;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(card.color[c], mesh.color[c], 0.16 * mesh.color[c]) << turn;
  }
}

INSTANTIATE_TEST_SUITE_P(Trees, PlantPictureOf, testing::Values("birch", "spruce", "oak"));

}  // namespace
}  // namespace wold
