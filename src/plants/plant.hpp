#pragma once
// A plant: a text file with a grammar, the settings of its turtle, its organs and its materials;
// and the models that grow from it.
//
//   const Plant birch = load_plant("plants/birch.lsys");
//   const TriangleMesh tree = grow(birch, {.seed = 7, .height = 12}, progress);
//
// The format is that of Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants (1990),
// as text; see plants/README.md for the whole of it.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/mesh.hpp"
#include "base/parameters.hpp"
#include "base/progress.hpp"
#include "plants/geometry.hpp"
#include "plants/lsystem.hpp"
#include "plants/organ.hpp"
#include "plants/turtle.hpp"

namespace wold {

/// How a material of a plant looks, as its file suggests; a scene may choose otherwise.
struct PlantMaterial {
  std::string name;  ///< as in `MeshPart::material`: "bark", "twig", "leaf", "needle", "petal"
  Vec3 reflectance{0.3F};    ///< diffuse albedo of the lit side, linear Rec. 709
  Vec3 transmittance{0.0F};  ///< diffuse albedo through to the other side
  float roughness = 0;       ///< of a dielectric coat, in (0, 1]; 0 for none
};

/// A species, as its file describes it.
struct Plant {
  std::string name;    ///< the file's name without folder and extension
  float height = 0;    ///< m, of a grown model; 0: as the turtle draws it
  int iterations = 0;  ///< derivation steps
  LSystem system;
  TurtleSettings turtle;
  GeometrySettings geometry;
  std::vector<Organ> organs;
  std::vector<PlantMaterial> materials;  ///< those the file describes

  /// The material of that name, or null.
  const PlantMaterial* find_material(std::string_view material) const;
};

/// What differs between two models of one species.
struct GrowSettings {
  std::uint64_t seed = 0;
  float height = 0;    ///< m; 0: the file's own
  int iterations = 0;  ///< 0: the file's own
  float detail = 1;    ///< below 1: fewer sides, segments and (larger) organs; above 1: rounder
  int max_modules = 8'000'000;  ///< a word longer than this is refused

  friend bool operator==(const GrowSettings&, const GrowSettings&) = default;
};

Description<GrowSettings> describe(const GrowSettings&);

/// Reads a plant from text; `file` is its name in messages. Throws Error(input) with file, line and
/// column, what was found and what was expected.
Plant parse_plant(std::string_view text, const std::string& file);

/// Reads a plant file. Throws Error(io) when it cannot be read, otherwise as `parse_plant`.
Plant load_plant(const std::string& path);

/// The word after all iterations. Throws Error(limit) when it would be too long and
/// Error(cancelled).
Word derive(const Plant& plant, const GrowSettings& settings, Progress& progress);

/// A model: Z up, metres, the foot of the stem at the origin; roots run a little below z = 0. The
/// highest point is exactly at `height`. Parts are sorted by material: bark, then leaves and other
/// organs. The same plant and settings give the same bits. Throws as `derive`.
TriangleMesh grow(const Plant& plant, const GrowSettings& settings, Progress& progress);

}  // namespace wold
