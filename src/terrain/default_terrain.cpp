#include "terrain/default_terrain.hpp"

#include <initializer_list>
#include <utility>

namespace wold {

namespace {

using Parameters = std::initializer_list<std::pair<const char*, Value>>;

}  // namespace

std::vector<TerrainStep> default_terrain(std::span<const TerrainOperator> operators) {
  std::vector<TerrainStep> steps;
  const auto add = [&](const char* op, const Parameters& parameters) {
    steps.push_back(make_step(operators, op));
    for (const auto& [name, value] : parameters) assign(steps.back(), name, value);
  };
  add("fbm", {{"height", 200.0},
              {"base", 280.0},
              {"feature_size", 1300.0},
              {"octaves", std::int64_t{4}},
              {"hurst", 1.1}});
  add("ridged", {{"height", 320.0},
                 {"feature_size", 2400.0},
                 {"octaves", std::int64_t{2}},
                 {"hurst", 1.2},
                 {"smooth_ridges", 0.12},
                 {"blend", std::string("subtract")}});
  add("warp", {{"distance", 100.0}, {"feature_size", 900.0}});
  add("fbm", {{"height", 30.0}, {"feature_size", 300.0}, {"hurst", 1.1}});
  add("smooth_floor", {{"level", 90.0}, {"softness", 140.0}});
  return steps;
}

}  // namespace wold
