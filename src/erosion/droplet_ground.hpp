#pragma once
// The ground as drops see it: heights in integers, so that sums are exact in any order.

#include <cstdint>
#include <vector>

#include "erosion/droplet_walk.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

/// Heights base + quantum · integer. The quantum is a power of two, 2^-20 m or more, such that the
/// lowest and the highest ground lie 2^29 quanta apart or less: a quarter of what integers hold.
class DropletGround {
 public:
  explicit DropletGround(const Heightfield& input);

  double quantum() const { return quantum_; }
  std::int32_t quantised(float height) const;
  /// In rows `droplet_stride(width)` apart, as all arrays here and softness are.
  DropletCell* cells() { return cells_.data(); }

  /// Spreads what has changed since the last call as a brush of that radius would have: with a
  /// normal distribution as wide as a cone of radius r (variance 0.15 r² along each axis), less the
  /// width that bilinear weights have. What one sample gives is what others get, to the quantum.
  /// `softness`, if not null: erosion is spread to other samples only as far as they let it.
  void spread_changes(double radius_cells, const float* softness, Progress& progress);

  /// Lets banks slide that drops have cut: between two samples that lie `bank_slope` (rise over
  /// run) or more apart, and further than at first, a tenth of what is too much moves down; and
  /// loose sediment creep: of what was laid down since the beginning, a share `creep`, at most 0.1,
  /// of the difference moves down to each of eight neighbours.
  void settle(double bank_slope, double creep, double cell, const float* softness,
              Progress& progress);

  /// input + change, m. What rounding to float leaves is handed to the next sample that changed, at
  /// last to the one nearest to 0: in all no more is lost than half the last place of that.
  Grid<float> eroded(const Heightfield& input, Progress& progress) const;
  /// Taken up, m, spread as the changes were.
  Grid<float> wear(double radius_cells, const float* softness, Progress& progress) const;
  /// Taken up in all, m · cells.
  double total_wear() const;

 private:
  std::ptrdiff_t row_at(int j) const { return static_cast<std::ptrdiff_t>(j) * stride_; }

  int width_ = 0;
  int height_ = 0;
  int stride_ = 0;
  double base_ = 0;
  double quantum_ = 1;
  std::vector<DropletCell> cells_;
  std::vector<std::int32_t> initial_;
  std::vector<std::int32_t> before_;  ///< heights at the last spreading
  std::vector<std::int32_t> spread_;  ///< changes, spread along rows
};

}  // namespace wold
