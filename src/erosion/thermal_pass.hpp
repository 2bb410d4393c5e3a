#pragma once
// One pass of sliding over a rectangle of cells (thermal_slide.hpp has the scheme).

#include <cstdint>
#include <vector>

#include "base/grid.hpp"

namespace wold {

/// Squares of differences of height between neighbours, in units²: beyond `rest` material slides
/// as if towards `flow`.
struct SlideYield {
  float rest = 0;
  float flow = 0;
};
/// Such a square for an angle, degrees; nothing exceeds that of 90 degrees. `cell` in units.
float slide_step(double angle, double cell);

/// What a pass needs to know. All grids have a frame of `slide_frame` samples.
struct SlidePass {
  int width = 0;  ///< without the frame
  int height = 0;
  bool diagonal = false;
  float rate = 0.2F;
  std::int32_t least = 0;  ///< units: a pass that moves nothing deeper says that nothing moved
  SlideYield loose;
  SlideYield rock;
  GridView<const float> rest_map;  ///< if not empty: instead of those of `rock`, or of `loose`
  GridView<const float> flow_map;  ///< where there is no bed
};

inline constexpr int slide_frame = 4;

/// Cells i0 <= i < i1, j0 <= j < j1.
struct SlideTile {
  int i0 = 0;
  int j0 = 0;
  int i1 = 0;
  int j1 = 0;
};

/// Working memory of one task.
struct SlideScratch {
  std::vector<float> floats;
  std::vector<std::int32_t> ints;
};

using SlideHeights = GridView<const std::int32_t>;

/// Moves what is too steep; everything is loose. True if anything moved.
bool slide_tile(const SlidePass& pass, const SlideTile& tile, SlideHeights from,
                GridView<std::int32_t> to, SlideScratch& scratch);

/// The same for loose material over a bed, and the bed where it is too steep itself.
bool slide_layers_tile(const SlidePass& pass, const SlideTile& tile, SlideHeights from,
                       SlideHeights bed, GridView<std::int32_t> to, GridView<std::int32_t> bed_to,
                       SlideScratch& scratch);

/// Transfers through the faces that belong to the cells of a row: of a pass among four neighbours
/// to the east and to the north; of a diagonal one from south-west to north-east and from
/// south-east to north-west in the square north-east of the cell. Positive: from the first of the
/// two ends, those named here.
struct SlideFaces {
  std::int32_t* first = nullptr;
  std::int32_t* second = nullptr;
};

/// Transfers of row `j`, columns [a, b), from `out.first[0]` on, as the slopes alone would have
/// them: of the loose, and (if `of_rock` is not null) of the rock. Faces that leave the ground have
/// 0.
void slide_faces(const SlidePass& pass, SlideHeights from, int j, int a, int b,
                 const SlideFaces& of_loose, const SlideFaces* of_rock, float* work);
/// Floats of `work` for that.
inline std::size_t slide_faces_work(int columns) {
  return 3 * static_cast<std::size_t>(columns);
}

}  // namespace wold
