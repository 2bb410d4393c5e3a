// What every erosion promises, whatever it does: nothing lost, the same bits on any number of
// threads, input untouched, work that can be stopped, and errors before it.

#include "erosion/operators.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "erosion/ground.hpp"
#include "noise/fractal.hpp"

namespace wold {
namespace {

/// Mountains of noise, 20 m apart.
Heightfield mountains(int width, int height) {
  const FractalSampler noise(Fractal{.kind = FractalKind::ridged, .octaves = 7}, 5);
  Heightfield field{Grid<float>(width, height), {1000, -500}, 20};
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      field.height(i, j) = 500 + 400 * noise(DVec2(i, j) * (20.0 / 1100)).value;
  return field;
}

TerrainResult run(const TerrainOperator& op, const Described& parameters, const Heightfield& input,
                  Progress& progress) {
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{7, {input.origin, input.size()}, {}, none, progress};
  return op.run(input, parameters, context);
}

TerrainResult run(const TerrainOperator& op, const Heightfield& input) {
  Progress progress;
  return run(op, op.defaults, input, progress);
}

class EveryErosion : public testing::TestWithParam<TerrainOperator> {};

TEST_P(EveryErosion, LosesNothing) {
  const Heightfield input = mountains(60, 47);
  const TerrainResult result = run(GetParam(), input);
  ASSERT_TRUE(result.field.height.same_shape(input.height));
  for (const Balance& b : result.balances) {
    EXPECT_LE(std::abs(b.error()), 1e-6 * b.moved) << b.quantity << " moved " << b.moved;
    if (b.quantity == "ground") {
      EXPECT_NEAR(b.before, volume(input.height, input.cell), 1e-7 * b.before);
    }
  }
}

TEST_P(EveryErosion, SameBitsOnAnyNumberOfThreads) {
  const Heightfield input = mountains(131, 67);
  TerrainResult first;
  for (const int threads : {1, 4, 2}) {
    const ThreadLimit limit(threads);
    TerrainResult result = run(GetParam(), input);
    if (first.field.height.empty()) {
      first = std::move(result);
      continue;
    }
    EXPECT_TRUE(result.field.height == first.field.height) << threads;
    EXPECT_TRUE(result.maps == first.maps) << threads;
  }
}

TEST_P(EveryErosion, MakesTheMapsThatItNames) {
  const Heightfield input = mountains(33, 24);
  const TerrainResult result = run(GetParam(), input);
  for (const auto& [name, map] : result.maps) {
    const std::vector<std::string>& named = GetParam().maps;
    EXPECT_NE(std::find(named.begin(), named.end(), name), named.end()) << name;
    EXPECT_TRUE(map.same_shape(input.height)) << name;
    for (const float v : map.values()) ASSERT_TRUE(std::isfinite(v)) << name;
  }
  for (const float h : result.field.height.values()) ASSERT_TRUE(std::isfinite(h));
}

TEST_P(EveryErosion, WorksOnTheSmallestGround) {
  for (const auto& [width, height] : {std::pair(2, 2), std::pair(2, 5), std::pair(9, 3)}) {
    const TerrainResult result = run(GetParam(), mountains(width, height));
    for (const float h : result.field.height.values()) EXPECT_TRUE(std::isfinite(h));
  }
}

TEST_P(EveryErosion, RefusesGroundThatIsNone) {
  const auto text = [](const Heightfield& input) -> std::string {
    try {
      run(GetParam(), input);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return error.message();
    }
    return "no error";
  };
  const std::string who = "'" + GetParam().name() + "' needs ";
  Heightfield input = mountains(40, 30);
  input.height(12, 7) = std::numeric_limits<float>::quiet_NaN();
  const std::string nan =
      "heights that are finite numbers; sample (12, 7), counted from the south-west, has none";
  EXPECT_EQ(text(input), who + nan);
  input.height(12, 7) = std::numeric_limits<float>::infinity();
  EXPECT_EQ(text(input), who + nan);
  EXPECT_EQ(text(mountains(1, 1)), who + "ground of at least 2 x 2 samples; this has 1 x 1");
  EXPECT_EQ(text({}), who + "ground of at least 2 x 2 samples; this has 0 x 0");
  input = mountains(4, 4);
  input.cell = 0;
  EXPECT_EQ(text(input), who + "samples a distance above 0 apart; these are 0 m");
}

/// A value just outside what the parameter may be, or nothing.
std::optional<Value> forbidden(const Parameter& p) {
  const bool below = std::isfinite(p.limits.min);
  if (!below && !std::isfinite(p.limits.max)) return std::nullopt;
  const double value = below ? p.limits.min - 1 : p.limits.max + 1;
  if (p.kind == ParameterKind::number) return value;
  if (p.kind == ParameterKind::integer && value >= 0) return static_cast<std::int64_t>(value);
  return std::nullopt;
}

TEST_P(EveryErosion, RefusesParametersOutOfRangeByName) {
  const Heightfield input = mountains(16, 16);
  for (const Parameter& p : GetParam().defaults.parameters().parameters) {
    const std::optional<Value> value = forbidden(p);
    if (!value) continue;
    Described parameters = GetParam().defaults;
    p.set(parameters.data(), *value);
    Progress progress;
    try {
      run(GetParam(), parameters, input, progress);
      ADD_FAILURE() << p.name << " of " << to_text(*value) << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_NE(error.message().find("'" + p.name + "' in '" + GetParam().name() + "'"),
                std::string::npos)
          << error.message();
      EXPECT_NE(error.message().find(p.allowed()), std::string::npos) << error.message();
    }
  }
}

TEST_P(EveryErosion, RefusesMapsThatAreNotThere) {
  for (const Parameter& p : GetParam().defaults.parameters().parameters) {
    Described parameters = GetParam().defaults;
    if (p.kind != ParameterKind::text) continue;
    p.set(parameters.data(), std::string("nowhere.png"));
    if (GetParam().map_references(parameters).empty()) continue;
    Progress progress;
    EXPECT_THROW(run(GetParam(), parameters, mountains(16, 16), progress), Error) << p.name;
  }
}

TEST_P(EveryErosion, StopsAndLeavesItsInput) {
  const Heightfield input = mountains(300, 200);
  const Heightfield copy = input;
  std::atomic<bool> stop = false;
  Progress progress({}, &stop);
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stop = true;
  });
  try {
    run(GetParam(), GetParam().defaults, input, progress);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::cancelled);
  }
  stopper.join();
  EXPECT_TRUE(input.height == copy.height);
}

TEST_P(EveryErosion, StopsBeforeItBegins) {
  Progress progress;
  progress.cancel();
  EXPECT_THROW(run(GetParam(), GetParam().defaults, mountains(40, 30), progress), Error);
}

INSTANTIATE_TEST_SUITE_P(Operators, EveryErosion, testing::ValuesIn(erosion_operators()),
                         [](const auto& op) { return op.param.name(); });

}  // namespace
}  // namespace wold
