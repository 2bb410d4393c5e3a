#pragma once
// Height maps as game engines take them: sizes that they accept, byte order, row order, and the
// numbers that their import dialogs ask for.
//
//   unreal   .png or .r16; sizes that fill components (127, 253, 505, 1009, 2017, 4033, 8129).
//            An integer v stands Z scale · (v - 32768) / 128 cm above the landscape's place, so
//            Z scale = 100 · (high - low) · 128 / 65535 with heights in metres.
//   unity    .raw; 2^n + 1 samples, square; little endian, first row in the south.
//   godot    .exr (metres) or .r16; 2^n + 1 samples, as the terrain add-ons want.

#include <span>

#include "terrain/export.hpp"

namespace wold {

struct EnginePreset {
  std::string name;
  std::string text;                     ///< one sentence
  std::vector<int> sizes;               ///< samples along a side that the engine accepts
  std::vector<std::string> extensions;  ///< the first is the default
  bool square = false;
};

std::vector<EnginePreset> engine_presets();

/// Throws Error(usage) with the nearest name.
EnginePreset find_engine(std::string_view name);

/// The accepted size nearest to the wanted one: what to evaluate the terrain at.
int engine_size(const EnginePreset& preset, int wanted);

/// To be called before long work. Throws Error(usage) for an extension or a size that the engine
/// does not take; the message says which it does.
void check_engine_export(const EnginePreset& preset, const std::string& path, int width,
                         int height);

/// Writes the file and reports what to type into the engine's dialog. Throws as
/// `check_engine_export` and `export_heightfield`.
ExportReport export_for_engine(const Heightfield& field, const std::string& path,
                               const EnginePreset& preset);

}  // namespace wold
