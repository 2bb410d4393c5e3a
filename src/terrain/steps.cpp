#include "terrain/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "terrain/step_cell.hpp"
#include "terrain/step_check.hpp"
#include "terrain/step_mask.hpp"

namespace wold {

namespace {

using Results = std::map<std::string, TerrainResult>;

Heightfield flat(const TerrainWindow& window) {
  return {Grid<float>(window.width, window.height), window.origin, window.cell};
}

TerrainWindow grown(const TerrainWindow& window, int margin) {
  return {window.origin - DVec2(margin * window.cell), window.cell, window.width + 2 * margin,
          window.height + 2 * margin};
}

Grid<float> cropped(const Grid<float>& grid, int margin) {
  if (margin == 0) return grid;
  Grid<float> out(grid.width() - 2 * margin, grid.height() - 2 * margin);
  for (int j = 0; j < out.height(); ++j)
    std::copy_n(grid.row(j + margin).begin() + margin, out.width(), out.row(j).begin());
  return out;
}

/// A mask goes by the name of its step alone.
std::string map_name(const std::string& step, const std::string& map) {
  return map == "mask" ? step : step + "." + map;
}

float blended(Blend blend, float before, float output) {
  switch (blend) {
    case Blend::add: return before + output;
    case Blend::subtract: return before - output;
    case Blend::multiply: return before * output;
    case Blend::max: return std::max(before, output);
    case Blend::min: return std::min(before, output);
    case Blend::automatic:
    case Blend::replace: break;
  }
  return output;
}

/// Blends in place of the output.
void blend_into(Grid<float>& output, const Grid<float>& before, Blend blend,
                const Grid<float>& mask) {
  parallel_for(
      0, output.height(),
      [&](int j) {
        for (int i = 0; i < output.width(); ++i) {
          const float old = before(i, j);
          const float made = blended(blend, old, output(i, j));
          output(i, j) = mask.empty() ? made : old + mask(i, j) * (made - old);
        }
      },
      16);
}

/// Runs one step after another.
class Evaluation {
 public:
  /// `cell` is the distance between the terrain's own samples, of which `ground` may have fewer.
  Evaluation(const TerrainDomain& domain, double cell, Heightfield ground, std::uint64_t seed,
             const std::filesystem::path& folder, Progress& progress)
      : domain_(domain),
        cell_(cell),
        seed_(seed),
        folder_(folder),
        progress_(progress),
        ground_(std::move(ground)) {}

  void run_all(std::span<const TerrainStep> steps, std::span<const TerrainOperator> operators) {
    for (const TerrainStep& step : steps) {
      try {
        run(step, find_operator(operators, step.op, step.location));
      } catch (const Error& error) {
        throw error.at(step.location);
      }
    }
  }

  TerrainResult take() { return {std::move(ground_), std::move(maps_), std::move(balances_)}; }

 private:
  void run(const TerrainStep& step, const TerrainOperator& op) {
    const int place = places_[step.op]++;
    if (!step.settings.enabled) return;
    const std::string& name = step.settings.name.empty() ? step.op : step.settings.name;
    const TerrainContext context{
        step_seed(seed_, step, place), domain_, folder_, named_, progress_, &maps_};
    const Heightfield& input =
        step.settings.input.empty() ? ground_ : context.step(step.settings.input).field;
    const ProgressStage stage(progress_, name, 0, "");
    TerrainResult result = run_at_cell(op, input, step.parameters, cell_of(step, input), context);
    if (!result.field.height.same_shape(input.height))
      throw Error(ErrorKind::internal,
                  fmt::format("operator '{}' changed the size of the terrain", step.op));
    Grid<float> mask;
    if (has_mask(step.settings)) mask = step_mask(input, step.settings, context);
    blend_into(result.field.height, input.height, actual_blend(step, op), mask);
    progress_.check();
    keep(step, std::move(result));
  }

  /// A coarser view of the terrain, such as the land around it, is not worth finer steps than its
  /// own samples.
  double cell_of(const TerrainStep& step, const Heightfield& input) const {
    const bool coarser = input.cell > (1 + 1e-6) * cell_;
    return coarser && input.cell > step.settings.cell ? 0 : step.settings.cell;
  }

  void keep(const TerrainStep& step, TerrainResult result) {
    const std::string& owner = step.settings.name;
    for (const auto& [name, map] : result.maps) {
      maps_.insert_or_assign(name, map);
      if (!owner.empty()) maps_.insert_or_assign(map_name(owner, name), map);
    }
    for (Balance& balance : result.balances) {
      balance.step = owner.empty() ? step.op : owner;
      balances_.push_back(balance);
    }
    ground_ = result.field;
    if (!owner.empty()) named_.insert_or_assign(owner, std::move(result));
  }

  TerrainDomain domain_;
  double cell_;
  std::uint64_t seed_;
  const std::filesystem::path& folder_;
  Progress& progress_;
  Heightfield ground_;
  std::map<std::string, Grid<float>> maps_;
  std::vector<Balance> balances_;
  Results named_;
  std::map<std::string, int> places_;
};

}  // namespace

Description<TerrainSettings> describe(const TerrainSettings&) {
  return Description<TerrainSettings>("terrain",
                                      "The ground: its extent, and how finely it is "
                                      "sampled.")
      .add("size", &TerrainSettings::size, {.unit = "m", .min = 1, .max = 1e6},
           "Extent from west to east.")
      .add("size_north", &TerrainSettings::size_north, {.unit = "m", .min = 0, .max = 1e6},
           "Extent from south to north; 0 for a square.")
      .add("resolution", &TerrainSettings::resolution, {.unit = "samples", .min = 2, .max = 1e7},
           "Samples from west to east; more show finer detail of the same landscape.")
      .add("center", &TerrainSettings::center, {.unit = "m"},
           "The place in the world of the middle, east and north.");
}

TerrainDomain domain_of(const TerrainSettings& settings) {
  const double north = settings.size_north > 0 ? settings.size_north : settings.size;
  const DVec2 size(settings.size, north);
  return {settings.center - 0.5 * size, size};
}

TerrainWindow window_of(const TerrainSettings& settings) {
  const TerrainDomain domain = domain_of(settings);
  TerrainWindow window;
  window.origin = domain.origin;
  window.width = std::max(2, settings.resolution);
  window.cell = domain.size.x / (window.width - 1);
  window.height = std::max(2, static_cast<int>(std::lround(domain.size.y / window.cell)) + 1);
  return window;
}

Description<StepSettings> describe(const StepSettings&) {
  using S = StepSettings;
  return Description<S>("step", "What every terrain step has besides its operator's parameters.")
      .add("name", &S::name, "A name that later steps can refer to.")
      .add("input", &S::input,
           "The named step whose ground this one takes; default: the step "
           "before.")
      .add("mask", &S::mask,
           "Where the step acts: a named step's map, any map made before, or a "
           "picture.")
      .add("mask_invert", &S::mask_invert, "Acts where the mask is dark instead.")
      .add("mask_height", &S::mask_height, {.unit = "m", .min = -1e5, .max = 1e5},
           "Acts only where the input's height is in this range.")
      .add("mask_slope", &S::mask_slope, {.unit = "degrees", .min = 0, .max = 90},
           "Acts only where the input's slope is in this range.")
      .add("mask_height_feather", &S::mask_height_feather, {.unit = "m", .min = 0, .max = 1e5},
           "Width of the soft edge of mask_height.")
      .add("mask_slope_feather", &S::mask_slope_feather, {.unit = "degrees", .min = 0, .max = 90},
           "Width of the soft edge of mask_slope.")
      .choice("blend", &S::blend,
              {"automatic", "replace", "add", "subtract", "multiply", "max", "min"},
              "How the output meets the input; automatic adds what makes ground and replaces by "
              "what changes it.")
      .add("opacity", &S::opacity, {.min = 0, .max = 1}, "How much of the step is seen.")
      .add("cell", &S::cell, {.unit = "m", .min = 0, .max = 1e5},
           "Works on samples this far apart and adds the change to the ground; 0: the terrain's.")
      .add("seed", &S::seed, {.min = 0, .max = 4294967295.0},
           "Another number gives other random ground.")
      .add("enabled", &S::enabled, "False skips the step.");
}

TerrainStep make_step(std::span<const TerrainOperator> operators, std::string_view op,
                      const SourceLocation& where) {
  const TerrainOperator& found = find_operator(operators, op, where);
  return {found.name(), found.defaults, {}, where};
}

Blend actual_blend(const TerrainStep& step, const TerrainOperator& op) {
  if (step.settings.blend != Blend::automatic) return step.settings.blend;
  return op.makes_ground ? Blend::add : Blend::replace;
}

std::uint64_t step_seed(std::uint64_t seed, const TerrainStep& step, int place_among_its_kind) {
  const std::uint64_t who =
      step.settings.name.empty()
          ? random_bits(hash_text(step.op), place_among_its_kind)
          : random_bits(hash_text(step.settings.name), std::uint64_t{0x6e616d65});
  return random_bits(seed, who, step.settings.seed);
}

void assign(TerrainStep& step, std::string_view name, const Value& value,
            const SourceLocation& where) {
  const ParameterSet& own = step.parameters.parameters();
  const ParameterSet common = describe(step.settings);
  if (own.find(name) == nullptr && common.find(name) == nullptr) {
    std::vector<std::string> names = own.names();
    for (const std::string& n : common.names()) names.push_back(n);
    throw Error(
        ErrorKind::input,
        fmt::format("unknown parameter '{}' in '{}'.{}", name, step.op, suggestion(name, names)),
        where);
  }
  if (own.find(name) != nullptr)
    step.parameters.assign(name, value, where);
  else
    common.assign(&step.settings, name, value, where);
}

TerrainResult evaluate(const TerrainSettings& settings, std::span<const TerrainStep> steps,
                       std::span<const TerrainOperator> operators, std::uint64_t seed,
                       const std::filesystem::path& folder, Progress& progress) {
  return evaluate(settings, window_of(settings), steps, operators, seed, folder, progress);
}

TerrainResult evaluate(const TerrainSettings& settings, const TerrainWindow& window,
                       std::span<const TerrainStep> steps,
                       std::span<const TerrainOperator> operators, std::uint64_t seed,
                       const std::filesystem::path& folder, Progress& progress) {
  check_terrain(window, steps, operators, folder);
  const int margin = margin_of(window, steps, operators);
  Evaluation evaluation(domain_of(settings), window_of(settings).cell, flat(grown(window, margin)),
                        seed, folder, progress);
  evaluation.run_all(steps, operators);
  TerrainResult result = evaluation.take();
  result.field = {cropped(result.field.height, margin), window.origin, window.cell};
  for (auto& [name, map] : result.maps) map = cropped(map, margin);
  return result;
}

TerrainResult evaluate_on(const Heightfield& ground, std::span<const TerrainStep> steps,
                          std::span<const TerrainOperator> operators, std::uint64_t seed,
                          const std::filesystem::path& folder, Progress& progress) {
  const Grid<float>& height = ground.height;
  const TerrainWindow window{ground.origin, ground.cell, height.width(), height.height()};
  check_terrain(window, steps, operators, folder);
  Evaluation evaluation({ground.origin, ground.size()}, ground.cell, ground, seed, folder,
                        progress);
  evaluation.run_all(steps, operators);
  return evaluation.take();
}

}  // namespace wold
