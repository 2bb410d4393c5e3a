#pragma once
// One ground from two: the input and a named step, or a map.

#include "terrain/operator.hpp"

namespace wold {

enum class CombineMethod {
  add,
  subtract,
  multiply,  ///< the other's metres, times `scale`, are taken as a factor
  max,
  min,
  smooth_max,  ///< max rounded off over `softness`
  smooth_min,
  mix  ///< mix(input, other, amount)
};

struct Combine {
  std::string with = {};
  CombineMethod method = CombineMethod::smooth_max;
  float scale = 1;      ///< of the other
  float softness = 50;  ///< m
  float amount = 0.5F;
};

Description<Combine> describe(const Combine&);

/// Throws Error(input) if `with` names no step before.
Heightfield combine(const Heightfield& input, const Combine& parameters,
                    const TerrainContext& context);

/// Ground raised by a map: by the depth of water, so that lakes and rivers have a surface, or of
/// snow.
struct AddMap {
  std::string map = {};  ///< as `map_over` finds it
  float factor = 1;      ///< m per unit of the map
};

Description<AddMap> describe(const AddMap&);

/// Throws Error(input) for a name that is no map before.
Heightfield add_map(const Heightfield& input, const AddMap& parameters,
                    const TerrainContext& context);

}  // namespace wold
