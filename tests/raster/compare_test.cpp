// The same scene drawn and traced: what both show is the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "gpu/context.hpp"
#include "likeness.hpp"

namespace wold {
namespace {

constexpr int width = 150;
constexpr int height = 100;
constexpr int samples = 16;
constexpr int frames = 10;

// Hills with a few trees, low sun from the side.
constexpr const char* scene_text = R"(
wold = 1
seed = 5
[terrain]
size = 600
resolution = 129
[[terrain.step]]
op = "fbm"
height = 8
base = 100
feature_size = 260
hurst = 1.0
[[species]]
name = "spruce"
plant = "plants/spruce.lsys"
height = [14, 20]
models = 1
[[species]]
name = "oak"
plant = "plants/oak.lsys"
height = [10, 14]
models = 1
[[scatter]]
species = { spruce = 1, oak = 1 }
density = 0.0022
[sky]
sun = [24, 250]
turbidity = 2.3
[camera]
position = [0, -200]
look_height = 12
look_direction = [0.0, 1.0, -0.15]
field_of_view = 50
)";

/// Of the green channel over what is land in both.
double correlation(const Likeness& p) {
  const int green = p.traced.find("G");
  double n = 0;
  DVec2 sum(0);
  DVec2 squares(0);
  double both = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (p.shown(x, y) == Shown::sky) continue;
      const DVec2 v(static_cast<double>(p.traced.at(x, y, green)),
                    static_cast<double>(p.drawn.at(x, y, p.drawn.find("G"))));
      n += 1;
      sum += v;
      squares += v * v;
      both += v.x * v.y;
    }
  sum /= n;
  const DVec2 variance = squares / n - sum * sum;
  return (both / n - sum.x * sum.y) / std::sqrt(variance.x * variance.y);
}

TEST(SceneDrawingAndPathTracer, ShowTheSameLightOnTheSamePlaces) {
  Progress progress;
  const OffscreenContext context;
  PlantedWorld world(parse_scene(scene_text, "compare.toml", WOLD_SOURCE_DIR), progress);
  const Camera camera = world.camera(world.scene().camera(""), progress);
  const Likeness p =
      likeness(world, camera, {width, height}, samples, DrawingQuality::medium, frames);
  struct Demand {
    Shown kind;
    const char* name;
    float tolerance;
  };
  for (const Demand& demand :
       {Demand{Shown::sky, "sky", 0.02F}, Demand{Shown::sunlit, "sunlit ground", 0.1F},
        Demand{Shown::shade, "ground in shade", 0.1F}, Demand{Shown::plant, "plants", 0.15F}}) {
    const MeanColors means = mean_colors(p, demand.kind);
    EXPECT_GT(means.pixels, 25) << demand.name;
    const Vec3 ratio = means.drawn / means.traced;
    RecordProperty(
        std::string("drawn / traced, ") + demand.name,
        fmt::format("{:.2f} {:.2f} {:.2f} ({} pixels)", ratio.x, ratio.y, ratio.z, means.pixels));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1, demand.tolerance) << demand.name << c;
  }
  // The horizon and the outlines of trees before it.
  double difference = 0;
  const int cover = p.traced.find("A");
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      difference += std::abs(
          static_cast<double>(p.traced.at(x, y, cover) - p.drawn.at(x, y, p.drawn.find("A"))));
  EXPECT_LT(difference / (width * height), 0.015);
  EXPECT_GT(correlation(p), 0.8);
}

}  // namespace
}  // namespace wold
