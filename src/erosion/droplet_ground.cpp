#include "erosion/droplet_ground.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
  const auto offset = [stride = droplet_stride(width)](int row) {
    return static_cast<std::ptrdiff_t>(row) * stride;
  };
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
            std::vector<std::int32_t>& along_rows, Progress& progress, const Change& change,
            const Use& use) {
  const auto offset = [stride = droplet_stride(width)](int j) {
    return static_cast<std::ptrdiff_t>(j) * stride;
  };
  parallel_for(
      0, height,
      [&](int j) {
        std::vector<std::int32_t> in(static_cast<std::size_t>(width));
        change(j, in.data());
        spread_row(in.data(), along_rows.data() + offset(j), width, kernel,
                   softness == nullptr ? nullptr : softness + offset(j));
        progress.advance(0);
      },
      rows_of_task);
  parallel_for(
      0, height,
      [&](int j) {
        std::vector<std::int32_t> out(static_cast<std::size_t>(width));
        spread_column(along_rows, j, width, height, kernel, softness, out);
        use(j, out.data());
        progress.advance(0);
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
  std::int32_t stable = 0;  ///< quanta
  float creep = 0;          ///< share of a difference
};

SlideRates slide_rates(double stable, double creep) {
  constexpr double largest = 0x1p30;  // more than any two samples differ by
  return {static_cast<std::int32_t>(std::min(stable, largest)),
          static_cast<float>(std::min(creep, 0.1))};
}

/// What samples of `here` get from those of `there`, in quanta. Without branches, for vectors.
template <bool hardness>
void slide(const BankRows& here, const BankRows& there, int count, SlideRates rates,
           std::int32_t* out) {
  constexpr float share = 0.1F;  // eight neighbours together take less than the surplus
  const std::int32_t stable = rates.stable;
  for (int i = 0; i < count; ++i) {
    const std::int32_t difference = there.height[i] - here.height[i];
    const std::int32_t from_there = -static_cast<std::int32_t>(difference > 0);  // a mask
    const std::int32_t laid_there = there.height[i] - there.initial[i];
    const std::int32_t laid_here = here.height[i] - here.initial[i];
    const std::int32_t height = std::abs(difference);
    const std::int32_t at_first = std::abs(there.initial[i] - here.initial[i]);
    const std::int32_t allowed = at_first > stable ? at_first : stable;
    const std::int32_t over = height - allowed;
    float surplus = static_cast<float>(over > 0 ? over : 0) * share;
    if constexpr (hardness) {
      const float soft_here = here.softness[i];
      const float soft_there = there.softness[i];
      surplus *= difference > 0 ? soft_there : soft_here;
    }
    const std::int32_t laid = laid_here ^ ((laid_here ^ laid_there) & from_there);
    const std::int32_t loose = std::min(laid > 0 ? laid : 0, height);
    const auto slides = static_cast<std::int32_t>(surplus);
    const auto creeps = static_cast<std::int32_t>(static_cast<float>(loose) * rates.creep);
    const std::int32_t amount = slides > creeps ? slides : creeps;
    out[i] = (amount ^ ~from_there) - ~from_there;
  }
}

void add(const std::int32_t* amounts, int count, std::int32_t sign, std::int32_t* out) {
  for (int i = 0; i < count; ++i) out[i] += sign * amounts[i];
}

}  // namespace

DropletGround::DropletGround(const Heightfield& input)
    : width_(input.height.width()),
      height_(input.height.height()),
      stride_(droplet_stride(width_)) {
  const HeightStatistics range = height_statistics(input);
  const double low = static_cast<double>(range.min);
  const double high = static_cast<double>(range.max);
  base_ = 0.5 * (low + high);
  int exponent = 0;
  std::frexp(std::max(high - low, 1e-30), &exponent);  // range < 2^exponent
  quantum_ = std::ldexp(1.0, std::max(-20, exponent - 29));
  cells_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_));
  before_.resize(cells_.size());
  initial_.resize(cells_.size());
  spread_.resize(cells_.size());
  parallel_for(
      0, height_,
      [&](int j) {
        const auto first = static_cast<std::size_t>(row_at(j));
        const auto row = input.height.row(j);
        for (std::size_t i = 0; i < row.size(); ++i)
          initial_[first + i] = before_[first + i] = cells_[first + i].height = quantised(row[i]);
      },
      rows_of_task);
}

std::int32_t DropletGround::quantised(float height) const {
  return static_cast<std::int32_t>(std::lrint((static_cast<double>(height) - base_) / quantum_));
}

void DropletGround::spread_changes(double radius_cells, const float* softness, Progress& progress) {
  const std::vector<float> kernel = brush(radius_cells);
  spread(
      width_, height_, kernel, softness, spread_, progress,
      [&](int j, std::int32_t* change) {
        const DropletCell* cells = cells_.data() + row_at(j);
        const std::int32_t* before = before_.data() + row_at(j);
        for (int i = 0; i < width_; ++i) change[i] = cells[i].height - before[i];
      },
      [&](int j, const std::int32_t* change) {
        DropletCell* cells = cells_.data() + row_at(j);
        std::int32_t* before = before_.data() + row_at(j);
        for (int i = 0; i < width_; ++i) before[i] = cells[i].height = before[i] + change[i];
      });
}

void DropletGround::settle(double bank_slope, double creep, double cell, const float* softness,
                           Progress& progress) {
  const double stable = bank_slope * cell / quantum_;
  const SlideRates straight = slide_rates(stable, creep);
  const SlideRates diagonal = slide_rates(stable * std::sqrt(2.0), creep);
  const auto rows_at = [&](int j, int i) -> BankRows {
    const std::ptrdiff_t first = row_at(j) + i;
    return {before_.data() + first, initial_.data() + first,
            softness == nullptr ? nullptr : softness + first};
  };
  const auto slide_rows = softness == nullptr ? slide<false> : slide<true>;
  const auto out_row = [&](int j) { return spread_.data() + row_at(j); };
  const int tasks = (height_ + rows_of_task - 1) / rows_of_task;
  parallel_for(0, tasks, [&](int task) {
    const int low = task * rows_of_task;
    const int high = std::min(height_, low + rows_of_task);
    std::copy(before_.data() + row_at(low), before_.data() + row_at(high), out_row(low));
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
    progress.advance(0);
  });
  parallel_for(
      0, height_,
      [&](int j) {
        const auto first = static_cast<std::size_t>(row_at(j));
        for (std::size_t k = first; k < first + static_cast<std::size_t>(width_); ++k)
          before_[k] = cells_[k].height = spread_[k];
      },
      rows_of_task);
}

Grid<float> DropletGround::eroded(const Heightfield& input, Progress& progress) const {
  Grid<float> out = input.height;
  double left = 0;
  float* finest = nullptr;
  double change_of_finest = 0;
  // What changes by less than is handed on passes it by: no ground rises that was worn.
  const auto taken = [&left](double change) {
    return std::abs(left) <= std::abs(change) ? std::exchange(left, 0) : 0;
  };
  for (int j = 0; j < height_; ++j) {
    const DropletCell* cells = cells_.data() + row_at(j);
    const std::int32_t* initial = initial_.data() + row_at(j);
    for (int i = 0; i < width_; ++i) {
      if (cells[i].height == initial[i]) continue;
      const double change = quantum_ * (cells[i].height - initial[i]);
      float& height = out(i, j);
      const double exact = static_cast<double>(height) + change + taken(change);
      height = static_cast<float>(exact);
      left += exact - static_cast<double>(height);
      if (finest != nullptr && std::abs(height) >= std::abs(*finest)) continue;
      finest = &height;
      change_of_finest = change;
    }
    progress.advance(0);
  }
  if (finest != nullptr)
    *finest = static_cast<float>(static_cast<double>(*finest) + taken(change_of_finest));
  return out;
}

Grid<float> DropletGround::wear(double radius_cells, const float* softness,
                                Progress& progress) const {
  Grid<float> out(width_, height_);
  std::vector<std::int32_t> along_rows(cells_.size());
  spread(
      width_, height_, brush(radius_cells), softness, along_rows, progress,
      [&](int j, std::int32_t* change) {
        const DropletCell* cells = cells_.data() + row_at(j);
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
        const DropletCell* cells = cells_.data() + row_at(j);
        std::int64_t of_row = 0;
        for (int i = 0; i < width_; ++i) of_row += cells[i].wear;
        return of_row;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
  return quantum_ * static_cast<double>(sum);
}

}  // namespace wold
