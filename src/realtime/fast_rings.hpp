#pragma once
// Squares of texels about an eye, level over level, each with twice the cells of the one before:
// what has to be made anew when the eye moves, and textures that hold it.
//
// A texel stands for the place (i, j) · cell · 2^level and lies at (i, j) modulo the size of the
// texture, so what stays in the square stays where it is. A square is moved once the eye is more
// than `slack` texels off its middle (F. Losasso, H. Hoppe, "Geometry clipmaps: terrain rendering
// using nested regular grids", SIGGRAPH 2004).

#include <functional>
#include <vector>

#include "base/vec.hpp"
#include "gpu/objects.hpp"

namespace wold {

/// Texels from `low` to before `high`, counted from the place (0, 0).
struct RingStrip {
  int level = 0;
  IVec2 low{0};
  IVec2 high{0};
};

/// A rectangle of a texture, and the first of the texels that it stands for.
struct RingRect {
  IVec2 texel{0};
  IVec2 size{0};
};

class RingSquares {
 public:
  static constexpr int slack = 4;
  static constexpr int margin = 12;  ///< texels that shaders stay off the edge

  /// Levels that reach so far (m) from an eye anywhere in the slack.
  static int levels_over(int size, double cell, double reach);

  /// `size`: texels on a side, a power of two; `cell`: of level 0, m.
  RingSquares(int size, int levels, double cell);

  int size() const { return size_; }
  int levels() const { return static_cast<int>(corners_.size()); }
  double cell(int level) const;

  /// What the squares about this place (m) hold that they did not before.
  std::vector<RingStrip> move_to(DVec2 eye);
  /// All of one level, or of all: what is there holds no more.
  RingStrip whole(int level) const;
  void forget();

  /// Where a strip lies in a texture of this size, smaller by halvings. `grown` texels more
  /// towards lower indices: what reaches over the strip's lower edges.
  std::vector<RingRect> rects(const RingStrip& strip, int halvings = 0, int grown = 0) const;

 private:
  struct Corner {
    IVec2 low{0};
    bool known = false;
  };
  int size_;
  double cell_;
  std::vector<Corner> corners_;
};

/// Draws into rectangles of one layer and mipmap of an array of textures.
class RingTarget {
 public:
  RingTarget();
  void draw(const GpuTexture& texture, int layer, int level,
            const std::vector<RingRect>& rects) const;

 private:
  gl::Name<gl::TargetKind> id_;
};

}  // namespace wold
