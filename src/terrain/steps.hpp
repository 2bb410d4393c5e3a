#pragma once
// Terrain as a list of steps. Each step runs one operator on its input (the ground of the step
// before, at first a plane at height 0) and blends what comes out into the input:
//
//   ground = mix(input, blend(input, output), opacity · mask)
//
// Parameters are in metres, degrees and years, and makers of ground are functions of the place in
// the world: so the same list gives the same landscape at every resolution, and any window of it
// (a neighbouring tile, a coarser surrounding) can be computed alone. Around a window the
// evaluation adds the margin that its operators reach (TerrainOperator::reach), so tiles agree at
// their borders.
//
// A step with a `cell` works on samples of that distance whatever the terrain's resolution, and its
// change of the ground is added to the finer (or coarser) ground: so what flows keeps its courses
// at every resolution, fine detail of the input stays, and an erosion can be tried quickly.
//
// A step's random numbers come from the scene's seed, the step's `seed`, and its name; without a
// name, from its operator and its place among the steps with that operator.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terrain/operator.hpp"

namespace wold {

struct TerrainSettings {
  double size = 4000;     ///< m, west to east
  double size_north = 0;  ///< m, south to north; 0: as `size`
  int resolution = 1025;  ///< samples west to east
  DVec2 center{0};        ///< m
};

Description<TerrainSettings> describe(const TerrainSettings&);

/// The whole terrain.
TerrainDomain domain_of(const TerrainSettings& settings);

/// A rectangle of samples to compute; need not lie inside the domain.
struct TerrainWindow {
  DVec2 origin{0};  ///< m, place of sample (0, 0)
  double cell = 1;  ///< m
  int width = 0;    ///< samples west to east
  int height = 0;   ///< samples south to north
};

/// The samples of the whole terrain.
TerrainWindow window_of(const TerrainSettings& settings);

enum class Blend {
  automatic,  ///< add for makers of ground, replace for others
  replace,
  add,
  subtract,
  multiply,  ///< the output's metres are taken as a factor
  max,
  min
};

/// What every step has besides its operator's parameters. In a scene they stand in one table.
struct StepSettings {
  std::string name;   ///< for `input`, `mask` and `with` of later steps
  std::string input;  ///< a named step; empty: the step before
  std::string mask;   ///< a named step or its map, or a picture; empty: everywhere
  bool mask_invert = false;
  Range mask_height{-1e5F, 1e5F};  ///< m, of the input
  Range mask_slope{0, 90};         ///< degrees, of the input
  float mask_height_feather = 40;  ///< m, width of the soft edge
  float mask_slope_feather = 8;    ///< degrees
  Blend blend = Blend::automatic;
  float opacity = 1;
  double cell = 0;  ///< m, distance of the samples that the step works on; 0: the terrain's
  std::uint32_t seed = 0;
  bool enabled = true;
};

Description<StepSettings> describe(const StepSettings&);

struct TerrainStep {
  std::string op;
  Described parameters;
  StepSettings settings;
  SourceLocation location;  ///< for errors
};

/// A step with default parameters. Throws Error(input) for an unknown operator.
TerrainStep make_step(std::span<const TerrainOperator> operators, std::string_view op,
                      const SourceLocation& where = {});

/// The seed of a step in a terrain with this seed: it stays the same when other steps are added
/// before. `place_among_its_kind`: how many steps of its operator stand before it.
std::uint64_t step_seed(std::uint64_t seed, const TerrainStep& step, int place_among_its_kind);

/// What Blend::automatic means for this step.
Blend actual_blend(const TerrainStep& step, const TerrainOperator& op);

/// Sets a common setting or a parameter of the operator. Throws Error(input).
void assign(TerrainStep& step, std::string_view name, const Value& value,
            const SourceLocation& where = {});

/// Throws what `evaluate` would throw before its work: Error(input) for unknown operators, unknown
/// names of steps and missing files, Error(limit) for what will not fit in memory.
void check_terrain(const TerrainWindow& window, std::span<const TerrainStep> steps,
                   std::span<const TerrainOperator> operators,
                   const std::filesystem::path& folder = {});

/// Evaluates the steps over the whole terrain. Paths in parameters are relative to `folder`. Maps
/// are named as their operator names them ("flow"; of several, the last) and, if their step has a
/// name, also "NAME.flow" (a "mask" just "NAME"). Throws as `check_terrain`, Error(cancelled),
/// Error(io).
TerrainResult evaluate(const TerrainSettings& settings, std::span<const TerrainStep> steps,
                       std::span<const TerrainOperator> operators, std::uint64_t seed,
                       const std::filesystem::path& folder, Progress& progress);

/// Evaluates them over a window of that terrain, or beyond it.
TerrainResult evaluate(const TerrainSettings& settings, const TerrainWindow& window,
                       std::span<const TerrainStep> steps,
                       std::span<const TerrainOperator> operators, std::uint64_t seed,
                       const std::filesystem::path& folder, Progress& progress);

/// Runs them on ground that exists already, all of which is the domain. Throws as above.
TerrainResult evaluate_on(const Heightfield& ground, std::span<const TerrainStep> steps,
                          std::span<const TerrainOperator> operators, std::uint64_t seed,
                          const std::filesystem::path& folder, Progress& progress);

}  // namespace wold
