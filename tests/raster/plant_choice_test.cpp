#include "raster/plant_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/hash.hpp"
#include "base/parallel.hpp"

namespace wold {
namespace {

/// Two kinds of plants as the choice sees them: a tree of 20000 triangles and a tuft of 400.
std::vector<PlantLevels> some_levels() {
  std::vector<PlantLevels> list(2);
  const std::uint32_t triangles[2] = {20000, 400};
  for (std::size_t k = 0; k < 2; ++k) {
    for (int l = 0; l < 20; ++l) {
      const float share = std::exp2(-0.5F * static_cast<float>(l));
      const float drawn = std::min(1.0F, share * (1 + plant_fade));
      const auto count = static_cast<std::uint32_t>(static_cast<float>(triangles[k]) * drawn);
      list[k].coarse.push_back({share, 0, 3 * count});
      if (l < 3) list[k].fine.push_back({share, 0, 6 * count});
    }
    list[k].fine_pixel = 0.003F;
    const float size = k == 0 ? 10.0F : 0.4F;
    list[k].low = Vec3(-0.25F * size, -0.25F * size, 0);
    list[k].high = Vec3(0.25F * size, 0.25F * size, size);
  }
  return list;
}

std::vector<ModelInstance> meadow(int count, float extent, std::uint32_t model) {
  std::vector<ModelInstance> list;
  for (int k = 0; k < count; ++k) {
    ModelInstance i;
    i.position = Vec3(extent * (uniform(random_bits(1, k, 0)) - 0.5F),
                      extent * (uniform(random_bits(1, k, 1)) - 0.5F), 0);
    i.yaw = 6 * uniform(random_bits(1, k, 2));
    i.scale = 0.7F + 0.6F * uniform(random_bits(1, k, 3));
    i.model = model;
    i.individual = static_cast<std::uint32_t>(random_bits(1, k, 4));
    list.push_back(i);
  }
  return list;
}

struct Scenery {
  std::vector<PlantLevels> levels = some_levels();
  std::vector<PlantSizes> sizes;
  PlantField trees;
  PlantField tufts;

  explicit Scenery(int tree_count, int tuft_count) {
    for (const PlantLevels& l : levels) sizes.push_back(plant_sizes(l));
    sizes[0].card = true;
    trees = PlantField(meadow(tree_count, 2000, 0), sizes);
    tufts = PlantField(meadow(tuft_count, 100, 1), sizes);
  }
  PlantChoice choose(const DrawView& view, const PlantDetail& detail) const {
    const std::array<const PlantField*, 2> fields{&trees, &tufts};
    return choose_plants(fields, levels, sizes, view, detail);
  }
};

DrawView person_view() {
  Camera camera;
  camera.position = Vec3(0, 0, 1.8F);
  camera.direction = glm::normalize(Vec3(0.3F, 1, -0.05F));
  return camera_view(camera, 640, 360);
}

TEST(PlantField, TellsHowManyLeavesStandAroundAndHowHigh) {
  std::vector<PlantLevels> levels = some_levels();
  for (PlantLevels& l : levels) l.area = 0.5F;
  std::vector<PlantSizes> sizes;
  for (const PlantLevels& l : levels) sizes.push_back(plant_sizes(l));
  sizes[0].card = true;
  // Two tufts of 0.4 m and one as large again, within a cell of a square metre; a tree among them.
  std::vector<ModelInstance> plants(4);
  plants[2].scale = 2;
  for (std::size_t k = 0; k < 3; ++k) plants[k].model = 1;
  const PlantField field(plants, sizes);
  for (const PlantField::Plant& p : field.plants()) {
    if (p.model == 0) continue;
    EXPECT_NEAR(p.drawn.crowd, 0.5F * (1 + 1 + 4), 1e-4F);
    EXPECT_NEAR(p.drawn.crowd_height, (0.4F + 0.4F + 4 * 0.8F) / 6, 1e-4F);
  }
}

TEST(PlantChoice, KeepsTheBudget) {
  const Scenery scenery(20000, 20000);
  for (const int budget : {100'000, 400'000, 2'000'000}) {
    PlantDetail detail;
    detail.triangle_budget = budget;
    EXPECT_LE(scenery.choose(person_view(), detail).triangles, 1.15 * budget);
  }
}

TEST(PlantChoice, MissesNoTreeThatIsSeen) {
  const Scenery scenery(20000, 0);
  const DrawView view = person_view();
  const PlantChoice choice = scenery.choose(view, {});
  std::set<std::pair<float, float>> drawn;
  for (const DrawnPlant& p : choice.plants) drawn.insert({p.position.x, p.position.y});
  int seen = 0;
  for (const ModelInstance& i : meadow(20000, 2000, 0)) {
    // A corner of the crown's box within the picture.
    bool visible = false;
    for (int c = 0; c < 8 && !visible; ++c) {
      const Vec3 corner = i.position + i.scale * Vec3(c & 1 ? 2.5F : -2.5F, c & 2 ? 2.5F : -2.5F,
                                                      c & 4 ? 10.0F : 0.0F);
      const Vec4 clip = view.view_projection * Vec4(corner, 1);
      visible = clip.w > 0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w;
    }
    if (!visible) continue;
    ++seen;
    EXPECT_TRUE(drawn.contains({i.position.x, i.position.y}));
  }
  EXPECT_GT(seen, 1000);
  EXPECT_LT(drawn.size(), 1.3 * seen);
}

TEST(PlantChoice, MeshAndCardTogetherAreOnePlant) {
  const Scenery scenery(20000, 0);
  PlantChoice choice = scenery.choose(person_view(), {});
  std::map<std::pair<float, float>, float> parts;
  for (const DrawnPlant& p : choice.plants) parts[{p.position.x, p.position.y}] += p.fade;
  for (const auto& [place, part] : parts) EXPECT_NEAR(part, 1, 1e-5F);
}

TEST(PlantChoice, ChangesLittleForASmallStep) {
  const Scenery scenery(3000, 0);
  Camera camera;
  camera.direction = glm::normalize(Vec3(0.3F, 1, 0));
  std::map<std::pair<float, float>, float> before;
  for (int step = 0; step < 5; ++step) {
    camera.position = Vec3(0, 0.2F * static_cast<float>(step), 1.8F);
    const PlantChoice choice = scenery.choose(camera_view(camera, 640, 360), {});
    std::map<std::pair<float, float>, float> now;
    for (const PlantBatch& b : choice.batches)
      if (b.kind == PlantBatch::Kind::coarse)
        for (std::uint32_t k = b.first; k < b.first + b.count; ++k) {
          const DrawnPlant& p = choice.plants[k];
          now[{p.position.x, p.position.y}] = p.share;
          const auto old = before.find({p.position.x, p.position.y});
          if (old == before.end() || glm::distance(p.position, camera.position) < 20) continue;
          EXPECT_NEAR(p.share, old->second, 0.05F * old->second);
        }
    before = now;
  }
}

TEST(PlantChoice, IsTheSameForAnyNumberOfThreads) {
  const Scenery scenery(20000, 20000);
  std::vector<PlantChoice> results;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    results.push_back(scenery.choose(person_view(), {}));
  }
  for (std::size_t k = 1; k < results.size(); ++k) {
    const auto a = std::as_bytes(std::span(results[0].plants));
    const auto b = std::as_bytes(std::span(results[k].plants));
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    EXPECT_EQ(results[0].batches.size(), results[k].batches.size());
  }
}

TEST(PlantChoice, SmallPlantsAreGoneAtTheirDistance) {
  const Scenery scenery(0, 20000);
  PlantDetail detail;
  detail.small_distance = 30;
  for (const DrawnPlant& p : scenery.choose(person_view(), detail).plants)
    EXPECT_LT(glm::distance(p.position, person_view().eye), 30.5F);
}

}  // namespace
}  // namespace wold
