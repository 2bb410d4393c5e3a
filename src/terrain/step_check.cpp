#include "terrain/step_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/memory.hpp"

namespace wold {

namespace {

/// Names that a step may refer to: steps and maps made before it.
struct KnownNames {
  std::set<std::string> steps;
  std::set<std::string> maps;

  std::vector<std::string> all() const {
    std::vector<std::string> list(steps.begin(), steps.end());
    list.insert(list.end(), maps.begin(), maps.end());
    return list;
  }
};

void require_step(const std::string& name, const char* what, const KnownNames& known) {
  if (known.steps.contains(name)) return;
  const std::vector<std::string> names(known.steps.begin(), known.steps.end());
  throw Error(ErrorKind::input, fmt::format("{} '{}' is no named step before this one.{}", what,
                                            name, suggestion(name, names)));
}

void require_file(const std::filesystem::path& folder, const std::string& path, const char* what) {
  if (std::filesystem::exists(folder / path)) return;
  throw Error(ErrorKind::input, fmt::format("{} '{}' does not exist", what,
                                            (folder / path).lexically_normal().string()));
}

void require_map(const std::string& mask, const char* what, const KnownNames& known,
                 const std::filesystem::path& folder) {
  if (mask.empty() || known.steps.contains(mask) || known.maps.contains(mask)) return;
  if (std::filesystem::path(mask).has_extension()) {
    const std::string owner = mask.substr(0, mask.find('.'));
    if (!known.steps.contains(owner)) return require_file(folder, mask, what);
  }
  throw Error(ErrorKind::input,
              fmt::format("{} '{}' is neither a map or step before this one nor a picture.{}", what,
                          mask, suggestion(mask, known.all())));
}

void check_files(const Described& parameters, const std::filesystem::path& folder) {
  for (const Parameter& p : parameters.parameters().parameters) {
    if (p.kind != ParameterKind::file) continue;
    const auto path = std::get<std::string>(p.get(parameters.data()));
    if (!path.empty()) require_file(folder, path, "the file");
  }
}

void check_step(const TerrainStep& step, const TerrainOperator& op, KnownNames& known,
                const std::filesystem::path& folder) {
  if (!step.settings.input.empty()) require_step(step.settings.input, "input", known);
  require_map(step.settings.mask, "mask", known, folder);
  for (const std::string& name : op.references(step.parameters)) require_step(name, "step", known);
  for (const std::string& name : op.map_references(step.parameters))
    require_map(name, "map", known, folder);
  check_files(step.parameters, folder);
  const std::string& name = step.settings.name;
  if (!name.empty() && !known.steps.insert(name).second)
    throw Error(ErrorKind::input, fmt::format("a step before this one is also named '{}'", name));
  for (const std::string& map : op.maps) {
    known.maps.insert(map);
    if (!name.empty() && map != "mask") known.maps.insert(fmt::format("{}.{}", name, map));
  }
}

void check_memory(const TerrainWindow& window, std::span<const TerrainStep> steps,
                  std::span<const TerrainOperator> operators) {
  const double needed = memory_estimate(window, steps, operators);
  const auto available = static_cast<double>(available_memory());
  if (available <= 0 || needed <= 0.9 * available) return;
  const double shrink = std::sqrt(0.9 * available / needed);
  const int fits = std::max(2, static_cast<int>(window.width * shrink));
  throw Error(
      ErrorKind::limit,
      fmt::format("a terrain of {} x {} samples needs about {}, but {} are free; a "
                  "resolution of {} would fit",
                  window.width, window.height, memory_text(needed), memory_text(available), fits));
}

}  // namespace

int margin_of(const TerrainWindow& window, std::span<const TerrainStep> steps,
              std::span<const TerrainOperator> operators) {
  double cells = 0;
  for (const TerrainStep& step : steps) {
    if (!step.settings.enabled) continue;
    const TerrainOperator& op = find_operator(operators, step.op, step.location);
    cells += std::ceil(op.reach(step.parameters, window.cell) / window.cell);
    const bool slope_matters =
        step.settings.mask_slope.low > 0 || step.settings.mask_slope.high < 90;
    if (slope_matters) cells += 1;
  }
  return static_cast<int>(std::min(cells, 1e8));
}

double memory_estimate(const TerrainWindow& window, std::span<const TerrainStep> steps,
                       std::span<const TerrainOperator> operators) {
  const double margin = margin_of(window, steps, operators);
  const double samples = (window.width + 2 * margin) * (window.height + 2 * margin);
  double most_at_once = 0;
  double kept = 2 * sizeof(float);  // the ground and what comes out of a step
  for (const TerrainStep& step : steps) {
    if (!step.settings.enabled) continue;
    const TerrainOperator& op = find_operator(operators, step.op, step.location);
    most_at_once = std::max(most_at_once, op.bytes_per_sample + sizeof(float));
    const std::size_t copies = step.settings.name.empty() ? 1 : 3;
    kept += static_cast<double>(sizeof(float) * copies * op.maps.size());
    if (!step.settings.name.empty()) kept += sizeof(float);
  }
  return samples * (kept + most_at_once);
}

void check_terrain(const TerrainWindow& window, std::span<const TerrainStep> steps,
                   std::span<const TerrainOperator> operators,
                   const std::filesystem::path& folder) {
  KnownNames known;
  for (const TerrainStep& step : steps) {
    const TerrainOperator& op = find_operator(operators, step.op, step.location);
    if (!step.settings.enabled) continue;
    try {
      check_step(step, op, known, folder);
    } catch (const Error& error) {
      throw error.at(step.location);
    }
  }
  check_memory(window, steps, operators);
}

}  // namespace wold
