#include "terrain/operators.hpp"

#include "terrain/arithmetic.hpp"
#include "terrain/blur.hpp"
#include "terrain/combine.hpp"
#include "terrain/diamond_square.hpp"
#include "terrain/eroded_noise.hpp"
#include "terrain/falloff.hpp"
#include "terrain/fbm.hpp"
#include "terrain/hybrid.hpp"
#include "terrain/import.hpp"
#include "terrain/mask.hpp"
#include "terrain/plane.hpp"
#include "terrain/ridged.hpp"
#include "terrain/terrace.hpp"
#include "terrain/turbulence.hpp"
#include "terrain/warp.hpp"

namespace wold {

OperatorList terrain_operators() {
  const auto reach = [](const auto& parameters, double cell) { return reach_of(parameters, cell); };
  const auto other = [](const Combine& parameters) {
    return std::vector<std::string>{parameters.with};
  };
  const auto maps_of_mask = [](const Mask& parameters) {
    const bool of_map = parameters.from == MaskSource::map;
    return std::vector<std::string>{of_map ? parameters.map : "", parameters.times};
  };
  const auto map_of = [](const auto& parameters) {
    return std::vector<std::string>{parameters.map};
  };
  return {
      terrain_operator(fbm, {.makes_ground = true}),
      terrain_operator(hybrid, {.makes_ground = true}),
      terrain_operator(ridged, {.makes_ground = true}),
      terrain_operator(turbulence, {.makes_ground = true}),
      terrain_operator(eroded_noise, {.makes_ground = true}),
      terrain_operator(diamond_square, {.makes_ground = true}),
      terrain_operator(constant, {.makes_ground = true}),
      terrain_operator(plane, {.makes_ground = true}),
      terrain_operator(import_picture, {.makes_ground = true}),
      terrain_operator(warp, {.reach = reach}),
      terrain_operator(blur, {.reach = reach}),
      terrain_operator(terrace),
      terrain_operator(falloff),
      terrain_operator(scale),
      terrain_operator(remap),
      terrain_operator(clamp_heights),
      terrain_operator(smooth_floor),
      terrain_operator(power),
      terrain_operator(combine, {.references = other}),
      terrain_operator(add_map, {.map_references = map_of}),
      terrain_operator(make_mask,
                       {.reach = reach, .map_references = maps_of_mask, .maps = {"mask"}}),
  };
}

}  // namespace wold
