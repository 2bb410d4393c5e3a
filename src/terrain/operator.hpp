#pragma once
// A terrain operator, without its type: something that makes ground or changes it.
//
// An operator is a plain struct of parameters, its `describe`, and one function that does the
// work; `terrain_operator` wraps the three into a value that step lists can hold:
//
//   struct Blur { float distance = 20; };
//   Description<Blur> describe(const Blur&);
//   Heightfield blur(const Heightfield& input, const Blur& parameters, const TerrainContext&);
//
//   terrain_operator(blur, {.reach = …})
//
// Rooms above make operators of their own in the same way; whoever reads a scene concatenates the
// lists.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/parameters.hpp"
#include "base/progress.hpp"
#include "terrain/balance.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

/// Ground, and maps over the same samples (masks, flow, sediment, …) by name.
struct TerrainResult {
  Heightfield field;
  std::map<std::string, Grid<float>> maps;
  std::vector<Balance> balances = {};  ///< of what the operator moved
};

/// A rectangle of the world, m.
struct TerrainDomain {
  DVec2 origin{0};  ///< south-west corner
  DVec2 size{0};

  DVec2 center() const { return origin + 0.5 * size; }
};

/// What an operator may know besides its parameters and its input.
struct TerrainContext {
  std::uint64_t seed;            ///< belongs to this step
  TerrainDomain domain;          ///< the whole terrain, of which the input may be a window
  std::filesystem::path folder;  ///< paths in parameters are relative to it
  const std::map<std::string, TerrainResult>& named;  ///< results of the named steps before
  Progress& progress;
  /// Maps that steps before made, by name, over the whole window; or null for none.
  const std::map<std::string, Grid<float>>* maps = nullptr;

  /// The result of a named step. Throws Error(input) with the nearest name.
  const TerrainResult& step(std::string_view name) const;
};

/// What the evaluation must know about an operator before it runs.
template <class T>
struct OperatorTraits {
  /// Makes ground whatever its input: the default blend is `add`; otherwise `replace`.
  bool makes_ground = false;
  /// How far (m) outside a place the input still matters there; so much more than the window is
  /// computed, that tiles agree at their borders. `cell` is the distance of samples, m. Operators
  /// that reach without end (flow of water) leave it out.
  std::function<double(const T&, double cell)> reach = {};
  /// Names of steps that the parameters refer to.
  std::function<std::vector<std::string>(const T&)> references = {};
  /// Maps that the parameters refer to, as `map_over` finds them; empty names are none.
  std::function<std::vector<std::string>(const T&)> map_references = {};
  /// Names of the maps that come out.
  std::vector<std::string> maps = {};
  /// Working memory besides input and output, bytes per sample.
  double bytes_per_sample = 8;
};

struct TerrainOperator {
  Described defaults;
  bool makes_ground = false;
  std::vector<std::string> maps;
  double bytes_per_sample = 8;
  std::function<double(const Described&, double cell)> reach;
  std::function<std::vector<std::string>(const Described&)> references;
  std::function<std::vector<std::string>(const Described&)> map_references;
  std::function<TerrainResult(const Heightfield&, const Described&, const TerrainContext&)> run;

  const std::string& name() const { return defaults.parameters().name; }
  const std::string& text() const { return defaults.parameters().text; }
};

namespace detail {

template <class Out, class T>
TerrainOperator make_terrain_operator(Out (*work)(const Heightfield&, const T&,
                                                  const TerrainContext&),
                                      const OperatorTraits<T>& traits) {
  static_assert(std::is_same_v<Out, Heightfield> || std::is_same_v<Out, TerrainResult>);
  TerrainOperator op;
  op.defaults = Described::of(T{});
  op.makes_ground = traits.makes_ground;
  op.maps = traits.maps;
  op.bytes_per_sample = traits.bytes_per_sample;
  op.reach = [reach = traits.reach](const Described& parameters, double cell) {
    return reach ? reach(parameters.as<T>(), cell) : 0.0;
  };
  op.references = [references = traits.references](const Described& parameters) {
    return references ? references(parameters.as<T>()) : std::vector<std::string>{};
  };
  op.map_references = [references = traits.map_references](const Described& parameters) {
    return references ? references(parameters.as<T>()) : std::vector<std::string>{};
  };
  op.run = [work](const Heightfield& input, const Described& parameters,
                  const TerrainContext& context) -> TerrainResult {
    if constexpr (std::is_same_v<Out, Heightfield>)
      return {work(input, parameters.as<T>(), context), {}, {}};
    else
      return work(input, parameters.as<T>(), context);
  };
  return op;
}

}  // namespace detail

/// Wraps a function from ground to ground.
template <class T>
TerrainOperator terrain_operator(Heightfield (*work)(const Heightfield&, const T&,
                                                     const TerrainContext&),
                                 const std::type_identity_t<OperatorTraits<T>>& traits = {}) {
  return detail::make_terrain_operator(work, traits);
}
/// Wraps a function from ground to ground and maps.
template <class T>
TerrainOperator terrain_operator(TerrainResult (*work)(const Heightfield&, const T&,
                                                       const TerrainContext&),
                                 const std::type_identity_t<OperatorTraits<T>>& traits = {}) {
  return detail::make_terrain_operator(work, traits);
}

using OperatorList = std::vector<TerrainOperator>;

/// The operator of that name. Throws Error(input) with the nearest name.
const TerrainOperator& find_operator(std::span<const TerrainOperator> operators,
                                     std::string_view name, const SourceLocation& where = {});

}  // namespace wold
