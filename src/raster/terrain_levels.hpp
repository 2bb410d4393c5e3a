#pragma once
// Which squares of the ground are drawn for a view, and how fine: continuous distance-dependent
// level of detail (Strugar, "Continuous Distance-Dependent Level of Detail for Rendering
// Heightmaps", 2010).
//
// A quadtree lies over the ground's square. All tiles are the same grid of c × c cells, so a tile
// of depth j has cells of s_j = root / (2^j c) metres. With
//
//   k = 1 / (pixels_per_vertex · pixel_angle)      distance at which a metre of spacing is enough
//   d = max(|place - eye|, D)                      distance of a place; horizontal
//
// where D is the distance from the eye to the nearest ground, a tile of depth j serves for
// k s_j <= d < 2 k s_j; it is split where part of it is nearer than k s_j. Towards the far end of
// its range its odd vertices slide onto the even ones, which are those of the next coarser level:
//
//   m = clamp((d / (2 k s_j) - a) / (1 - a), 0, 1)
//
// A tile that was split since part of it lies within k s_j reaches no further than
// k s_j + √2 · 2 c s_{j+1}; that must lie before the coarser level begins to morph at 2 a k s_j, so
// a >= 1/2 + √2 c / (2 k). As d depends on the place in the plane alone, this holds however steep
// the land is, and vertices on shared edges agree: no cracks, no T-junctions, no popping.
//
// Vertices are counted on one integer lattice (less than 2^24 points on a side, exact in float),
// relative to a point near the eye, so that both sides of an edge get the same bits.

#include <cstdint>
#include <vector>

#include "base/parameters.hpp"
#include "raster/draw_view.hpp"
#include "render/ground.hpp"

namespace wold {

/// How finely the ground is drawn.
struct TerrainDetail {
  float pixels_per_vertex = 6;  ///< between vertices that are seen at right angles
  float least_spacing = 0.02F;  ///< m
  int most_tiles = 6000;        ///< in view; the spacing grows until they suffice
};

Description<TerrainDetail> describe(const TerrainDetail&);

/// A square of the ground, in steps of the lattice from TerrainChoice::anchor.
struct TerrainTile {
  float x = 0;  ///< south-west corner
  float y = 0;
  float step = 1;  ///< between vertices
};

/// What to draw for one view.
struct TerrainChoice {
  std::vector<TerrainTile> tiles;  ///< about from near to far
  int cells = 16;                  ///< on a tile's side
  DVec2 anchor{0};                 ///< m, a lattice point near the eye
  double unit = 1;                 ///< m, of the lattice
  Vec2 eye{0};                     ///< m from the anchor
  float nearest = 0;               ///< D, m
  float reach = 1;                 ///< k
  float morph_start = 0.7F;        ///< a
  float coarsest = 1;              ///< step of the root, which never morphs

  /// d, m, of a place relative to the anchor.
  float distance(Vec2 place) const;
  /// Place of a tile's vertex (i, j), m from the anchor: the twin of terrain_vertex in
  /// "raster/terrain_levels.glsl".
  Vec2 vertex(const TerrainTile& tile, int i, int j) const;
};

/// The quadtree of a ground, with the bounds of its heights.
class TerrainLevels {
 public:
  explicit TerrainLevels(const Ground& ground);

  /// The tiles that a view may see. The view's `eye` and `pixel_angle` set the detail, its planes
  /// what is left out.
  TerrainChoice choose(const DrawView& view, const TerrainDetail& detail) const;
  /// Bounds of the drawn heights over a square, m.
  Range heights(DVec2 low, double size) const;

 private:
  struct Bounds {
    float low = 0;
    float high = 0;
  };
  class Walk;

  void add_samples(const Heightfield& heights, const Heightfield& water, Range lift,
                   std::vector<Bounds>& leaves) const;
  float nearest_ground(Vec3 eye) const;
  const Bounds& bounds(int depth, int x, int y) const;

  Ground const* ground_;
  DVec2 low_{0};
  DVec2 high_{0};
  double root_ = 1;                          // m
  int leaf_depth_ = 0;                       // of the finest bounds
  std::vector<std::vector<Bounds>> levels_;  // by depth
};

}  // namespace wold
