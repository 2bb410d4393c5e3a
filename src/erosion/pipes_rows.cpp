#include "erosion/pipes_rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace wold::pipes_detail {

namespace {

constexpr float least_depth = 1e-6F;  // m: less does not flow
constexpr float headroom = 1.2F;      // what water may gain in speed until it is looked at again
constexpr float still_depth = 1e-4F;  // m: added to the depth that a speed is of

// By value, so that loops become vector code.
float lower(float a, float b) {
  return a < b ? a : b;
}
float higher(float a, float b) {
  return a > b ? a : b;
}

float metres(Grains grains) {
  return metres_per_grain * static_cast<float>(grains);
}

}  // namespace

void drive(const RowState& a, const RowState& b, const float* before, const float* across_a,
           const float* across_b, float* __restrict after, int n, const StepConstants& c) {
  const float* __restrict ground_a = a.ground;
  const float* __restrict ground_b = b.ground;
  const Grains* __restrict change_a = a.change;
  const Grains* __restrict change_b = b.change;
  const Grains* __restrict depth_a = a.depth;
  const Grains* __restrict depth_b = b.depth;
  for (int i = 0; i < n; ++i) {
    // Surfaces above the higher of the two beds: small numbers, exact however high the ground.
    const float drop = (ground_a[i] - ground_b[i]) + metres(change_a[i] - change_b[i]);
    const float level_a = metres(depth_a[i]) + lower(drop, 0.0F);
    const float level_b = metres(depth_b[i]) - higher(drop, 0.0F);
    const float depth = higher(higher(level_a, level_b), 0.0F);
    const float force = c.gravity_step * lower(depth, c.pipe_depth) * (level_a - level_b);
    const float squared = depth * depth;
    const float across =
        0.25F * ((across_a[i] + across_a[i + 1]) + (across_b[i] + across_b[i + 1]));
    const float whole = std::sqrt(before[i] * before[i] + across * across);
    const float flow =
        (before[i] + force) * squared / (squared + c.drag_step * whole + least_depth * least_depth);
    const float most = c.top_speed * depth;
    after[i] = lower(higher(flow, -most), most);
  }
}

namespace {

/// The faces that momentum comes to a row of faces from: the next ones before and behind the way
/// that they are crossed, and on their left and right.
struct MomentumRow {
  const float* discharge;  // m²/s
  const float* discharge_back;
  const float* discharge_ahead;
  const float* speed;  // m/s
  const float* speed_back;
  const float* speed_ahead;
  const float* speed_left;
  const float* speed_right;
  const float* across_left_a;  // m²/s sideways, from the left to the face: of cell a, of cell b
  const float* across_left_b;
  const float* across_right_a;  // from the face to the right
  const float* across_right_b;
};

// Inline, so that rows which are one and the same stay few pointers.
inline void drive_with_momentum(const RowState a, const RowState b, const MomentumRow m,
                                float* __restrict discharge, float* __restrict speed, int n,
                                const StepConstants& c) {
  const float half_step = 0.5F * c.speed_step;
  for (int i = 0; i < n; ++i) {
    const float drop = (a.ground[i] - b.ground[i]) + metres(a.change[i] - b.change[i]);
    const float depth_a = metres(a.depth[i]);
    const float depth_b = metres(b.depth[i]);
    const float level_a = depth_a + lower(drop, 0.0F);
    const float level_b = depth_b - higher(drop, 0.0F);
    const float depth = higher(higher(level_a, level_b), 0.0F);
    const float mean = 0.5F * (depth_a + depth_b);

    // Water that comes in from each side in a step, over the cell's length.
    const float back = higher(half_step * (m.discharge_back[i] + m.discharge[i]), 0.0F);
    const float ahead = -lower(half_step * (m.discharge[i] + m.discharge_ahead[i]), 0.0F);
    const float across_left = m.across_left_a[i] + m.across_left_b[i];
    const float across_right = m.across_right_a[i] + m.across_right_b[i];
    const float left = higher(half_step * across_left, 0.0F);
    const float right = -lower(half_step * across_right, 0.0F);
    const float u = m.speed[i];
    const float carried = (back * (m.speed_back[i] - u) + ahead * (m.speed_ahead[i] - u)) +
                          (left * (m.speed_left[i] - u) + right * (m.speed_right[i] - u));
    const float held = higher(mean, (back + ahead) + (left + right));

    const float force = c.gravity_step * lower(mean, c.pipe_depth) * (level_a - level_b);
    const float along = u * mean;
    const float across = 0.25F * (across_left + across_right);
    const float whole = std::sqrt(along * along + across * across);
    const float next = (u * held + carried + force) * depth /
                       (held * depth + c.drag_step * whole + least_depth * least_depth);
    const float most = c.top_speed;
    const float bounded = lower(higher(next, -most), most);
    speed[i] = bounded;
    discharge[i] = bounded * higher(bounded > 0 ? level_a : level_b, 0.0F);
  }
}

}  // namespace

void drive_x_with_momentum(const RowState& cells, const FaceState& faces, const float* speed_south,
                           const float* speed_north, const float* south, const float* north,
                           float* discharge, float* speed, int n, const StepConstants& c) {
  const float* q = faces.discharge;
  const float* u = faces.speed;
  drive_with_momentum({cells.ground - 1, cells.change - 1, cells.depth - 1}, cells,
                      {q, q - 1, q + 1, u, u - 1, u + 1, speed_south, speed_north, south - 1, south,
                       north - 1, north},
                      discharge, speed, n, c);
}

void drive_y_with_momentum(const RowState& below, const RowState& above, const FaceState& faces,
                           const FaceState& faces_below, const FaceState& faces_above,
                           const float* west_below, const float* west_above, float* discharge,
                           float* speed, int n, const StepConstants& c) {
  const float* u = faces.speed;
  drive_with_momentum(
      below, above,
      {faces.discharge, faces_below.discharge, faces_above.discharge, u, faces_below.speed,
       faces_above.speed, u - 1, u + 1, west_below, west_above, west_below + 1, west_above + 1},
      discharge, speed, n, c);
}

void limit(const Grains* depth, const Grains* sediment, const float* west, const float* south,
           const float* north, float* __restrict share, float* __restrict load, int n,
           const StepConstants& c) {
  constexpr float below_one = 0.999999F;  // rounding must not let more out than there is
  for (int i = 0; i < n; ++i) {
    const float out = higher(west[i + 1], 0.0F) - lower(west[i], 0.0F) + higher(north[i], 0.0F) -
                      lower(south[i], 0.0F);
    const auto held = static_cast<float>(depth[i]);
    share[i] = lower(1.0F, below_one * held / higher(out * c.grains_per_flux, 1e-20F));
    load[i] = static_cast<float>(sediment[i]) / higher(held, 1.0F);
  }
}

void pass(const float* driven, const float* share_a, const float* share_b, const float* load_a,
          const float* load_b, const FaceRow& out, int n, const StepConstants& c) {
  float* __restrict discharge = out.discharge;
  Grains* __restrict water = out.water;
  Grains* __restrict sediment = out.sediment;
  for (int i = 0; i < n; ++i) {
    const float of_a = share_a[i];
    const float of_b = share_b[i];
    const float carried_a = load_a[i];
    const float carried_b = load_b[i];
    const float q = driven[i] * (driven[i] > 0 ? of_a : of_b);
    const auto grains = static_cast<Grains>(q * c.grains_per_flux);
    discharge[i] = q;
    water[i] = grains;
    sediment[i] = static_cast<Grains>(static_cast<float>(grains) * (q > 0 ? carried_a : carried_b));
  }
}

void exchange(const ExchangeRow& r, Grains* __restrict new_depth, Grains* __restrict new_sediment,
              Grains* __restrict new_change, Grains* __restrict moved, int n,
              const StepConstants& c) {
  const Grains* depth_before = r.at.depth;
  const Grains* sediment_before = r.sediment;
  const float* west = r.west.discharge;
  const float* south = r.south.discharge;
  const float* north = r.north.discharge;
  const Grains* water_west = r.west.water;
  const Grains* water_south = r.south.water;
  const Grains* water_north = r.north.water;
  const Grains* sediment_west = r.west.sediment;
  const Grains* sediment_south = r.south.sediment;
  const Grains* sediment_north = r.north.sediment;
  const float* ground_below = r.below.ground;
  const float* ground = r.at.ground;
  const float* ground_above = r.above.ground;
  const Grains* change_below = r.below.change;
  const Grains* change = r.at.change;
  const Grains* change_above = r.above.change;
  const float* ease = r.ease;
  for (int i = 0; i < n; ++i) {
    const Grains depth =
        depth_before[i] + water_west[i] - water_west[i + 1] + water_south[i] - water_north[i];
    const Grains sediment = sediment_before[i] + sediment_west[i] - sediment_west[i + 1] +
                            sediment_south[i] - sediment_north[i];
    const float d = metres(depth);
    const float mean_depth = 0.5F * (d + metres(depth_before[i]));
    const float u = 0.5F * (west[i] + west[i + 1]);
    const float v = 0.5F * (south[i] + north[i]);
    const float flow = std::sqrt(u * u + v * v);
    const float speed = lower(flow / (mean_depth + still_depth), c.top_speed);

    const float here = ground[i];
    const Grains changed = change[i];
    const float to_west = (here - ground[i - 1]) + metres(changed - change[i - 1]);
    const float to_east = (here - ground[i + 1]) + metres(changed - change[i + 1]);
    const float to_south = (here - ground_below[i]) + metres(changed - change_below[i]);
    const float to_north = (here - ground_above[i]) + metres(changed - change_above[i]);
    const float slope_x = c.half_per_cell * (to_west - to_east);
    const float slope_y = c.half_per_cell * (to_south - to_north);
    const float squared = slope_x * slope_x + slope_y * slope_y;
    const float sine = higher(std::sqrt(squared / (1 + squared)), c.least_sine);
    const float most_drop = higher(higher(to_west, to_east), higher(to_south, to_north));

    const float capacity = c.capacity * sine * speed * lower(d, c.full_depth);
    const float lack = capacity - static_cast<float>(sediment);
    const float most = 0.25F * higher(most_drop * grains_per_metre + c.least_drop, 0.0F);
    const float taken = lower(lack * (c.dissolve * ease[i]), most);
    const float laid_down = lack * c.deposit;
    const auto grains = static_cast<Grains>(lack > 0 ? taken : laid_down);
    new_depth[i] = depth;
    new_sediment[i] = sediment + grains;
    new_change[i] = changed - grains;
    moved[i] += grains > 0 ? grains : 0;
  }
}

namespace {

constexpr float spread = 1.0F / 8;  // of the newest change, to each neighbour beside

/// Takes from `change` what slides from row a to the neighbours in row b, `far` cells apart.
void slide_apart(const SlideState& a, const SlideState& b, float far, const SlideConstants& c,
                 Grains* __restrict change, int n) {
  const float least = far * c.cell;
  const float weight = (far > 1 ? 0.5F : 1.0F) * grains_per_metre;
  const float old_too = c.only_new ? 0 : 1e9F;
  for (int i = 0; i < n; ++i) {
    const float rise = a.rise[i] - b.rise[i];
    const float steepened = metres(a.change[i] - b.change[i]);
    const float down = lower(higher(rise - least, 0) * a.tangent[i], higher(steepened, old_too));
    const float up = lower(higher(-rise - least, 0) * b.tangent[i], higher(-steepened, old_too));
    const float drop = (a.ground[i] - b.ground[i]) + steepened;
    const float evened = lower(a.stir[i] + b.stir[i], 0.14F) * drop;
    const float newest = metres((a.change[i] - a.at_last[i]) - (b.change[i] - b.at_last[i]));
    change[i] -= static_cast<Grains>(weight * (0.1F * (down - up) + evened + spread * newest));
  }
}

SlideState shifted(const SlideState& s, int by) {
  return {s.ground + by, s.change + by, s.rise + by, s.tangent + by, s.stir + by, s.at_last + by};
}

}  // namespace

std::int64_t slide(const SlideState& below, const SlideState& at, const SlideState& above,
                   Grains* new_change, int n, const SlideConstants& c) {
  constexpr float far = 1.41421356F;
  std::copy_n(at.change, n, new_change);
  slide_apart(at, below, 1, c, new_change, n);
  slide_apart(at, above, 1, c, new_change, n);
  for (const int side : {-1, 1}) {
    slide_apart(at, shifted(at, side), 1, c, new_change, n);
    slide_apart(at, shifted(below, side), far, c, new_change, n);
    slide_apart(at, shifted(above, side), far, c, new_change, n);
  }
  std::int64_t moved = 0;
  for (int i = 0; i < n; ++i) {
    const Grains lost = at.change[i] - new_change[i];
    moved += lost > 0 ? lost : 0;
  }
  return moved;
}

void sediment_discharge(const Grains* depth, const Grains* sediment, const float* west,
                        const float* south, const float* north, float* __restrict out, int n) {
  for (int i = 0; i < n; ++i) {
    const float u = 0.5F * (west[i] + west[i + 1]);
    const float v = 0.5F * (south[i] + north[i]);
    const float load = static_cast<float>(sediment[i]) / (static_cast<float>(depth[i]) + 1);
    out[i] = load * std::sqrt(u * u + v * v);
  }
}

float fastest(const Grains* depth, const float* west, const float* south, const float* north, int n,
              float pipe_depth) {
  std::int32_t most = 0;  // floats that are not negative compare as their bits
  for (int i = 0; i < n; ++i) {
    const float u = higher(std::abs(west[i]), std::abs(west[i + 1]));
    const float v = higher(std::abs(south[i]), std::abs(north[i]));
    const float wave = std::sqrt(gravity * lower(metres(depth[i]), pipe_depth));
    const auto bits = std::bit_cast<std::int32_t>(wave + headroom * std::sqrt(u * u + v * v));
    most = bits > most ? bits : most;
  }
  return std::bit_cast<float>(most);
}

float speed_of(float discharge_in, float discharge_out, Grains depth, float top_speed) {
  const float speed = 0.5F * (discharge_in + discharge_out) / (metres(depth) + still_depth);
  return lower(higher(speed, -top_speed), top_speed);
}

}  // namespace wold::pipes_detail
