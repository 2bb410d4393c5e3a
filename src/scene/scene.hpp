#pragma once
// A scene as data, and its reading from TOML.
//
// Every section is a described struct (base/parameters.hpp); `scene_sections` lists them once, and
// reading, checking, help, the reference pages and the JSON Schema follow from that list. What a
// file leaves out has defaults: without any [[terrain.step]] the land is wooded hills, and if the
// file plants nothing itself, a mixed forest grows on them.

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/parameters.hpp"
#include "forest/grid_spawner.hpp"
#include "forest/scatter.hpp"
#include "forest/species.hpp"
#include "image/tonemap.hpp"
#include "render/auto_camera.hpp"
#include "render/cover.hpp"
#include "render/ground.hpp"
#include "render/material.hpp"
#include "render/render.hpp"
#include "render/water.hpp"
#include "sky/sky.hpp"
#include "terrain/steps.hpp"

namespace wold {

/// What stands at the top of a scene file, before any section.
struct SceneHeader {
  int wold = 1;  ///< version of the format
  std::uint64_t seed = 42;
};
Description<SceneHeader> describe(const SceneHeader&);

/// The land around the terrain, seen in the distance.
struct Surroundings {
  float factor = 4;      ///< of the terrain's size; 1 for none
  int resolution = 513;  ///< samples on a side
};
Description<Surroundings> describe(const Surroundings&);

struct Scene {
  std::string source;            ///< the file, for messages
  std::filesystem::path folder;  ///< paths in the file are relative to it
  SceneHeader header;
  TerrainSettings terrain;
  std::vector<TerrainStep> steps;
  Surroundings surroundings;
  GroundMaterial ground;
  std::vector<GroundCover> covers;
  WaterSettings water;
  std::vector<Material> materials;
  std::vector<SpeciesSettings> species;
  std::vector<ScatterSettings> scatter;
  std::vector<GridSpawner> grids;
  SkySettings sky;
  std::vector<CameraSettings> cameras;  ///< at least one
  RenderSettings render;
  ToneMapping picture;
  /// Where sections and values stand in the file: "sky", "render.size", "species.0.plant".
  std::map<std::string, SourceLocation> locations;

  /// Where a value stands, or else its section, or else the file.
  SourceLocation location(const std::string& path) const;
  /// The camera of that name, or the first for an empty name. Throws Error(usage) with the nearest
  /// name.
  const CameraSettings& camera(const std::string& name) const;
};

/// A section as the reader, the help and the schema see it.
struct SceneSection {
  std::string path;       ///< "terrain", "species"
  bool repeated = false;  ///< an array of tables, [[species]]
  Described defaults;
};
/// All sections but the terrain's steps, whose parameters belong to their operators.
std::vector<SceneSection> scene_sections();

/// Every operator that a terrain step may name.
OperatorList scene_operators();

/// `overrides` are "path=value", applied in order. Throws Error(input) with file, line and column;
/// Error(usage) for overrides that name nothing.
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});
Scene parse_scene(const std::string& text, const std::string& source,
                  const std::filesystem::path& folder, std::span<const std::string> overrides = {});

/// A file that a scene names: in its folder, else in the folder above, else in the current one,
/// else among the files that come with wold. Throws Error(io).
std::filesystem::path find_scene_file(const std::string& path, const std::filesystem::path& folder);

/// JSON Schema (draft 2020-12) of scene files, for completion in editors.
std::string scene_schema();

}  // namespace wold
