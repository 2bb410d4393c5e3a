#pragma once
// The picture while it is being traced: sums of samples per pixel, and their number.

#include <cstdint>
#include <string>

#include "base/grid.hpp"
#include "base/vec.hpp"
#include "image/image.hpp"

namespace wold {

/// Luminance that a picture stores as 1, cd/m² (in EXR files the attribute `wold.whiteLuminance`):
/// sunlit snow is near 3.
inline constexpr float white_luminance = 10000;

/// What one light path brings to its pixel.
struct PathSample {
  Vec3 radiance{0};  ///< cd/m²
  Vec3 albedo{0};    ///< of the first surface; of the sky, 0
  Vec3 normal{0};    ///< of the first surface, world; of the sky, 0
  float depth = 0;   ///< m along the path to the first surface; 0 for the sky
  float cover = 0;   ///< 1 on a surface, 0 in the sky
};

class Film {
 public:
  Film() = default;
  /// Row 0 at the top. Throws Error(limit) when it does not fit in memory.
  Film(int width, int height);

  int width() const { return pixels_.width(); }
  int height() const { return pixels_.height(); }

  /// Adds a sample; one that is not finite is counted as rejected and leaves the pixel as it was.
  void add(int x, int y, const PathSample& sample);

  std::uint32_t sample_count(int x, int y) const { return pixels_(x, y).count; }
  std::uint64_t total_samples() const;
  std::uint32_t least_samples() const;
  std::uint64_t rejected() const;

  /// Channels R G B A, albedo.R .G .B, normal.X .Y .Z, depth.Z (m, mean over what is not sky,
  /// infinity where all is sky) and samples; radiance divided by `white_luminance`. Pixels without
  /// samples are black.
  Image image() const;

 private:
  struct Pixel {
    DVec3 radiance{0};
    Vec3 albedo{0};
    Vec3 normal{0};
    float depth = 0;
    float cover = 0;
    std::uint32_t count = 0;
    std::uint32_t rejected = 0;
  };
  Grid<Pixel> pixels_;
};

}  // namespace wold
