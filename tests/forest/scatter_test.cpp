#include "forest/scatter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace wold {
namespace {

Heightfield flat(double side, float height = 0) {
  Heightfield ground;
  ground.height = Grid<float>(65, 65, height);
  ground.cell = side / 64;
  ground.origin = DVec2(-side / 2);
  return ground;
}

/// Height is `f(x, y)`.
template <class F>
Heightfield ground_of(double side, const F& f) {
  Heightfield ground = flat(side);
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i) {
      const DVec2 p = ground.origin + ground.cell * DVec2(i, j);
      ground.height(i, j) = static_cast<float>(f(p.x, p.y));
    }
  return ground;
}

std::vector<SpeciesSettings> birch_and_fern() {
  SpeciesSettings birch;
  birch.name = "birch";
  birch.height = {9, 16};
  birch.radius = 1.2F;
  SpeciesSettings fern;
  fern.name = "fern";
  fern.height = {0.4F, 0.8F};
  fern.radius = 0.25F;
  fern.models = 3;
  return {birch, fern};
}

std::vector<Instance> scattered(const Heightfield& ground, const ScatterSettings& settings,
                                const ScatterPlace& place = {}, std::uint64_t seed = 1) {
  Progress progress;
  return scatter(ground, settings, birch_and_fern(), place, seed, progress);
}

ScatterSettings mixed() {
  ScatterSettings settings;
  settings.species = {{"birch", 1}, {"fern", 3}};
  settings.density = 0.08;
  return settings;
}

double density_of(const std::vector<Instance>& plants, double side) {
  return static_cast<double>(plants.size()) / (side * side);
}

TEST(Scatter, ReachesTheDensityAndTheMix) {
  ScatterSettings settings = mixed();
  settings.patchiness = 0;
  const auto plants = scattered(flat(400), settings);
  EXPECT_NEAR(density_of(plants, 400) / 0.08, 1, 0.03);
  const auto birches =
      std::count_if(plants.begin(), plants.end(), [](const Instance& p) { return p.species == 0; });
  EXPECT_NEAR(static_cast<double>(birches) / static_cast<double>(plants.size()), 0.25, 0.02);
}

TEST(Scatter, FollowsAMaskInProportion) {
  for (const float part : {0.15F, 0.5F, 0.85F}) {
    const Heightfield mask = flat(400, part);
    ScatterPlace place;
    place.mask = &mask;
    EXPECT_NEAR(density_of(scattered(flat(400), mixed(), place), 400) / (0.08 * part), 1, 0.06);
  }
}

/// Smallest (distance - r_a - r_b) over all pairs.
double tightest(const std::vector<Instance>& plants, double reach_a, double reach_b) {
  const double cell = 2 * std::max(reach_a, reach_b);
  std::vector<Instance> sorted = plants;
  std::sort(sorted.begin(), sorted.end(),
            [](const Instance& a, const Instance& b) { return a.position.x < b.position.x; });
  const double radius[] = {reach_a, reach_b};
  double least = 1e9;
  for (std::size_t a = 0; a < sorted.size(); ++a)
    for (std::size_t b = a + 1; b < sorted.size(); ++b) {
      if (static_cast<double>(sorted[b].position.x - sorted[a].position.x) > cell) break;
      const Vec3 apart = sorted[a].position - sorted[b].position;
      least = std::min(least, static_cast<double>(std::hypot(apart.x, apart.y)) -
                                  radius[sorted[a].species] - radius[sorted[b].species]);
    }
  return least;
}

TEST(Scatter, KeepsDistanceAcrossTiles) {
  // Three quarters are ferns; the even distance is 0.7 of 2.95 m at 0.08 per m².
  const double even = 0.5 * 0.7 * jamming_distance(0.08);
  const auto plants = scattered(flat(300), mixed());
  EXPECT_GT(tightest(plants, std::max(1.2, even), std::max(0.25, even)), -1e-4);
  ScatterSettings dense = mixed();
  dense.density = 0.5;
  dense.evenness = 0.3F;
  const double close = 0.5 * 0.3 * jamming_distance(0.5);
  EXPECT_GT(tightest(scattered(flat(150), dense), 1.2, std::max(0.25, close)), -1e-4);
}

bool before(const Instance& a, const Instance& b) {
  return a.position.y != b.position.y ? a.position.y < b.position.y : a.position.x < b.position.x;
}

TEST(Scatter, WindowsAddUpToTheWholeBitForBit) {
  const Heightfield ground =
      ground_of(500, [](double x, double y) { return 20 * std::sin(x / 40) * std::cos(y / 30); });
  ScatterSettings settings = mixed();
  settings.where.clumping = 0.7F;
  auto whole = scattered(ground, settings);
  std::vector<Instance> parts;
  const double cuts[] = {-1000, -180.3, -180, 3.25, 77, 1000};
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) {
      ScatterPlace place;
      place.low = {cuts[i], cuts[j]};
      place.high = {cuts[i + 1], cuts[j + 1]};
      const auto part = scattered(ground, settings, place);
      parts.insert(parts.end(), part.begin(), part.end());
    }
  std::sort(whole.begin(), whole.end(), before);
  std::sort(parts.begin(), parts.end(), before);
  ASSERT_GT(whole.size(), 5000U);
  EXPECT_TRUE(whole == parts) << whole.size() << " " << parts.size();
}

TEST(Scatter, PlantsDoNotDependOnTheSizeOfTheGround) {
  ScatterPlace place;
  place.low = DVec2(-50);
  place.high = DVec2(50);
  EXPECT_EQ(scattered(flat(300), mixed(), place), scattered(flat(900), mixed(), place));
}

TEST(Scatter, SameBitsForAnyNumberOfThreads) {
  std::vector<Instance> reference;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const auto plants = scattered(flat(400), mixed());
    if (threads == 1) reference = plants;
    EXPECT_TRUE(plants == reference);
  }
  EXPECT_FALSE(scattered(flat(400), mixed(), {}, 2) == reference);
}

TEST(Scatter, SlopesOutsideTheLimitsStayBare) {
  // Slope rises from 0 at the middle to 60° at the border.
  const Heightfield ground =
      ground_of(400, [](double x, double) { return 0.5 * std::tan(radians(60.0)) / 200 * x * x; });
  ScatterSettings settings = mixed();
  settings.where.slope = {10, 30};
  settings.where.slope_softness = 5;
  int soft = 0, full = 0;
  for (const Instance& p : scattered(ground, settings)) {
    const GroundSample at = ground_at(ground, {p.position.x, p.position.y});
    const float slope = degrees(std::atan(glm::length(at.gradient)));
    ASSERT_GE(slope, 9.9F);
    ASSERT_LE(slope, 30.1F);
    if (slope < 12.5F) ++soft;
    if (slope > 15 && slope < 17.5F) ++full;
  }
  EXPECT_GT(full, 2 * soft);
  EXPECT_GT(soft, 0);
}

TEST(Scatter, HeightsAndAspectsOutsideTheLimitsStayBare) {
  const Heightfield cone =
      ground_of(400, [](double x, double y) { return 200 - 0.4 * std::hypot(x, y); });
  ScatterSettings settings = mixed();
  settings.where.height = {130, 180};
  settings.where.aspect = 90;
  settings.where.aspect_spread = 60;
  const auto plants = scattered(cone, settings);
  ASSERT_GT(plants.size(), 100U);
  for (const Instance& p : plants) {
    EXPECT_GT(p.position.z, 129);
    EXPECT_LT(p.position.z, 180);
    EXPECT_GT(p.position.x, 0.4F * std::abs(p.position.y));  // faces east
  }
}

TEST(Scatter, ThinsOutTowardsTheEndOfItsDistance) {
  ScatterSettings settings = mixed();
  settings.where.within = 60;
  settings.where.fade = 0.5F;
  ScatterPlace place;
  place.centre = {25, -40};
  int ring[3] = {0, 0, 0};
  for (const Instance& p : scattered(flat(1000), settings, place)) {
    const double d = glm::length(DVec2(p.position.x, p.position.y) - place.centre);
    ASSERT_LT(d, 60.001);
    ++ring[static_cast<int>(d / 20) < 3 ? static_cast<int>(d / 20) : 2];
  }
  const auto per_area = [&](int k) { return ring[k] / (pi_d * 400 * (2 * k + 1)); };
  EXPECT_NEAR(per_area(0), 0.08, 0.02);
  EXPECT_LT(per_area(2), 0.65 * per_area(1));
}

/// Pair correlation: 0 within the distance kept, about 1 far away; at random it is 1 everywhere.
TEST(Scatter, IsBlueNoise) {
  ScatterSettings settings = mixed();
  settings.species = {{"fern", 1}};
  settings.density = 0.05;
  const auto plants = scattered(flat(360), settings);
  const double spacing = jamming_distance(0.05);
  constexpr int bins = 12;
  double pairs[bins] = {};
  const double width = 3 * spacing / bins;
  int inner = 0;
  for (const Instance& a : plants) {
    if (std::max(std::abs(a.position.x), std::abs(a.position.y)) > 160) continue;
    ++inner;
    for (const Instance& b : plants) {
      const double d = std::hypot(static_cast<double>(a.position.x - b.position.x),
                                  static_cast<double>(a.position.y - b.position.y));
      if (d > 0 && d < 3 * spacing) pairs[static_cast<int>(d / width)] += 1;
    }
  }
  for (int k = 0; k < bins; ++k) {
    const double ring = pi_d * width * width * (2 * k + 1);
    const double g = pairs[k] / (inner * ring * density_of(plants, 360));
    const double from = k * width / spacing;
    if (from + 3.0 / bins < 0.7) {
      EXPECT_EQ(g, 0) << from;
    }
    if (from > 1.6) {
      EXPECT_NEAR(g, 1, 0.06) << from;
    }
  }
  // Variance of counts in squares: far below the mean, which a random field would have.
  constexpr int squares = 15;
  std::vector<double> count(squares * squares);
  for (const Instance& p : plants) {
    const int i = std::min(squares - 1, static_cast<int>((p.position.x + 180) / 24));
    const int j = std::min(squares - 1, static_cast<int>((p.position.y + 180) / 24));
    const int square = j * squares + i;
    count[static_cast<std::size_t>(square)] += 1;
  }
  double sum = 0, sum_2 = 0;
  for (const double c : count) sum += c, sum_2 += c * c;
  const double mean = sum / (squares * squares);
  EXPECT_LT(sum_2 / (squares * squares) - mean * mean, 0.45 * mean);
}

TEST(Scatter, SpeciesFormGroups) {
  // Share of ferns in squares of 25 m varies far more than by chance.
  const auto spread = [](float patchiness) {
    ScatterSettings settings = mixed();
    settings.patchiness = patchiness;
    double ferns[256] = {}, all[256] = {};
    for (const Instance& p : scattered(flat(400), settings)) {
      const int i = std::min(15, static_cast<int>((p.position.x + 200) / 25));
      const int j = std::min(15, static_cast<int>((p.position.y + 200) / 25));
      all[j * 16 + i] += 1;
      ferns[j * 16 + i] += p.species;
    }
    double variance = 0;
    for (int k = 0; k < 256; ++k) variance += std::pow(ferns[k] / all[k] - 0.75, 2) / 256;
    return variance;
  };
  EXPECT_GT(spread(1), 4 * spread(0));
}

TEST(Scatter, ClumpsLeaveBareGround) {
  ScatterSettings settings = mixed();
  settings.where.clumping = 1;
  settings.where.clump_size = 50;
  int empty = 0;
  int count[400] = {};
  const auto plants = scattered(flat(400), settings);
  for (const Instance& p : plants) {
    const int i = std::min(19, static_cast<int>((p.position.x + 200) / 20));
    const int j = std::min(19, static_cast<int>((p.position.y + 200) / 20));
    ++count[j * 20 + i];
  }
  for (const int c : count) empty += c == 0;
  EXPECT_GT(empty, 40);
  EXPECT_LT(empty, 300);
}

TEST(Scatter, PlantsStandInTheGroundAndVary) {
  const Heightfield slope = ground_of(200, [](double x, double) { return 0.4 * x; });
  ScatterSettings settings = mixed();
  settings.tilt = 3;
  std::set<std::uint16_t> models;
  std::set<std::uint32_t> individuals;
  const auto plants = scattered(slope, settings);
  for (const Instance& p : plants) {
    const float ground = ground_at(slope, {p.position.x, p.position.y}).height;
    EXPECT_LT(p.position.z, ground);
    EXPECT_GT(p.position.z, ground - 0.3F);
    // A birch has a stem of 0.2 m; upright on this slope its foot spans 0.16 m of height.
    if (p.species == 0) {
      EXPECT_LT(p.position.z, ground - 0.1F);
    }
    EXPECT_NEAR(glm::length(p.up), 1, 1e-5);
    EXPECT_LE(degrees(std::acos(std::min(p.up.z, 1.0F))), 3.01F);
    EXPECT_TRUE(settings.scale.contains(p.scale));
    EXPECT_LT(p.model, p.species == 0 ? 5 : 3);
    if (p.species == 0) models.insert(p.model);
    individuals.insert(p.individual);
  }
  EXPECT_EQ(models.size(), 5U);
  EXPECT_GT(individuals.size(), plants.size() - 3);
  settings.align = 1;
  settings.tilt = 0;
  const Vec3 normal = glm::normalize(Vec3(-0.4F, 0, 1));
  for (const Instance& p : scattered(slope, settings)) {
    ASSERT_NEAR(p.up.x, normal.x, 0.02F);
    ASSERT_NEAR(p.up.y, 0, 0.02F);
  }
}

TEST(Scatter, NothingToScatterIsNothing) {
  ScatterSettings none = mixed();
  none.density = 0;
  EXPECT_TRUE(scattered(flat(100), none).empty());
  Progress progress;
  EXPECT_TRUE(scatter(flat(100), {}, {}, {}, 1, progress).empty());
}

TEST(Scatter, ErrorsSayWhatIsWrong) {
  ScatterSettings settings;
  settings.species = {{"birhc", 1}};
  try {
    plan_scatter(settings, birch_and_fern());
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "'species' in 'scatter' names 'birhc', but no species is called that. Did you mean "
        "'birch'?");
  }
  ScatterSettings huge = mixed();
  huge.species = {{"fern", 1}};
  huge.density = 10000;
  std::vector<SpeciesSettings> species = birch_and_fern();
  species[1].radius = 0.001F;
  Progress progress;
  try {
    scatter(flat(40000), huge, species, {}, 1, progress);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
  }
  progress.cancel();
  EXPECT_THROW(scatter(flat(400), mixed(), birch_and_fern(), {}, 1, progress), Error);
}

TEST(Scatter, DescriptionListsEveryParameterOnce) {
  ScatterSettings settings;
  const ParameterSet set = describe(settings);
  std::set<std::string> names;
  for (const std::string& name : set.names()) EXPECT_TRUE(names.insert(name).second) << name;
  set.assign(&settings, "slope", std::vector<double>{5, 20});
  EXPECT_EQ(settings.where.slope, (Range{5, 20}));
  set.assign(&settings, "species", Weights{{"birch", 3}});
  EXPECT_EQ(settings.species.size(), 1U);
}

}  // namespace
}  // namespace wold
