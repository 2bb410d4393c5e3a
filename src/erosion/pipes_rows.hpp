#pragma once
// The steps of the pipe model over one row: plain loops that vectorise. Equations in pipes.hpp.
//
// Depth, sediment and change of the ground are counted in whole grains of 2^-21 m (0.5 µm) times
// the cell's area, as 32-bit integers: what one cell gives is exactly what the other takes, however
// deep the water and however high the ground. They reach 1024 m.

#include <cstdint>

namespace wold::pipes_detail {

using Grains = std::int32_t;
inline constexpr float gravity = 9.81F;  ///< m/s²
inline constexpr float metres_per_grain = 0x1p-21F;
inline constexpr float grains_per_metre = 0x1p21F;

/// Everything about a step that is the same for all cells.
struct StepConstants {
  float gravity_step = 0;     ///< g Δt / l, 1/s · m/m
  float drag_step = 0;        ///< c Δt, s
  float pipe_depth = 0;       ///< m
  float top_speed = 0;        ///< m/s
  float speed_step = 0;       ///< Δt / l, s/m
  float grains_per_flux = 0;  ///< Δt / l, in grains per m²/s
  float half_per_cell = 0;    ///< 1 / 2l, 1/m
  float capacity = 0;         ///< K_c / D, grains per (m²/s)
  float least_sine = 0;       ///< sin α_min
  float full_depth = 0;       ///< m
  float dissolve = 0;         ///< share of what is lacking that is taken up in a step
  float deposit = 0;          ///< share of what is too much that is laid down in a step
  float least_drop = 0;       ///< l · tan α_min, grains
};

/// The ground and the water of a row.
struct RowState {
  const float* ground;   ///< m, as it was at first
  const Grains* change;  ///< of the ground since
  const Grains* depth;
};

/// Unit discharge (m²/s) from `a` to `b`, before any limit by what is there; n faces.
/// Face i is crossed sideways by the mean of `across_a` and `across_b` at i and i + 1.
void drive(const RowState& a, const RowState& b, const float* before, const float* across_a,
           const float* across_b, float* after, int n, const StepConstants& c);

/// What flows through the faces of a row.
struct FaceState {
  const float* discharge;  ///< m²/s
  const float* speed;      ///< m/s
};
/// As `drive`, with the momentum that the water carries along: through the n western faces of the
/// row `cells`, between the western faces south and north of it; `south` and `north` are discharges
/// through the faces of its cells.
void drive_x_with_momentum(const RowState& cells, const FaceState& faces, const float* speed_south,
                           const float* speed_north, const float* south, const float* north,
                           float* discharge, float* speed, int n, const StepConstants& c);
/// Through the n faces between two rows; `west_below` and `west_above` are discharges through the
/// western faces of their cells.
void drive_y_with_momentum(const RowState& below, const RowState& above, const FaceState& faces,
                           const FaceState& faces_below, const FaceState& faces_above,
                           const float* west_below, const float* west_above, float* discharge,
                           float* speed, int n, const StepConstants& c);

/// Share of the outflow that the cell can give, and sediment per water, for n cells. `west` holds
/// n + 1 faces.
void limit(const Grains* depth, const Grains* sediment, const float* west, const float* south,
           const float* north, float* share, float* load, int n, const StepConstants& c);

/// What passes the faces between the cells `a` and `b`.
struct FaceRow {
  float* discharge;  ///< m²/s
  Grains* water;
  Grains* sediment;
};
void pass(const float* driven, const float* share_a, const float* share_b, const float* load_a,
          const float* load_b, const FaceRow& out, int n, const StepConstants& c);

/// Cells of a row and their neighbours while ground is taken up and laid down.
struct ExchangeRow {
  FaceRow west;   ///< n + 1 faces
  FaceRow south;  ///< n faces
  FaceRow north;
  RowState below;  ///< rows of cells; depth not used
  RowState at;
  RowState above;
  const Grains* sediment;
  const float* ease;  ///< factor of what can be taken up, 1 for soft ground
};
/// Adds to `moved` what was taken up.
void exchange(const ExchangeRow& r, Grains* new_depth, Grains* new_sediment, Grains* new_change,
              Grains* moved, int n, const StepConstants& c);

/// A row of ground that may slide. `rise` and `tangent` as in MaterialRow; `stir` is the part of a
/// difference of heights that running water evens out.
struct SlideState {
  const float* ground;
  const Grains* change;
  const float* rise;
  const float* tangent;
  const float* stir;
  const Grains* at_last;  ///< change when it slid last
};
struct SlideConstants {
  float cell = 0;        ///< m
  bool only_new = true;  ///< only what the change of the ground has steepened slides
};
/// Moves part of what rises faster than it may; gives what came down from this row's cells.
std::int64_t slide(const SlideState& below, const SlideState& at, const SlideState& above,
                   Grains* new_change, int n, const SlideConstants& c);

/// Discharge of sediment in each cell, m²/s: `west` holds n + 1 faces.
void sediment_discharge(const Grains* depth, const Grains* sediment, const float* west,
                        const float* south, const float* north, float* out, int n);

/// The fastest that anything moves in these cells, m/s: waves on water that runs, and a little
/// more. Speeds of faces in m/s, `west` of n + 1.
float fastest(const Grains* depth, const float* west, const float* south, const float* north, int n,
              float pipe_depth);

/// Mean velocity of a cell from the discharges of two opposite faces, m/s.
float speed_of(float discharge_in, float discharge_out, Grains depth, float top_speed);

}  // namespace wold::pipes_detail
