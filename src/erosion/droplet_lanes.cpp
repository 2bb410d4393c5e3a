#include "erosion/droplet_lanes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace wold {

namespace {

constexpr float no_wall = std::numeric_limits<float>::infinity();
constexpr float inside_by = 0x1p-10F;  // cells from the far walls

std::size_t index(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

DropletWalk::DropletWalk(const DropletWorld& world, const DropletRates& rates,
                         const DropletRegion& region, const std::vector<Drop>& drops,
                         DropletTally& tally)
    : lanes{}, world_(world), region_(region), drops_(drops), tally_(tally) {
  const bool walls = world.closed_border;
  step_.rates = &rates;
  step_.width = static_cast<float>(region.right - region.left - 1);
  step_.height = static_cast<float>(region.top - region.bottom - 1);
  step_.wall_left = walls && region.left == 0 ? 0 : -no_wall;
  step_.wall_bottom = walls && region.bottom == 0 ? 0 : -no_wall;
  step_.wall_right = walls && region.right == world.width ? step_.width - inside_by : no_wall;
  step_.wall_top = walls && region.top == world.height ? step_.height - inside_by : no_wall;
  step_.stride = world.stride;
  step_.first = region.bottom * world.stride + region.left;
  step_.hardness = world.softness != nullptr;
  step_.record = world.passes != nullptr;
  while (active_ < droplet_lanes && next_ < drops_.size())
    begin_lane(index(active_++), drops_[next_++]);
}

void DropletWalk::begin_lane(std::size_t lane, const Drop& drop) {
  const auto place = [](int cell, int first, float fraction, float end) {
    return std::min(static_cast<float>(cell - first) + fraction, end - inside_by);
  };
  lanes.x[lane] = place(drop.cell.x, region_.left, drop.fraction.x, step_.width);
  lanes.y[lane] = place(drop.cell.y, region_.bottom, drop.fraction.y, step_.height);
  lanes.at[lane] = step_.first + static_cast<std::int32_t>(lanes.y[lane]) * world_.stride +
                   static_cast<std::int32_t>(lanes.x[lane]);
  lanes.from[lane] = drop.at;
  lanes.from_x[lane] = drop.from.x;
  lanes.from_y[lane] = drop.from.y;
  lanes.dx[lane] = drop.direction.x;
  lanes.dy[lane] = drop.direction.y;
  lanes.v[lane] = drop.v;
  lanes.water[lane] = drop.water;
  lanes.left[lane] = drop.left;
  lanes.sediment[lane] = drop.sediment;
  lanes.height[lane] = drop.height;
  lanes.came_down[lane] = drop.came_down;
  lanes.color[lane] = drop.color;
  if (drop.left != step_.rates->steps) return;
  lanes.from[lane] = lanes.at[lane];
  lanes.from_x[lane] = lanes.x[lane] - std::floor(lanes.x[lane]);
  lanes.from_y[lane] = lanes.y[lane] - std::floor(lanes.y[lane]);
  lanes.height[lane] = height_at(lane);
  lanes.water[lane] = drop.water / std::max(step_.rates->water, 1e-30F);
  --tally_.steps;  // its first turn only looks around
}

std::int32_t DropletWalk::height_at(std::size_t lane) const {
  const DropletCell* low = world_.cells + lanes.from[lane];
  const DropletCell* high = low + world_.stride;
  const float fx = lanes.from_x[lane];
  const float fy = lanes.from_y[lane];
  const auto a = static_cast<float>(low[1].height - low[0].height);
  const auto b = static_cast<float>(high[1].height - high[0].height);
  const auto c = static_cast<float>(high[0].height - low[0].height);
  return low[0].height + static_cast<std::int32_t>(std::lrint(fx * (a + fy * (b - a)) + fy * c));
}

void DropletWalk::end_lanes(int first, std::uint32_t ended) {
  while (ended != 0) {
    const int bit = 31 - std::countl_zero(ended);  // from the last, which may fill those before
    ended ^= std::uint32_t{1} << static_cast<unsigned>(bit);
    const std::size_t lane = index(first + bit);
    end_lane(lane);
    if (next_ < drops_.size())
      begin_lane(lane, drops_[next_++]);
    else
      move_lane(lane, index(--active_));
  }
}

void DropletWalk::end_lane(std::size_t lane) {
  const float x = lanes.x[lane];
  const float y = lanes.y[lane];
  const bool inside = x >= 0 && x < step_.width && y >= 0 && y < step_.height;
  if (inside || lanes.left[lane] <= 0) {
    lay_down(lane);
    ++tally_.finished;
  } else {
    leave(lane);
  }
}

/// The rest stays where the drop ends.
void DropletWalk::lay_down(std::size_t lane) {
  const auto amount = static_cast<double>(lanes.sediment[lane]);
  const auto fx = static_cast<double>(lanes.from_x[lane]);
  const auto fy = static_cast<double>(lanes.from_y[lane]);
  const auto c10 = static_cast<std::int32_t>(amount * fx * (1 - fy));
  const auto c01 = static_cast<std::int32_t>(amount * (1 - fx) * fy);
  const auto c11 = static_cast<std::int32_t>(amount * fx * fy);
  const std::array<std::int32_t, 4> rest{lanes.sediment[lane] - c10 - c01 - c11, c10, c01, c11};
  DropletCell* low = world_.cells + lanes.from[lane];
  DropletCell* high = low + world_.stride;
  low[0].height += rest[0];
  low[1].height += rest[1];
  high[0].height += rest[2];
  high[1].height += rest[3];
  if (world_.colors != nullptr) carry_colors(lane, lanes.from[lane], rest);
}

/// Over the border of the ground, or into another tile.
void DropletWalk::leave(std::size_t lane) {
  const float x = std::floor(lanes.x[lane]);
  const float y = std::floor(lanes.y[lane]);
  const IVec2 cell{static_cast<int>(x) + region_.left, static_cast<int>(y) + region_.bottom};
  if (cell.x < 0 || cell.x >= world_.width - 1 || cell.y < 0 || cell.y >= world_.height - 1) {
    tally_.removed += lanes.sediment[lane];
    tally_.color_removed += static_cast<float>(lanes.sediment[lane]) * lanes.color[lane];
    ++tally_.finished;
    return;
  }
  tally_.leaving.push_back({.cell = cell,
                            .fraction = {lanes.x[lane] - x, lanes.y[lane] - y},
                            .from = {lanes.from_x[lane], lanes.from_y[lane]},
                            .at = lanes.from[lane],
                            .direction = {lanes.dx[lane], lanes.dy[lane]},
                            .v = lanes.v[lane],
                            .water = lanes.water[lane],
                            .left = lanes.left[lane],
                            .sediment = lanes.sediment[lane],
                            .height = lanes.height[lane],
                            .came_down = lanes.came_down[lane],
                            .color = lanes.color[lane]});
}

void DropletWalk::move_lane(std::size_t to, std::size_t from) {
  if (to == from) return;
  const auto move = [&](auto&... arrays) { ((arrays[to] = arrays[from]), ...); };
  move(lanes.x, lanes.y, lanes.from_x, lanes.from_y, lanes.dx, lanes.dy, lanes.v, lanes.water,
       lanes.left, lanes.sediment, lanes.height, lanes.came_down, lanes.at, lanes.from,
       lanes.color);
}

void DropletWalk::gather_softness(int first, int count, DropletCorners& corners) const {
  for (int k = 0; k < count; ++k) {
    const float* low = world_.softness + lanes.from[index(first + k)];
    const float* high = low + world_.stride;
    corners.soft00[index(k)] = low[0];
    corners.soft10[index(k)] = low[1];
    corners.soft01[index(k)] = high[0];
    corners.soft11[index(k)] = high[1];
  }
}

/// What is taken up has the skin's colour, and what lay beneath comes into the skin; what is laid
/// down mixes with the skin, whose lowest part is buried.
void DropletWalk::carry_colors(std::size_t lane, std::int32_t at,
                               const std::array<std::int32_t, 4>& change) {
  DropletColors& colors = *world_.colors;
  const Vec3 carried = lanes.color[lane];
  float taken = 0;
  Vec3 sum{0};
  const auto touch = [&](std::size_t sample, std::int32_t by) {
    Vec3& skin = colors.skin[sample];
    const auto amount = static_cast<float>(std::abs(by));
    if (by < 0) {
      const float of_skin = std::min(amount, colors.depth);
      taken += amount;
      sum += of_skin * skin + (amount - of_skin) * colors.beneath[sample];
      skin += of_skin / colors.depth * (colors.beneath[sample] - skin);
    } else if (by > 0) {
      skin += amount / (amount + colors.depth) * (carried - skin);
    }
  };
  const std::size_t low = index(at);
  const std::size_t high = low + index(world_.stride);
  touch(low, change[0]);
  touch(low + 1, change[1]);
  touch(high, change[2]);
  touch(high + 1, change[3]);
  if (taken <= 0) return;
  const float old = std::max(0.0F, static_cast<float>(lanes.sediment[lane]) - taken);
  lanes.color[lane] = (old * carried + sum) / (old + taken);
}

}  // namespace wold
