#include "erosion/droplet_ground.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "terrain/analysis.hpp"

namespace wold {

namespace {

constexpr int rows_of_task = 16;

/// Weights of the samples at distance 1, 2, … of a discrete bell of this variance, cells².
std::vector<float> bell(double variance) {
  if (variance < 0.02) return {};
  if (variance <= 0.5) return {static_cast<float>(0.5 * variance)};
  std::vector<double> weights;
  double sum = 1;
  const int reach = static_cast<int>(std::ceil(3 * std::sqrt(variance)));
  for (int k = 1; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * k * k / variance));
    sum += 2 * weights.back();
  }
  std::vector<float> kernel;
  for (const double w : weights) kernel.push_back(static_cast<float>(w / sum));
  return kernel;
}

std::vector<float> brush(double radius_cells) {
  return bell(0.15 * radius_cells * radius_cells - 1.0 / 6);
}

/// What one sample gives to another.
inline std::int32_t given(std::int32_t change, float weight, float receiver) {
  const float part = static_cast<float>(change) * weight;
  return static_cast<std::int32_t>(change < 0 ? part * receiver : part);
}

/// Adds to a what it gets from b less what it gives. Softness may be null.
void receive(const std::int32_t* a, const std::int32_t* b, std::int32_t* to_a, int count,
             float weight, const float* soft_a, const float* soft_b) {
  if (soft_a == nullptr) {
    for (int i = 0; i < count; ++i)
      to_a[i] += static_cast<std::int32_t>(static_cast<float>(b[i]) * weight) -
                 static_cast<std::int32_t>(static_cast<float>(a[i]) * weight);
    return;
  }
  for (int i = 0; i < count; ++i)
    to_a[i] += given(b[i], weight, soft_a[i]) - given(a[i], weight, soft_b[i]);
}

void spread_row(const std::int32_t* in, std::int32_t* out, int width,
                const std::vector<float>& kernel, const float* softness) {
  std::copy_n(in, width, out);
  for (int k = 1; k <= static_cast<int>(kernel.size()) && k < width; ++k) {
    const float weight = kernel[static_cast<std::size_t>(k - 1)];
    const float* soft = softness;
    receive(in, in + k, out, width - k, weight, soft, soft == nullptr ? nullptr : soft + k);
    receive(in + k, in, out + k, width - k, weight, soft == nullptr ? nullptr : soft + k, soft);
  }
}

/// Row j of `in` spread along columns.
void spread_column(const std::vector<std::int32_t>& in, int j, int width, int height,
                   const std::vector<float>& kernel, const float* softness,
                   std::vector<std::int32_t>& out) {
  const auto offset = [width](int row) { return static_cast<std::ptrdiff_t>(row) * width; };
  const std::int32_t* here = in.data() + offset(j);
  std::copy_n(here, width, out.data());
  for (int k = 1; k <= static_cast<int>(kernel.size()); ++k) {
    for (const int row : {j - k, j + k}) {
      if (row < 0 || row >= height) continue;
      receive(here, in.data() + offset(row), out.data(), width,
              kernel[static_cast<std::size_t>(k - 1)],
              softness == nullptr ? nullptr : softness + offset(j),
              softness == nullptr ? nullptr : softness + offset(row));
    }
  }
}

/// Calls `use(j, row)` with each row of the changes `change(j, i)`, spread.
template <class Change, class Use>
void spread(int width, int height, const std::vector<float>& kernel, const float* softness,
            std::vector<std::int32_t>& along_rows, const Progress& progress, const Change& change,
            const Use& use) {
  const auto offset = [width](int j) { return static_cast<std::ptrdiff_t>(j) * width; };
  parallel_for(
      0, height,
      [&](int j) {
        std::vector<std::int32_t> in(static_cast<std::size_t>(width));
        change(j, in.data());
        spread_row(in.data(), along_rows.data() + offset(j), width, kernel,
                   softness == nullptr ? nullptr : softness + offset(j));
        progress.check();
      },
      rows_of_task);
  parallel_for(
      0, height,
      [&](int j) {
        std::vector<std::int32_t> out(static_cast<std::size_t>(width));
        spread_column(along_rows, j, width, height, kernel, softness, out);
        use(j, out.data());
        progress.check();
      },
      rows_of_task);
}

/// Two rows of samples, or one and itself shifted, between which ground slides.
struct BankRows {
  const std::int32_t* height;
  const std::int32_t* initial;
  const float* softness;  ///< or null
};

/// What is too steep, and what is loose, in one direction.
struct SlideRates {
  float stable = 0;  ///< quanta
  float creep = 0;   ///< share of a difference
};

/// What samples of `here` get from those of `there`, in quanta.
template <bool hardness>
void slide(const BankRows& here, const BankRows& there, int count, const SlideRates& rates,
           std::int32_t* out) {
  constexpr float share = 0.1F;  // eight neighbours together take less than the surplus
  for (int i = 0; i < count; ++i) {
    const auto difference = static_cast<float>(there.height[i] - here.height[i]);
    const auto at_first = static_cast<float>(there.initial[i] - here.initial[i]);
    const float height = std::abs(difference);
    const float allowed = std::max(rates.stable, std::abs(at_first));
    float surplus = std::max(0.0F, height - allowed) * share;
    if constexpr (hardness) surplus *= difference > 0 ? there.softness[i] : here.softness[i];
    const std::int32_t laid =
        difference > 0 ? there.height[i] - there.initial[i] : here.height[i] - here.initial[i];
    const float loose = std::min(std::max(0.0F, static_cast<float>(laid)), height);
    out[i] = static_cast<std::int32_t>(
        std::copysign(std::max(surplus, loose * rates.creep), difference));
  }
}

void add(const std::int32_t* amounts, int count, std::int32_t sign, std::int32_t* out) {
  for (int i = 0; i < count; ++i) out[i] += sign * amounts[i];
}

}  // namespace

DropletGround::DropletGround(const Heightfield& input)
    : width_(input.height.width()), height_(input.height.height()) {
  const HeightStatistics range = height_statistics(input);
  const double low = static_cast<double>(range.min);
  const double high = static_cast<double>(range.max);
  base_ = 0.5 * (low + high);
  int exponent = 0;
  std::frexp(std::max(high - low, 1e-30), &exponent);  // range < 2^exponent
  quantum_ = std::ldexp(1.0, std::max(-20, exponent - 29));
  cells_.resize(input.height.size());
  before_.resize(cells_.size());
  initial_.resize(cells_.size());
  spread_.resize(cells_.size());
  parallel_for(
      0, height_,
      [&](int j) {
        const std::size_t first = static_cast<std::size_t>(j) * static_cast<std::size_t>(width_);
        const auto row = input.height.row(j);
        for (std::size_t i = 0; i < row.size(); ++i)
          initial_[first + i] = before_[first + i] = cells_[first + i].height = quantised(row[i]);
      },
      rows_of_task);
}

std::int32_t DropletGround::quantised(float height) const {
  return static_cast<std::int32_t>(std::lrint((static_cast<double>(height) - base_) / quantum_));
}

void DropletGround::spread_changes(double radius_cells, const float* softness,
                                   const Progress& progress) {
  const std::vector<float> kernel = brush(radius_cells);
  const auto first = [this](int j) { return static_cast<std::ptrdiff_t>(j) * width_; };
  spread(
      width_, height_, kernel, softness, spread_, progress,
      [&](int j, std::int32_t* change) {
        const DropletCell* cells = cells_.data() + first(j);
        const std::int32_t* before = before_.data() + first(j);
        for (int i = 0; i < width_; ++i) change[i] = cells[i].height - before[i];
      },
      [&](int j, const std::int32_t* change) {
        DropletCell* cells = cells_.data() + first(j);
        std::int32_t* before = before_.data() + first(j);
        for (int i = 0; i < width_; ++i) before[i] = cells[i].height = before[i] + change[i];
      });
}

void DropletGround::settle(double bank_slope, double creep, double cell, const float* softness,
                           const Progress& progress) {
  const SlideRates straight{static_cast<float>(bank_slope * cell / quantum_),
                            static_cast<float>(std::min(creep, 0.1))};
  const SlideRates diagonal{straight.stable * std::sqrt(2.0F), straight.creep};
  const auto rows_at = [&](int j, int i) -> BankRows {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(j) * width_ + i;
    return {before_.data() + first, initial_.data() + first,
            softness == nullptr ? nullptr : softness + first};
  };
  const auto slide_rows = softness == nullptr ? slide<false> : slide<true>;
  const auto out_row = [&](int j) {
    return spread_.data() + static_cast<std::ptrdiff_t>(j) * width_;
  };
  const int tasks = (height_ + rows_of_task - 1) / rows_of_task;
  parallel_for(0, tasks, [&](int task) {
    const int low = task * rows_of_task;
    const int high = std::min(height_, low + rows_of_task);
    std::copy(before_.data() + static_cast<std::ptrdiff_t>(low) * width_,
              before_.data() + static_cast<std::ptrdiff_t>(high) * width_, out_row(low));
    std::vector<std::int32_t> amounts(static_cast<std::size_t>(width_));
    // Between sample i + a of row j and sample i + b of row k; both if they belong to this task.
    const auto pairs = [&](int j, int a, int k, int b, const SlideRates& rates) {
      const int count = width_ - std::max(a, b);
      slide_rows(rows_at(j, a), rows_at(k, b), count, rates, amounts.data());
      if (j >= low) add(amounts.data(), count, 1, out_row(j) + a);
      if (k < high) add(amounts.data(), count, -1, out_row(k) + b);
    };
    for (int j = std::max(0, low - 1); j < high; ++j) {
      if (j >= low) pairs(j, 0, j, 1, straight);
      if (j + 1 == height_) continue;
      pairs(j, 0, j + 1, 0, straight);
      pairs(j, 0, j + 1, 1, diagonal);
      pairs(j, 1, j + 1, 0, diagonal);
    }
    progress.check();
  });
  parallel_for(
      0, height_,
      [&](int j) {
        const std::size_t first = static_cast<std::size_t>(j) * static_cast<std::size_t>(width_);
        for (std::size_t k = first; k < first + static_cast<std::size_t>(width_); ++k)
          before_[k] = cells_[k].height = spread_[k];
      },
      rows_of_task);
}

Grid<float> DropletGround::eroded(const Heightfield& input) const {
  Grid<float> out(width_, height_);
  parallel_for(
      0, height_,
      [&](int j) {
        const auto in = input.height.row(j);
        const auto row = out.row(j);
        const DropletCell* cells = cells_.data() + static_cast<std::ptrdiff_t>(j) * width_;
        for (std::size_t i = 0; i < row.size(); ++i)
          row[i] = static_cast<float>(static_cast<double>(in[i]) +
                                      quantum_ * (cells[i].height - quantised(in[i])));
      },
      rows_of_task);
  return out;
}

Grid<float> DropletGround::wear(double radius_cells, const float* softness,
                                const Progress& progress) const {
  Grid<float> out(width_, height_);
  std::vector<std::int32_t> along_rows(cells_.size());
  spread(
      width_, height_, brush(radius_cells), softness, along_rows, progress,
      [&](int j, std::int32_t* change) {
        const DropletCell* cells = cells_.data() + static_cast<std::ptrdiff_t>(j) * width_;
        for (int i = 0; i < width_; ++i) change[i] = -cells[i].wear;
      },
      [&](int j, const std::int32_t* change) {
        const auto row = out.row(j);
        for (int i = 0; i < width_; ++i)
          row[static_cast<std::size_t>(i)] = static_cast<float>(-quantum_ * change[i]);
      });
  return out;
}

double DropletGround::total_wear() const {
  const std::int64_t sum = parallel_reduce(
      0, height_, std::int64_t{0},
      [&](int j) {
        const DropletCell* cells = cells_.data() + static_cast<std::ptrdiff_t>(j) * width_;
        std::int64_t of_row = 0;
        for (int i = 0; i < width_; ++i) of_row += cells[i].wear;
        return of_row;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
  return quantum_ * static_cast<double>(sum);
}

}  // namespace wold
