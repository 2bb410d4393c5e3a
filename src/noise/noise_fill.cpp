// One octave of noise over a grid.
//
// Along a row, y is constant. So for the lattice column m left of a sample, noise is affine in the
// place t in the cell, but for the fade u(t):
//
//   n(t) = A_m(t) + u(t) (B_m(t) - A_m(t)),    A_m = a0_m + a1_m t,    B_m = A_{m+1}(t - 1)
//   a1_m = lerp(gx_0, gx_1, v)                 gx, gy: the gradients of lattice points (m, row 0,
//   1) a0_m = (1 - v) y gy_0 + v (y - 1) gy_1     v = f(y)
//
// The coefficients are worked out once per lattice column and row of samples, the gradients once
// per lattice point, and t, u and the column once per column of samples. What remains per sample is
// four lookups in registers and three multiply-adds: a few instructions per vector. It needs
// that the lanes of a vector see no more columns than a register has lanes: step < 1. Wider
// steps work out the coefficients of both columns for each sample.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "noise/fractal.hpp"
#include "noise/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/noise_fill.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "noise/lattice-inl.hpp"
#include "noise/noise_cell.hpp"

#ifndef WOLD_NOISE_FILL_TILE
#define WOLD_NOISE_FILL_TILE
namespace wold {
namespace {

constexpr int tile_columns = 512;
constexpr int tile_rows = 64;
constexpr double widest_shared_step = 0.95;

/// A rectangle of a grid: the samples and where they lie.
struct NoiseTile {
  GridView<float> out;  ///< of the tile alone
  int column = 0;       ///< of its first sample in the grid
  int row = 0;
  NoiseBasis basis = NoiseBasis::gradient;
  DVec2 origin{0};
  double step = 0;
  std::uint32_t key = 0;
};

}  // namespace
}  // namespace wold
#endif

HWY_BEFORE_NAMESPACE();
namespace wold::HWY_NAMESPACE {
namespace {

using Buffer = std::vector<float>;

std::size_t padded(std::size_t count) {
  const std::size_t lanes = hn::Lanes(Floats());
  return (count + lanes - 1) / lanes * lanes;
}

/// Lattice columns side by side: their x, and on two lattice rows their gradients or values.
class LatticeColumns {
 public:
  LatticeColumns(std::vector<std::uint32_t> x, NoiseBasis basis, std::uint32_t key)
      : basis_(basis), key_(key), x_(std::move(x)) {
    x_.resize(padded(x_.size()));
    for (Line& line : lines_) {
      line.gx.resize(x_.size());
      line.gy.resize(x_.size());
    }
    a0.resize(x_.size());
    a1.resize(x_.size());
  }

  /// Works out a0 and a1 of all columns on the line at y.
  void set_row(double y) {
    const noise_cell::Split place = noise_cell::split(y);
    move_to(place.cell);
    const Floats d;
    const float v = noise_cell::fade(place.fraction);
    const auto fade_v = hn::Set(d, v);
    const auto y0 = hn::Set(d, (1.0F - v) * place.fraction);
    const auto y1 = hn::Set(d, v * (place.fraction - 1.0F));
    const Line& low = lines_[0];
    const Line& high = lines_[1];
    for (std::size_t m = 0; m < x_.size(); m += hn::Lanes(d)) {
      const auto x_low = hn::LoadU(d, &low.gx[m]);
      hn::StoreU(lerp(x_low, hn::LoadU(d, &high.gx[m]), fade_v), d, &a1[m]);
      if (basis_ == NoiseBasis::value) continue;
      const auto part = hn::Mul(hn::LoadU(d, &low.gy[m]), y0);
      hn::StoreU(hn::MulAdd(hn::LoadU(d, &high.gy[m]), y1, part), d, &a0[m]);
    }
  }

  Buffer a0;  ///< gradient noise only
  Buffer a1;  ///< of value noise: the value

 private:
  struct Line {
    Buffer gx, gy;  ///< gx holds the values of value noise
  };

  void move_to(std::uint32_t cell) {
    if (ready_ && cell == cell_) return;
    if (ready_ && cell == cell_ + 1) {
      std::swap(lines_[0], lines_[1]);
    } else {
      fill(lines_[0], cell);
    }
    fill(lines_[1], cell + 1);
    cell_ = cell;
    ready_ = true;
  }

  void fill(Line& line, std::uint32_t y) {
    const Floats d;
    const std::uint32_t row = lattice_line(y, key_);
    for (std::size_t m = 0; m < x_.size(); m += hn::Lanes(d)) {
      const auto hash = HWY_NAMESPACE::lattice_hash(hn::LoadU(Unsigneds(), &x_[m]), row);
      if (basis_ == NoiseBasis::value) {
        hn::StoreU(HWY_NAMESPACE::lattice_value(hash), d, &line.gx[m]);
        continue;
      }
      FloatVector gx;
      FloatVector gy;
      HWY_NAMESPACE::lattice_gradient2(hash, gx, gy);
      hn::StoreU(gx, d, &line.gx[m]);
      hn::StoreU(gy, d, &line.gy[m]);
    }
  }

  NoiseBasis basis_;
  std::uint32_t key_;
  std::vector<std::uint32_t> x_;
  Line lines_[2];
  std::uint32_t cell_ = 0;
  bool ready_ = false;
};

/// The columns of samples of a tile: lattice cell, place in it, and its fade.
struct SampleColumns {
  explicit SampleColumns(const NoiseTile& tile) {
    const auto width = static_cast<std::size_t>(tile.out.width());
    cell.resize(padded(width));
    t.resize(padded(width));
    u.resize(padded(width));
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const int column = tile.column + static_cast<int>(std::min(i, width - 1));
      const noise_cell::Split place = noise_cell::split(tile.origin.x + tile.step * column);
      cell[i] = place.cell;
      t[i] = place.fraction;
    }
    const Floats d;
    for (std::size_t i = 0; i < t.size(); i += hn::Lanes(d))
      hn::StoreU(HWY_NAMESPACE::fade(hn::LoadU(d, &t[i])), d, &u[i]);
  }

  std::vector<std::uint32_t> cell;
  Buffer t, u;
};

/// A row of the tile, written in whole vectors; what stands over the edge is dropped.
class RowWriter {
 public:
  explicit RowWriter(int width) : width_(static_cast<std::size_t>(width)), tail_(padded(1)) {}
  HWY_INLINE void write(FloatVector v, float* row, std::size_t i) {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    if (i + lanes <= width_) {
      hn::StoreU(v, d, row + i);
    } else {
      hn::StoreU(v, d, tail_.data());
      std::copy_n(tail_.begin(), width_ - i, row + i);
    }
  }

 private:
  std::size_t width_;
  Buffer tail_;
};

HWY_INLINE FloatVector combine(FloatVector a0, FloatVector a1, FloatVector d0, FloatVector d1,
                               FloatVector t, FloatVector u) {
  return hn::MulAdd(u, hn::MulAdd(d1, t, d0), hn::MulAdd(a1, t, a0));
}

/// Steps below one: the lanes of a vector pick their columns from registers.
class SharedColumns {
 public:
  explicit SharedColumns(const NoiseTile& tile)
      : tile_(tile), samples_(tile), lattice_(columns(samples_), tile.basis, tile.key) {
    const std::size_t lanes = hn::Lanes(Floats());
    const std::size_t count = samples_.cell.size();
    const std::uint32_t first = samples_.cell.front();
    cells_ = samples_.cell.back() - first + 1;
    for (Buffer* b : {&a0_, &a1_, &d0_, &d1_}) b->resize(padded(cells_) + lanes);
    index_.resize(count);
    for (std::size_t i = 0; i < count; i += lanes) {
      base_.push_back(cells_ <= lanes ? 0 : samples_.cell[i] - first);
      for (std::size_t k = i; k < i + lanes; ++k)
        index_[k] = static_cast<std::int32_t>(samples_.cell[k] - first - base_.back());
    }
  }

  void fill() {
    RowWriter writer(tile_.out.width());
    for (int j = 0; j < tile_.out.height(); ++j) {
      lattice_.set_row(tile_.origin.y + tile_.step * (tile_.row + j));
      float* row = tile_.out.row(j).data();
      if (tile_.basis == NoiseBasis::value) {
        fill_values(row, writer);
      } else {
        set_cells();
        fill_gradients(row, writer);
      }
    }
  }

 private:
  static std::vector<std::uint32_t> columns(const SampleColumns& samples) {
    const std::uint32_t first = samples.cell.front();
    std::vector<std::uint32_t> x(samples.cell.back() - first + 2 + hn::Lanes(Floats()));
    for (std::size_t m = 0; m < x.size(); ++m) x[m] = first + static_cast<std::uint32_t>(m);
    return x;
  }

  // A and B - A of each cell as coefficients of 1 and t.
  void set_cells() {
    const Floats d;
    for (std::size_t m = 0; m < cells_; m += hn::Lanes(d)) {
      const auto a0 = hn::LoadU(d, &lattice_.a0[m]);
      const auto a1 = hn::LoadU(d, &lattice_.a1[m]);
      const auto b1 = hn::LoadU(d, &lattice_.a1[m + 1]);
      const auto b0 = hn::Sub(hn::LoadU(d, &lattice_.a0[m + 1]), b1);
      hn::StoreU(a0, d, &a0_[m]);
      hn::StoreU(a1, d, &a1_[m]);
      hn::StoreU(hn::Sub(b0, a0), d, &d0_[m]);
      hn::StoreU(hn::Sub(b1, a1), d, &d1_[m]);
    }
  }

  void fill_gradients(float* row, RowWriter& writer) const {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t i = 0, k = 0; i < index_.size(); i += lanes, ++k) {
      const auto index = hn::IndicesFromVec(d, hn::LoadU(Signeds(), &index_[i]));
      const std::size_t m = base_[k];
      const auto pick = [&](const Buffer& b)
                            HWY_ATTR { return hn::TableLookupLanes(hn::LoadU(d, &b[m]), index); };
      writer.write(combine(pick(a0_), pick(a1_), pick(d0_), pick(d1_), hn::LoadU(d, &samples_.t[i]),
                           hn::LoadU(d, &samples_.u[i])),
                   row, i);
    }
  }

  void fill_values(float* row, RowWriter& writer) const {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t i = 0, k = 0; i < index_.size(); i += lanes, ++k) {
      const auto index = hn::IndicesFromVec(d, hn::LoadU(Signeds(), &index_[i]));
      const float* a = &lattice_.a1[base_[k]];
      const auto left = hn::TableLookupLanes(hn::LoadU(d, a), index);
      const auto right = hn::TableLookupLanes(hn::LoadU(d, a + 1), index);
      writer.write(lerp(left, right, hn::LoadU(d, &samples_.u[i])), row, i);
    }
  }

  NoiseTile tile_;
  SampleColumns samples_;
  LatticeColumns lattice_;
  std::size_t cells_ = 0;
  std::vector<std::size_t> base_;  // of each vector of samples: its first cell
  std::vector<std::int32_t> index_;
  Buffer a0_, a1_, d0_, d1_;  // by cell
};

/// Any step: each sample has its own two lattice columns.
void fill_own_columns(const NoiseTile& tile) {
  const Floats d;
  const SampleColumns samples(tile);
  std::vector<std::uint32_t> next = samples.cell;
  for (std::uint32_t& x : next) ++x;
  LatticeColumns left(samples.cell, tile.basis, tile.key);
  LatticeColumns right(std::move(next), tile.basis, tile.key);
  RowWriter writer(tile.out.width());
  for (int j = 0; j < tile.out.height(); ++j) {
    const double y = tile.origin.y + tile.step * (tile.row + j);
    left.set_row(y);
    right.set_row(y);
    float* row = tile.out.row(j).data();
    for (std::size_t i = 0; i < samples.t.size(); i += hn::Lanes(d)) {
      const auto a1 = hn::LoadU(d, &left.a1[i]);
      const auto b1 = hn::LoadU(d, &right.a1[i]);
      const auto u = hn::LoadU(d, &samples.u[i]);
      if (tile.basis == NoiseBasis::value) {
        writer.write(lerp(a1, b1, u), row, i);
        continue;
      }
      const auto a0 = hn::LoadU(d, &left.a0[i]);
      const auto b0 = hn::Sub(hn::LoadU(d, &right.a0[i]), b1);
      writer.write(
          combine(a0, a1, hn::Sub(b0, a0), hn::Sub(b1, a1), hn::LoadU(d, &samples.t[i]), u), row,
          i);
    }
  }
}

void fill_noise_tile(const NoiseTile& tile) {
  if (tile.step >= 0 && tile.step <= widest_shared_step)
    SharedColumns(tile).fill();
  else
    fill_own_columns(tile);
}

}  // namespace
}  // namespace wold::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wold {
namespace {
HWY_EXPORT(fill_noise_tile);
}

void fill_noise(GridView<float> out, NoiseBasis basis, DVec2 origin, double step,
                std::uint32_t seed, Progress& progress) {
  const int across = (out.width() + tile_columns - 1) / tile_columns;
  const int up = (out.height() + tile_rows - 1) / tile_rows;
  const ProgressStage stage(progress, "noise", static_cast<double>(out.width()) * out.height(),
                            "samples");
  const std::uint32_t key = lattice_key(seed);
  parallel_for(0, across * up, [&](int task) {
    progress.check();
    const int column = task % across * tile_columns;
    const int row = task / across * tile_rows;
    const int width = std::min(tile_columns, out.width() - column);
    const int height = std::min(tile_rows, out.height() - row);
    HWY_DYNAMIC_DISPATCH(fill_noise_tile)
    ({out.sub(column, row, width, height), column, row, basis, origin, step, key});
    progress.advance(static_cast<double>(width) * height);
  });
}

}  // namespace wold
#endif
