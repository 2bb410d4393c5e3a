#pragma once
// One fractal over the land as a GLSL function (realtime/land_function.hpp).

#include <cstdint>
#include <string>

#include "base/vec.hpp"
#include "noise/fractal.hpp"

namespace wold {

/// The text of `vec3 NAME(vec2 place, float spacing)`: the fractal and its derivative per metre.
/// `middle` is the place in the world that GLSL's places are measured from, `seed` a step's.
/// `with_means`: octaves that fade out leave their mean behind (terrain/fractal_ground.hpp).
std::string fractal_function(const std::string& name, const Fractal& f, float feature_size,
                             DVec2 middle, std::uint64_t seed, bool with_means);

}  // namespace wold
