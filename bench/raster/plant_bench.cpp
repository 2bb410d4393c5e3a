// Choosing what is drawn of a million plants, and drawing it.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <string>

#include "base/hash.hpp"
#include "gpu/context.hpp"
#include "plants/plant.hpp"
#include "raster/plant_drawing.hpp"

namespace wold {
namespace {

/// Two kinds of trees on a plane of 8 km, one to each 64 m².
World planted(int count) {
  Progress progress;
  World world{Ground({Grid<float>(2, 2, 0.0F), DVec2(0), 100}, {}, {}, 1), {}, {}, {}, Sky()};
  for (const char* name : {"birch", "spruce"}) {
    const Plant plant = load_plant(std::string(WOLD_SOURCE_DIR) + "/plants/" + name + ".lsys");
    Model model;
    model.mesh = grow(plant, {.seed = 3, .height = 14}, progress);
    for (const MeshPart& part : model.mesh.parts) {
      Material m;
      m.name = part.material;
      if (const PlantMaterial* p = plant.find_material(part.material); p != nullptr)
        m.transmission = p->transmittance;
      model.part_materials.push_back(static_cast<std::uint32_t>(world.materials.size()));
      world.materials.emplace_back(m, 0.1F);
    }
    world.models.push_back(std::move(model));
  }
  const float side = 8 * std::sqrt(static_cast<float>(count));
  for (int k = 0; k < count; ++k)
    world.instances.push_back({.position = Vec3(side * (uniform(random_bits(1, k, 0)) - 0.5F),
                                                side * (uniform(random_bits(1, k, 1)) - 0.5F), 0),
                               .yaw = 6 * uniform(random_bits(1, k, 2)),
                               .model = static_cast<std::uint32_t>(k) % 2,
                               .individual = static_cast<std::uint32_t>(k)});
  return world;
}

Camera person() {
  Camera camera;
  camera.position = Vec3(0, 0, 1.8F);
  return camera;
}

void choose(benchmark::State& state) {
  const World world = planted(1'000'000);
  Progress progress;
  const std::vector<PlantLevels> levels = plant_levels(world, progress);
  std::vector<PlantSizes> sizes;
  for (const PlantLevels& l : levels) sizes.push_back(plant_sizes(l));
  for (PlantSizes& s : sizes) s.card = true;
  const PlantField field(world.instances, sizes);
  const std::array<const PlantField*, 1> fields{&field};
  const DrawView view = camera_view(person(), 1280, 720);
  PlantChoice choice;
  for (auto _ : state) choice = choose_plants(fields, levels, sizes, view, {});
  state.counters["drawn"] = static_cast<double>(choice.plants.size());
  state.counters["triangles"] = static_cast<double>(choice.triangles);
}
BENCHMARK(choose)->Unit(benchmark::kMillisecond);

void draw(benchmark::State& state) {
  const OffscreenContext context;
  use_reversed_depth();
  const World world = planted(100'000);
  Progress progress;
  PlantDetail detail;
  detail.triangle_budget = static_cast<int>(state.range(0));
  PlantDrawing plants(world, progress, detail);
  const SceneLight light(world.sky, {.size = 0});
  GpuTarget target(640, 360, std::array{PixelFormat::rgba16f}, true);
  target.bind();
  glEnable(GL_DEPTH_TEST);
  for (auto _ : state) {
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    plants.draw(camera_view(person(), 640, 360), &light);
    glFinish();
  }
  state.counters["triangles"] = static_cast<double>(plants.choice().triangles);
  state.SetLabel(gpu_info().renderer);
}
BENCHMARK(draw)->Arg(200'000)->Arg(1'000'000)->Arg(4'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wold
