#pragma once
// The maps of a land as textures, for landscape/height_map.glsl and its companions.

#include "gpu/objects.hpp"
#include "realtime/land_map.hpp"

namespace wold {

class LandTextures {
 public:
  static constexpr int units = 4;  ///< texture units that `bind` takes

  LandTextures() = default;
  /// Heights and levels in 32 bits, all with mipmaps.
  explicit LandTextures(const LandMap& map);

  /// To units from `first` on; nothing for what the land lacks.
  void bind(const GpuProgram& program, int first) const;

 private:
  GpuTexture heights_;
  GpuTexture water_;
  GpuTexture covers_;
  GpuTexture trees_;
};

}  // namespace wold
