#pragma once
// A scene as a landscape that a fragment shader draws: its knobs, its values, its land.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "realtime/land_map.hpp"
#include "realtime/landscape_settings.hpp"
#include "scene/scene.hpp"

namespace wold {

/// A value of the scene that is no knob, as a line of GLSL.
struct LandscapeValue {
  std::string name;
  std::string value;  ///< GLSL
  std::string comment = {};
};

enum class LandSource {
  function,  ///< the terrain steps that are functions of the place
  map        ///< the finished land, packed
};

struct Landscape {
  std::string title;  ///< the scene's file, without folder
  LandscapeSettings settings;
  std::vector<LandscapeValue> values;
  std::string tables;                 ///< GLSL: light by the sun's height
  std::string land;                   ///< GLSL of `vec3 land(vec2 place, float spacing)`
  std::optional<LandMap> map;         ///< where the land is a map
  std::vector<std::string> left_out;  ///< steps that the land's function lacks
  std::string stand_in;               ///< what stands for them, "" for nothing
};

/// Land that is built already: what its steps made, and what lies on it.
struct FinishedLand {
  const Heightfield& field;
  const std::map<std::string, Grid<float>>& maps;
  const GroundDressing& dressing;
};

struct LandscapeOptions {
  LandSource source = LandSource::function;
  int map_size = 1025;                                  ///< samples on a side at most
  std::string camera = {};                              ///< one of the scene's; empty: the first
  std::optional<FinishedLand> finished = std::nullopt;  ///< used where the land is a map
};

/// Whether all steps that change the ground are functions of the place.
bool is_function(const Scene& scene);

/// Throws as `build_terrain` and `dress_ground`, where the land is a map or something stands in for
/// steps, as `wood_kinds`, and Error(usage) for an unknown camera.
Landscape landscape_of(const Scene& scene, const LandscapeOptions& options, Progress& progress);

/// GLSL: knobs, values, land and `mainImage(out vec4, in vec2)`, with #include. `uniforms` are
/// knobs that become uniforms.
std::string landscape_body(const Landscape& landscape,
                           const std::vector<std::string>& uniforms = {});

}  // namespace wold
