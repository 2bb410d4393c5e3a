#pragma once
// Lines in the world, a few pixels wide: paths of test rays.

#include <span>
#include <vector>

#include "gpu/objects.hpp"
#include "raster/draw_view.hpp"

namespace wold {

struct Line {
  Vec3 from{0};      ///< m
  Vec3 to{0};        ///< m
  Vec3 radiance{0};  ///< cd/m²
};

class LineDrawing {
 public:
  LineDrawing();

  void set(std::span<const Line> lines);
  /// Draws among the surfaces of the bound target.
  void draw(const DrawView& view) const;

 private:
  GpuProgram program_;
  GpuBuffer buffer_;
  GpuVertices vertices_;
  int count_ = 0;
};

}  // namespace wold
