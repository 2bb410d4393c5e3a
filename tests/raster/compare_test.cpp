// The same scene drawn and traced: what both show is the same.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "gpu/context.hpp"
#include "raster/scene_drawing.hpp"
#include "render/render.hpp"

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

enum Kind { sky, sunlit, shaded, plant, mixed };

/// What a pixel shows, where all of five rays agree.
Kind kind_at(const RayScene& scene, const CameraRays& rays, int x, int y) {
  RayCount count;
  const Vec3 sun = scene.world().sky.sun_direction();
  Kind kind = mixed;
  for (int k = 0; k < 5; ++k) {
    const Vec2 off =
        k == 0 ? Vec2(0.5F) : Vec2((k & 1) != 0 ? 0.1F : 0.9F, (k & 2) != 0 ? 0.1F : 0.9F);
    const Hit hit = scene.intersect(
        rays.ray(Vec2(static_cast<float>(x), static_cast<float>(y)) + off, Vec2(0.5F)), 0, true,
        count);
    Kind here = sky;
    if (hit.valid() && hit.instance != Hit::ground) here = plant;
    if (hit.valid() && hit.instance == Hit::ground)
      here = scene.occluded({hit.position + 0.02F * hit.normal, sun}, 0, 1e9F, count) ? shaded
                                                                                      : sunlit;
    if (k > 0 && here != kind) return mixed;
    kind = here;
  }
  return kind;
}

/// Pixels whose neighbours above, below and beside are of another kind are of none: shadow maps
/// are coarser at the edges.
Grid<Kind> without_edges(const Grid<Kind>& kinds) {
  Grid<Kind> out = kinds;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const IVec2 d : {IVec2(1, 0), IVec2(-1, 0), IVec2(0, 1), IVec2(0, -1)})
        if (kinds.clamped(x + d.x, y + d.y) != kinds(x, y)) out(x, y) = mixed;
  return out;
}

struct Pictures {
  Image traced;
  Image drawn;
  Grid<Kind> kinds;
};

Pictures pictures() {
  Progress progress;
  const OffscreenContext context;
  PlantedWorld world(parse_scene(scene_text, "compare.toml", WOLD_SOURCE_DIR), progress);
  const Camera camera = world.camera(world.scene().camera(""), progress);
  Pictures p;
  const TracedWorld traced = world.traced(camera, {width, height}, progress);
  const CameraRays rays(camera, width, height);
  RenderSettings settings = world.scene().render;
  settings.size = {width, height};
  Film film(width, height);
  trace_picture(*traced.rays, rays, settings, {{0, samples}, 1, false}, film, progress);
  p.traced = film.image();
  p.kinds = Grid<Kind>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) p.kinds(x, y) = kind_at(*traced.rays, rays, x, y);
  p.kinds = without_edges(p.kinds);
  SceneDrawing drawing(world, scene_detail(DrawingQuality::medium), progress);
  drawing.resize(width, height);
  drawing.settle(camera);
  for (int k = 0; k < frames; ++k) drawing.draw(camera);
  p.drawn = drawing.picture().linear_image();
  return p;
}

Vec3 mean_color(const Image& image, const Grid<Kind>& kinds, Kind kind, int& count) {
  const std::array<int, 3> channels{image.find("R"), image.find("G"), image.find("B")};
  DVec3 sum(0);
  count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (kinds(x, y) != kind) continue;
      ++count;
      for (int c = 0; c < 3; ++c)
        sum[c] += static_cast<double>(image.at(x, y, channels[static_cast<std::size_t>(c)]));
    }
  return Vec3(sum / std::max(static_cast<double>(count), 1.0));
}

/// Of the green channel over what is land in both.
double correlation(const Pictures& p) {
  const int green = p.traced.find("G");
  double n = 0;
  DVec2 sum(0);
  DVec2 squares(0);
  double both = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (p.kinds(x, y) == sky) continue;
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
  const Pictures p = pictures();
  const std::array<const char*, 4> names{"sky", "sunlit ground", "ground in shade", "plants"};
  // In the shade of single trees shadow maps, coarser than leaves, let some sun through.
  const std::array<float, 4> tolerances{0.02F, 0.1F, 0.4F, 0.25F};
  for (const Kind kind : {sky, sunlit, shaded, plant}) {
    const auto k = static_cast<std::size_t>(kind);
    int count = 0;
    const Vec3 expected = mean_color(p.traced, p.kinds, kind, count);
    const Vec3 seen = mean_color(p.drawn, p.kinds, kind, count);
    EXPECT_GT(count, 25) << names[k];
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(seen[c] / expected[c], 1, tolerances[k]) << names[k] << ' ' << c;
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
