#include "raster/terrain_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace wold {

namespace {

// The finest bounds of heights: so many squares on a side.
constexpr int finest_bounds = 512;
// Catmull-Rom interpolation leaves the range of its 4 × 4 samples by at most so much of it: the
// absolute weights sum to 1.25 along each axis.
constexpr float overshoot = 0.5F * (1.25F * 1.25F - 1);
// What detail and tree crowns (render/ground.cpp) add to the land at most, m.
constexpr float most_detail = 1.5F;
constexpr float most_canopy = 11;
constexpr double anchor_distance = 256;             // m, between places of the anchor
constexpr double lattice_points = double{1 << 22};  // on a side at most
constexpr float least_reach = 20;
constexpr float cells_per_reach = 0.4F;

double distance_to_square(DVec2 place, DVec2 low, double size) {
  return glm::distance(place, glm::clamp(place, low, low + DVec2(size)));
}

}  // namespace

Description<TerrainDetail> describe(const TerrainDetail&) {
  using T = TerrainDetail;
  return Description<T>("terrain_detail", "How finely the ground is drawn.")
      .add("pixels_per_vertex", &T::pixels_per_vertex, {.min = 0.5, .max = 100},
           "Pixels between the vertices of ground seen at right angles.")
      .add("least_spacing", &T::least_spacing, {.unit = "m", .min = 0.001, .max = 1000},
           "Vertices stand no closer.")
      .add("most_tiles", &T::most_tiles, {.min = 64, .max = 1000000},
           "Tiles in view at most; the vertices stand further apart until they suffice.");
}

float TerrainChoice::distance(Vec2 place) const {
  return std::max(glm::distance(place, eye), nearest);
}

Vec2 TerrainChoice::vertex(const TerrainTile& tile, int i, int j) const {
  const auto metre = static_cast<float>(unit);
  const Vec2 at(static_cast<float>(i), static_cast<float>(j));
  const Vec2 corner(tile.x, tile.y);
  if (tile.step >= coarsest) return (corner + tile.step * at) * metre;
  const float end = 2 * reach * tile.step * metre;
  const float d = distance((corner + tile.step * at) * metre) / end;
  const float m = std::clamp((d - morph_start) / (1 - morph_start), 0.0F, 1.0F);
  const Vec2 odd(static_cast<float>(i % 2), static_cast<float>(j % 2));
  return (corner + tile.step * (at - m * odd)) * metre;
}

TerrainLevels::TerrainLevels(const Ground& ground)
    : ground_(&ground), low_(ground.low()), high_(ground.high()) {
  root_ = std::max(high_.x - low_.x, high_.y - low_.y);
  int side = 1;
  while (side < finest_bounds) {
    side *= 2;
    ++leaf_depth_;
  }
  constexpr float most = std::numeric_limits<float>::max();
  std::vector<Bounds> leaves(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
                             {most, -most});
  const GroundDressing& dressing = ground.dressing();
  Range lift{0, 0};
  if (!ground.surroundings().height.empty()) {
    const DVec2 corner = ground.field().origin;
    const DVec2 size = ground.field().size();
    const int samples = std::max(ground.field().height.width(), ground.field().height.height());
    for (int k = 0; k <= samples; ++k) {
      const double t = static_cast<double>(k) / samples;
      for (const DVec2 at : {DVec2(t, 0), DVec2(t, 1), DVec2(0, t), DVec2(1, t)}) {
        const DVec2 place = corner + at * size;
        const float step = ground_at(ground.field(), place).height -
                           ground_at(ground.surroundings(), place).height;
        lift = {std::min(lift.low, step), std::max(lift.high, step)};
      }
    }
    add_samples(ground.surroundings(), dressing.outer_water.levels(), lift, leaves);
  }
  add_samples(ground.field(), dressing.inner_water.levels(), {0, 0}, leaves);
  const float detail = most_detail * ground.material().detail;
  const float canopy = ground.material().distant_forest > 0 ? most_canopy : 0;
  for (Bounds& b : leaves) b = {b.low - detail, b.high + std::max(detail, canopy)};
  levels_.resize(static_cast<std::size_t>(leaf_depth_) + 1);
  levels_.back() = std::move(leaves);
  for (int depth = leaf_depth_ - 1; depth >= 0; --depth) {
    const int n = 1 << depth;
    std::vector<Bounds>& level = levels_[static_cast<std::size_t>(depth)];
    level.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        Bounds b{most, -most};
        for (const IVec2 c : {IVec2(0, 0), IVec2(1, 0), IVec2(0, 1), IVec2(1, 1)}) {
          const Bounds& child = bounds(depth + 1, 2 * x + c.x, 2 * y + c.y);
          b = {std::min(b.low, child.low), std::max(b.high, child.high)};
        }
        level[static_cast<std::size_t>(y) * static_cast<std::size_t>(n) +
              static_cast<std::size_t>(x)] = b;
      }
  }
}

void TerrainLevels::add_samples(const Heightfield& heights, const Heightfield& water, Range lift,
                                std::vector<Bounds>& leaves) const {
  const int side = 1 << leaf_depth_;
  const double leaf = root_ / side;
  const Grid<float>& grid = heights.height;
  const Heightfield& field = ground_->field();
  const DVec2 end = heights.origin + heights.size();
  const auto first = [&](double low, double begin) {
    return static_cast<int>(std::floor((low - begin) / heights.cell)) - 1;
  };
  parallel_for(0, side, [&](int y) {
    const double south = low_.y + leaf * y;
    if (south > end.y || south + leaf < heights.origin.y) return;
    const int j0 = first(south, heights.origin.y);
    const int j1 = first(south + leaf, heights.origin.y) + 3;
    for (int x = 0; x < side; ++x) {
      const double west = low_.x + leaf * x;
      if (west > end.x || west + leaf < heights.origin.x) continue;
      // The surroundings are not seen where the field lies.
      if (&heights != &field && field.contains({west, south}) &&
          field.contains({west + leaf, south + leaf}))
        continue;
      const int i0 = first(west, heights.origin.x);
      const int i1 = first(west + leaf, heights.origin.x) + 3;
      float low = std::numeric_limits<float>::max();
      float high = -low;
      float wet = high;
      for (int j = std::max(0, j0); j <= std::min(j1, grid.height() - 1); ++j)
        for (int i = std::max(0, i0); i <= std::min(i1, grid.width() - 1); ++i) {
          low = std::min(low, grid(i, j));
          high = std::max(high, grid(i, j));
          if (!water.height.empty()) wet = std::max(wet, water.height(i, j));
        }
      if (low > high) continue;
      const float margin = overshoot * (high - low);
      Bounds& b = leaves[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                         static_cast<std::size_t>(x)];
      b.low = std::min(b.low, low - margin + lift.low);
      b.high = std::max({b.high, high + margin + lift.high, wet + lift.high});
    }
  });
}

const TerrainLevels::Bounds& TerrainLevels::bounds(int depth, int x, int y) const {
  if (depth > leaf_depth_) {
    x >>= depth - leaf_depth_;
    y >>= depth - leaf_depth_;
    depth = leaf_depth_;
  }
  const std::vector<Bounds>& level = levels_[static_cast<std::size_t>(depth)];
  return level[static_cast<std::size_t>(y) * (std::size_t{1} << static_cast<unsigned>(depth)) +
               static_cast<std::size_t>(x)];
}

Range TerrainLevels::heights(DVec2 low, double size) const {
  const int side = 1 << leaf_depth_;
  const DVec2 first = (low - low_) * (side / root_);
  const DVec2 last = (low + DVec2(size) - low_) * (side / root_);
  Range range{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  const auto clamped = [side](double v) {
    return std::clamp(static_cast<int>(std::floor(v)), 0, side - 1);
  };
  for (int y = clamped(first.y); y <= clamped(last.y); ++y)
    for (int x = clamped(first.x); x <= clamped(last.x); ++x) {
      const Bounds& b = bounds(leaf_depth_, x, y);
      range = {std::min(range.low, b.low), std::max(range.high, b.high)};
    }
  return range;
}

/// Distance to about the nearest of some places around; it changes continuously with the eye.
float TerrainLevels::nearest_ground(Vec3 eye) const {
  const DVec2 below(eye.x, eye.y);
  const auto distance = [&](DVec2 place) {
    const DVec2 p = glm::clamp(place, low_, high_);
    return glm::distance(Vec3(Vec2(p - below), ground_->base(p).height), Vec3(0, 0, eye.z));
  };
  const DVec2 inside = glm::clamp(below, low_, high_);
  if (eye.z <= ground_->base(inside).height) return 0;
  float least = distance(below);
  const auto far = static_cast<double>(least);
  constexpr int directions = 8;
  for (const double part : {0.06, 0.12, 0.25, 0.5, 0.75, 1.0})
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * pi_d * (k + part) / directions;
      least =
          std::min(least, distance(below + part * far * DVec2(std::cos(angle), std::sin(angle))));
    }
  return least;
}

/// One descent through the quadtree.
class TerrainLevels::Walk {
 public:
  Walk(const TerrainLevels& levels, const DrawView& view, TerrainChoice& choice, int deepest,
       std::size_t most)
      : levels_(levels), view_(view), choice_(choice), deepest_(deepest), most_(most) {
    eye_ = DVec2(view.eye.x, view.eye.y);
    anchor_ = glm::round((choice.anchor - levels.low_) / choice.unit);
  }

  /// False where there are too many tiles.
  bool visit(int depth, int x, int y) {
    const double size = levels_.root_ / (1 << depth);
    const DVec2 low = levels_.low_ + size * DVec2(x, y);
    if (low.x >= levels_.high_.x || low.y >= levels_.high_.y) return true;
    const Bounds& b = levels_.bounds(depth, x, y);
    const DVec2 high = glm::min(low + DVec2(size), levels_.high_);
    if (b.low > b.high || !view_.sees(Vec3(Vec2(low), b.low), Vec3(Vec2(high), b.high)))
      return true;
    const double spacing = size / choice_.cells;
    const double d =
        std::max(distance_to_square(eye_, low, size), static_cast<double>(choice_.nearest));
    if (depth == deepest_ || d >= static_cast<double>(choice_.reach) * spacing)
      return add(depth, x, y);
    // From near to far.
    const int right = eye_.x > low.x + size / 2 ? 1 : 0;
    const int upper = eye_.y > low.y + size / 2 ? 1 : 0;
    for (const IVec2 c : {IVec2(0, 0), IVec2(1, 0), IVec2(0, 1), IVec2(1, 1)})
      if (!visit(depth + 1, 2 * x + (c.x ^ right), 2 * y + (c.y ^ upper))) return false;
    return true;
  }

 private:
  bool add(int depth, int x, int y) {
    if (choice_.tiles.size() >= most_) return false;
    const double step = std::ldexp(1.0, deepest_ - depth);
    const DVec2 corner = DVec2(x, y) * (step * choice_.cells) - anchor_;
    choice_.tiles.push_back(
        {static_cast<float>(corner.x), static_cast<float>(corner.y), static_cast<float>(step)});
    return true;
  }

  const TerrainLevels& levels_;
  const DrawView& view_;
  TerrainChoice& choice_;
  int deepest_;
  std::size_t most_;
  DVec2 eye_{0};
  DVec2 anchor_{0};
};

TerrainChoice TerrainLevels::choose(const DrawView& view, const TerrainDetail& detail) const {
  TerrainChoice choice;
  choice.nearest = nearest_ground(view.eye);
  for (float pixels = detail.pixels_per_vertex;; pixels *= 1.2F) {
    choice.tiles.clear();
    choice.reach = std::max(least_reach, 1 / (pixels * view.pixel_angle));
    choice.cells = choice.reach * cells_per_reach < 16   ? 8
                   : choice.reach * cells_per_reach < 32 ? 16
                                                         : 32;
    choice.morph_start = 0.5F + 0.75F * static_cast<float>(choice.cells) / choice.reach;
    int deepest = 0;
    choice.unit = root_ / choice.cells;
    while (choice.unit > static_cast<double>(detail.least_spacing) &&
           root_ / choice.unit < lattice_points) {
      choice.unit /= 2;
      ++deepest;
    }
    choice.coarsest = std::ldexp(1.0F, deepest);
    const double snap =
        choice.unit *
        std::exp2(std::max(0.0, std::round(std::log2(anchor_distance / choice.unit))));
    const DVec2 inside = glm::clamp(DVec2(view.eye.x, view.eye.y), low_, high_);
    choice.anchor = low_ + snap * glm::round((inside - low_) / snap);
    choice.eye = Vec2(DVec2(view.eye.x, view.eye.y) - choice.anchor);
    const auto most = static_cast<std::size_t>(detail.most_tiles);
    const bool coarse = choice.reach <= least_reach;
    Walk walk(*this, view, choice, deepest, coarse ? std::size_t{1} << 24U : most);
    if (walk.visit(0, 0, 0)) return choice;
  }
}

}  // namespace wold
