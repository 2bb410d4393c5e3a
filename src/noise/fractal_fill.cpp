// Fractals over a grid, by tiles of 64 × 32 samples.
//
// The lattice of every octave is turned, so no coordinate is constant along a row. What can be
// shared:
//
// - The place in an octave's lattice is a part by the column plus a part by the row, each split
// into
//   cell and fraction in double once per tile; a sample adds them and carries.
// - The gradients (or values) of all lattice points under the tile are hashed once into a small
//   table: at four samples per feature and fewer points than samples.
// - A vector holds a block of samples, four columns by lanes / 4 rows, so that it spans few cells:
// at
//   most three by three while 3 √2 step < 2. The 4 × 4 lattice points around fit one register of 16
//   lanes (or two of 8), and each lane picks its corners from there.
//
// All arithmetic is by sample, whatever its tile or lane.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/parallel.hpp"
#include "noise/fractal.hpp"
#include "noise/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/fractal_fill.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "noise/lattice-inl.hpp"
#include "noise/noise_cell.hpp"

#ifndef WOLD_FRACTAL_FILL_TILE
#define WOLD_FRACTAL_FILL_TILE
namespace wold {
namespace {

constexpr int tile_columns = 64;
constexpr int tile_rows = 32;
constexpr int tile_samples = tile_columns * tile_rows;
constexpr float widest_block_step = 0.47F;  // 3 √2 step < 2

/// A rectangle of a grid: the samples and where they lie.
struct FractalTile {
  GridView<float> out;  ///< of the tile alone
  int column = 0;       ///< of its first sample in the grid
  int row = 0;
  DVec2 origin{0};
  double step = 0;
  int octaves = 0;  ///< that are not faded out
};

}  // namespace
}  // namespace wold
#endif

HWY_BEFORE_NAMESPACE();
namespace wold::HWY_NAMESPACE {
namespace {

constexpr int block_columns = 4;

int block_rows() {
  return std::max(1, static_cast<int>(hn::Lanes(Floats())) / block_columns);
}

/// One axis of the lattice place of the samples: a part by column and a part by row, each a cell
/// (counted from the first of the tile) and a fraction. Fractions of rows stand four times over, as
/// the lanes of a block want them.
struct AxisParts {
  alignas(64) std::array<float, tile_columns> column_fraction;
  alignas(64) std::array<float, tile_rows * block_columns> row_fraction;
  std::array<std::int32_t, tile_columns> column_cell;
  std::array<std::int32_t, tile_rows> row_cell;
  std::uint32_t first_cell;  // modulo 2^32
  int cells;                 // under the tile, with the neighbour on the right
  int least_column;          // where in a block the coordinate is least
  int least_row;

  /// Sample (i, j) lies at along_x · x_i + along_y · y_j + shift.
  void set(const FractalTile& tile, double along_x, double along_y, double shift) {
    std::array<std::int64_t, tile_columns> column;
    std::array<std::int64_t, tile_rows> row;
    for (std::size_t i = 0; i < column.size(); ++i) {
      const double x = tile.origin.x + tile.step * (tile.column + static_cast<int>(i));
      column[i] = split(along_x * x, column_fraction[i]);
    }
    for (std::size_t j = 0; j < row.size(); ++j) {
      const double y = tile.origin.y + tile.step * (tile.row + static_cast<int>(j));
      float fraction = 0;
      row[j] = split(along_y * y + shift, fraction);
      std::fill_n(&row_fraction[j * block_columns], block_columns, fraction);
    }
    const auto [column_low, column_high] = std::minmax(column.front(), column.back());
    const auto [row_low, row_high] = std::minmax(row.front(), row.back());
    first_cell = static_cast<std::uint32_t>(column_low + row_low);
    cells = static_cast<int>(column_high - column_low + row_high - row_low) + 3;
    for (std::size_t i = 0; i < column.size(); ++i)
      column_cell[i] = static_cast<std::int32_t>(column[i] - column_low);
    for (std::size_t j = 0; j < row.size(); ++j)
      row_cell[j] = static_cast<std::int32_t>(row[j] - row_low);
    least_column = along_x * tile.step >= 0 ? 0 : block_columns - 1;
    least_row = along_y * tile.step >= 0 ? 0 : block_rows() - 1;
  }

  /// The least cell of the block whose first sample is (i, j).
  HWY_INLINE int least_cell(int i, int j) const {
    const auto ci = static_cast<std::size_t>(i + least_column);
    const auto cj = static_cast<std::size_t>(j + least_row);
    const float sum = column_fraction[ci] + row_fraction[cj * block_columns];
    return column_cell[ci] + row_cell[cj] + static_cast<int>(sum >= 1.0F);
  }

 private:
  static std::int64_t split(double x, float& fraction) {
    const double below = std::floor(x);
    fraction = static_cast<float>(x - below);
    return static_cast<std::int64_t>(below);
  }
};

/// The hashed lattice under a tile: gradients, or values in x alone.
struct LatticeTable {
  std::vector<float> x, y;
  int stride = 0;

  void set(const AxisParts& px, const AxisParts& py, NoiseBasis basis, std::uint32_t key) {
    const Floats d;
    const Unsigneds du;
    const auto lanes = static_cast<int>(hn::Lanes(d));
    constexpr int margin = 2;  // four points are read where two or three are needed
    stride = (px.cells + margin + lanes - 1) / lanes * lanes;
    const auto size =
        static_cast<std::size_t>(stride) * static_cast<std::size_t>(py.cells + margin);
    if (x.size() < size) x.resize(size);
    if (y.size() < size) y.resize(size);
    for (int j = 0; j < py.cells; ++j) {
      const std::uint32_t row = lattice_line(py.first_cell + static_cast<std::uint32_t>(j), key);
      for (int i = 0; i < stride; i += lanes) {
        const auto column = hn::Iota(du, px.first_cell + static_cast<std::uint32_t>(i));
        const auto hash = HWY_NAMESPACE::lattice_hash(column, row);
        const auto at = static_cast<std::size_t>(j * stride + i);
        if (basis == NoiseBasis::value) {
          hn::StoreU(HWY_NAMESPACE::lattice_value(hash), d, &x[at]);
          continue;
        }
        FloatVector gx;
        FloatVector gy;
        HWY_NAMESPACE::lattice_gradient2(hash, gx, gy);
        hn::StoreU(gx, d, &x[at]);
        hn::StoreU(gy, d, &y[at]);
      }
    }
  }
};

/// Four by four lattice points in registers; a lane picks point (i, j) by index i + 4 j.
class PointBlock {
 public:
  static constexpr bool in_registers = HWY_MAX_BYTES == 64 || HWY_MAX_BYTES == 32;

  HWY_INLINE PointBlock(const float* first, int stride) {
#if HWY_MAX_BYTES == 64
    points_ = hn::Combine(Floats(), two_rows(first + 2 * stride, stride), two_rows(first, stride));
#elif HWY_MAX_BYTES == 32
    low_ = two_rows(first, stride);
    high_ = two_rows(first + 2 * stride, stride);
#else
    first_ = first;
    stride_ = stride;
#endif
  }
  HWY_INLINE FloatVector pick(SignedVector index) const {
    const Floats d;
#if HWY_MAX_BYTES == 64
    return hn::TableLookupLanes(points_, hn::IndicesFromVec(d, index));
#elif HWY_MAX_BYTES == 32
    const Signeds di;
    const auto lane = hn::IndicesFromVec(d, hn::And(index, hn::Set(di, 7)));
    const auto in_low = hn::RebindMask(d, hn::Lt(index, hn::Set(di, 8)));
    return hn::IfThenElse(in_low, hn::TableLookupLanes(low_, lane),
                          hn::TableLookupLanes(high_, lane));
#else
    const Signeds di;
    const auto row = hn::Mul(hn::ShiftRight<2>(index), hn::Set(di, stride_));
    return hn::GatherIndex(d, first_, hn::Add(row, hn::And(index, hn::Set(di, 3))));
#endif
  }

 private:
#if HWY_MAX_BYTES == 64 || HWY_MAX_BYTES == 32
  static HWY_INLINE hn::Vec<hn::Full256<float>> two_rows(const float* first, int stride) {
    const hn::Full128<float> quarter;
    return hn::Combine(hn::Full256<float>(), hn::LoadU(quarter, first + stride),
                       hn::LoadU(quarter, first));
  }
#endif
#if HWY_MAX_BYTES == 64
  FloatVector points_;
#elif HWY_MAX_BYTES == 32
  FloatVector low_, high_;
#else
  const float* first_;
  int stride_;
#endif
};

/// Lattice points in memory, index i + stride j: for blocks too wide for registers.
class PointTable {
 public:
  HWY_INLINE PointTable(const float* first, int /*stride*/) : first_(first) {}
  HWY_INLINE FloatVector pick(SignedVector index) const {
    return hn::GatherIndex(Floats(), first_, index);
  }

 private:
  const float* first_;
};

/// One lattice cell for all lanes.
class OneCell {
 public:
  HWY_INLINE OneCell(const float* first, int stride) : first_(first), stride_(stride) {}
  HWY_INLINE FloatVector pick(int i, int j) const {
    return hn::Set(Floats(), first_[i + j * stride_]);
  }

 private:
  const float* first_;
  int stride_;
};

/// The noise and, if asked for, its slope in lattice coordinates.
struct VectorSample {
  FloatVector value, slope_x, slope_y;
};

/// The place of a lane in its cell.
struct Fractions {
  FloatVector x, y;
};

/// pick_x(i, j), pick_y(i, j): the gradient of the lane's corner.
template <bool with_slope, class PickX, class PickY>
HWY_INLINE VectorSample gradient_sample(Fractions t, const PickX& pick_x, const PickY& pick_y) {
  const auto one = hn::Set(Floats(), 1.0F);
  const auto left = hn::Sub(t.x, one);
  const auto below = hn::Sub(t.y, one);
  const auto x00 = pick_x(0, 0);
  const auto x10 = pick_x(1, 0);
  const auto x01 = pick_x(0, 1);
  const auto x11 = pick_x(1, 1);
  const auto y00 = pick_y(0, 0);
  const auto y10 = pick_y(1, 0);
  const auto y01 = pick_y(0, 1);
  const auto y11 = pick_y(1, 1);
  const auto n00 = hn::MulAdd(x00, t.x, hn::Mul(y00, t.y));
  const auto n10 = hn::MulAdd(x10, left, hn::Mul(y10, t.y));
  const auto n01 = hn::MulAdd(x01, t.x, hn::Mul(y01, below));
  const auto n11 = hn::MulAdd(x11, left, hn::Mul(y11, below));
  const auto u = fade(t.x);
  const auto v = fade(t.y);
  const auto low = lerp(n00, n10, u);
  const auto high = lerp(n01, n11, u);
  VectorSample n{lerp(low, high, v), u, v};
  if constexpr (with_slope) {
    const auto across = lerp(hn::Sub(n10, n00), hn::Sub(n11, n01), v);
    n.slope_x = hn::MulAdd(fade_slope(t.x), across, lerp(lerp(x00, x10, u), lerp(x01, x11, u), v));
    n.slope_y = hn::MulAdd(fade_slope(t.y), hn::Sub(high, low),
                           lerp(lerp(y00, y10, u), lerp(y01, y11, u), v));
  }
  return n;
}

/// pick(i, j): the value of the lane's corner.
template <bool with_slope, class Pick>
HWY_INLINE VectorSample value_sample(Fractions t, const Pick& pick) {
  const auto a00 = pick(0, 0);
  const auto a10 = pick(1, 0);
  const auto a01 = pick(0, 1);
  const auto a11 = pick(1, 1);
  const auto u = fade(t.x);
  const auto v = fade(t.y);
  const auto low = lerp(a00, a10, u);
  const auto high = lerp(a01, a11, u);
  VectorSample n{lerp(low, high, v), u, v};
  if constexpr (with_slope) {
    const auto across = lerp(hn::Sub(a10, a00), hn::Sub(a11, a01), v);
    n.slope_x = hn::Mul(fade_slope(t.x), across);
    n.slope_y = hn::Mul(fade_slope(t.y), hn::Sub(high, low));
  }
  return n;
}

/// What the samples of a tile have gathered, block after block.
struct Sums {
  alignas(64) std::array<float, tile_samples> total;
  alignas(64) std::array<float, tile_samples> w;  // of hybrid and ridged
  alignas(64) std::array<float, tile_samples> slope_x;
  alignas(64) std::array<float, tile_samples> slope_y;
};

/// One octave as its sum sees it.
struct Term {
  const Fractal* f;
  float amplitude;
  float weight;
  Mat2 matrix;
};

/// Adds one octave to the samples from `at` on: see the sums of fractal.cpp.
template <FractalKind kind>
HWY_INLINE void add_term(const Term& term, VectorSample n, Sums& sums, std::size_t at) {
  const Floats d;
  float* total = &sums.total[at];
  const auto scale = hn::Set(d, term.amplitude * term.weight);
  const auto add = [&](FloatVector value, FloatVector factor) HWY_ATTR {
    hn::Store(hn::MulAdd(value, factor, hn::Load(d, total)), d, total);
  };
  if constexpr (kind == FractalKind::fbm) {
    add(n.value, scale);
  } else if constexpr (kind == FractalKind::turbulence) {
    add(hn::Abs(n.value), scale);
  } else if constexpr (kind == FractalKind::hybrid) {
    const auto height = hn::Add(n.value, hn::Set(d, term.f->offset));
    const auto w = hn::Mul(hn::Load(d, &sums.w[at]), hn::Mul(height, hn::Set(d, term.amplitude)));
    add(w, hn::Set(d, term.weight));
    hn::Store(hn::Min(w, hn::Set(d, 1.0F)), d, &sums.w[at]);
  } else if constexpr (kind == FractalKind::ridged) {
    const float k = term.f->smooth_ridges;
    const auto rounded = [&]() HWY_ATTR {
      return hn::Sqrt(hn::MulAdd(n.value, n.value, hn::Set(d, k * k)));
    };
    const auto crest = hn::Sub(hn::Set(d, term.f->offset), k == 0 ? hn::Abs(n.value) : rounded());
    const auto s = hn::Mul(hn::Mul(crest, crest), hn::Load(d, &sums.w[at]));
    add(s, scale);
    const auto w = hn::Mul(s, hn::Set(d, term.f->gain));
    hn::Store(hn::Clamp(w, hn::Zero(d), hn::Set(d, 1.0F)), d, &sums.w[at]);
  } else {
    const Mat2& m = term.matrix;
    const auto a = hn::Mul(n.slope_x, scale);
    const auto b = hn::Mul(n.slope_y, scale);
    auto x = hn::Load(d, &sums.slope_x[at]);
    auto y = hn::Load(d, &sums.slope_y[at]);
    x = hn::MulAdd(a, hn::Set(d, m[0][0]), hn::MulAdd(b, hn::Set(d, m[0][1]), x));
    y = hn::MulAdd(a, hn::Set(d, m[1][0]), hn::MulAdd(b, hn::Set(d, m[1][1]), y));
    hn::Store(x, d, &sums.slope_x[at]);
    hn::Store(y, d, &sums.slope_y[at]);
    const auto square = hn::MulAdd(x, x, hn::Mul(y, y));
    const auto one = hn::Set(d, 1.0F);
    const auto damped = hn::Div(one, hn::MulAdd(square, hn::Set(d, term.f->damping), one));
    add(hn::Mul(n.value, scale), damped);
  }
}

/// The octaves of one tile.
class FractalTileFill {
 public:
  FractalTileFill(const FractalTile& tile, const FractalSampler& sampler)
      : tile_(tile), sampler_(sampler), f_(sampler.parameters()) {
    sums_.total.fill(0);
    sums_.w.fill(1);
    sums_.slope_x.fill(0);
    sums_.slope_y.fill(0);
  }

  void fill() {
    if (f_.basis == NoiseBasis::gradient)
      add_octaves<NoiseBasis::gradient>();
    else
      add_octaves<NoiseBasis::value>();
    write();
  }

 private:
  template <NoiseBasis basis>
  void add_octaves() {
    for (int i = 0; i < tile_.octaves; ++i) {
      switch (f_.kind) {
        case FractalKind::fbm: add_octave<basis, FractalKind::fbm>(i); break;
        case FractalKind::hybrid: add_octave<basis, FractalKind::hybrid>(i); break;
        case FractalKind::ridged: add_octave<basis, FractalKind::ridged>(i); break;
        case FractalKind::turbulence: add_octave<basis, FractalKind::turbulence>(i); break;
        case FractalKind::eroded: add_octave<basis, FractalKind::eroded>(i); break;
      }
    }
  }

  template <NoiseBasis basis, FractalKind kind>
  void add_octave(int i) {
    const FractalSampler::Octave& octave = sampler_.octave(i);
    const DMat2& m = octave.matrix2;
    x_.set(tile_, m[0][0], m[1][0], octave.shift2.x);
    y_.set(tile_, m[0][1], m[1][1], octave.shift2.y);
    lattice_.set(x_, y_, basis, octave.key);
    const float spacing = static_cast<float>(std::abs(tile_.step)) * octave.frequency;
    const Term term{&f_, octave.amplitude, octave_weight(spacing), Mat2(m)};
    if (spacing <= widest_block_step)
      add_blocks<basis, kind, PointBlock>(term, block_columns);
    else
      add_blocks<basis, kind, PointTable>(term, lattice_.stride);
  }

  // `stride` is the difference of indices between rows of lattice points, for Points.
  template <NoiseBasis basis, FractalKind kind, class Points>
  void add_blocks(const Term& term, int stride) {
    std::array<std::int32_t, tile_columns> column_index;
    std::array<std::int32_t, tile_rows * block_columns> row_index;
    for (std::size_t i = 0; i < column_index.size(); ++i)
      column_index[i] = x_.column_cell[i] + stride * y_.column_cell[i];
    for (std::size_t j = 0; j < tile_rows; ++j)
      std::fill_n(&row_index[j * block_columns], block_columns,
                  x_.row_cell[j] + stride * y_.row_cell[j]);
    const Floats d;
    const Signeds di;
    const int rows = block_rows();
    std::size_t at = 0;
    for (int j = 0; j < tile_.out.height(); j += rows) {
      const auto row_lane = static_cast<std::size_t>(j * block_columns);
      const auto row_x = hn::LoadU(d, &x_.row_fraction[row_lane]);
      const auto row_y = hn::LoadU(d, &y_.row_fraction[row_lane]);
      const auto row_cells = hn::LoadU(di, &row_index[row_lane]);
      for (int i = 0; i < tile_.out.width(); i += block_columns, at += hn::Lanes(d)) {
        const auto ci = static_cast<std::size_t>(i);
        const auto one = hn::Set(d, 1.0F);
        Fractions t{hn::Add(hn::LoadDup128(d, &x_.column_fraction[ci]), row_x),
                    hn::Add(hn::LoadDup128(d, &y_.column_fraction[ci]), row_y)};
        const auto carry_x = hn::Ge(t.x, one);
        const auto carry_y = hn::Ge(t.y, one);
        t.x = hn::Sub(t.x, hn::IfThenElseZero(carry_x, one));
        t.y = hn::Sub(t.y, hn::IfThenElseZero(carry_y, one));
        auto index = hn::Add(hn::LoadDup128(di, &column_index[ci]), row_cells);
        index = hn::Add(index, hn::IfThenElseZero(hn::RebindMask(di, carry_x), hn::Set(di, 1)));
        index =
            hn::Add(index, hn::IfThenElseZero(hn::RebindMask(di, carry_y), hn::Set(di, stride)));
        const int first_x = x_.least_cell(i, j);
        const int first_y = y_.least_cell(i, j);
        index = hn::Sub(index, hn::Set(di, first_x + stride * first_y));
        const std::ptrdiff_t first = first_x + std::ptrdiff_t{lattice_.stride} * first_y;
        const VectorSample n = hn::AllTrue(di, hn::Eq(index, hn::Zero(di)))
                                   ? sample_cell<basis, kind>(t, first)
                                   : sample_block<basis, kind, Points>(t, first, index, stride);
        add_term<kind>(term, n, sums_, at);
      }
    }
  }

  template <NoiseBasis basis, FractalKind kind>
  HWY_INLINE VectorSample sample_cell(Fractions t, std::ptrdiff_t first) const {
    constexpr bool with_slope = kind == FractalKind::eroded;
    const OneCell x(lattice_.x.data() + first, lattice_.stride);
    const OneCell y(lattice_.y.data() + first, lattice_.stride);
    const auto pick_x = [&](int i, int j) HWY_ATTR { return x.pick(i, j); };
    if constexpr (basis == NoiseBasis::value) return value_sample<with_slope>(t, pick_x);
    const auto pick_y = [&](int i, int j) HWY_ATTR { return y.pick(i, j); };
    return gradient_sample<with_slope>(t, pick_x, pick_y);
  }

  template <NoiseBasis basis, FractalKind kind, class Points>
  HWY_INLINE VectorSample sample_block(Fractions t, std::ptrdiff_t first, SignedVector index,
                                       int stride) const {
    constexpr bool with_slope = kind == FractalKind::eroded;
    const auto corner = [&](int i, int j)
                            HWY_ATTR { return hn::Add(index, hn::Set(Signeds(), i + stride * j)); };
    const Points x(lattice_.x.data() + first, lattice_.stride);
    const auto pick_x = [&](int i, int j) HWY_ATTR { return x.pick(corner(i, j)); };
    if constexpr (basis == NoiseBasis::value) return value_sample<with_slope>(t, pick_x);
    const Points y(lattice_.y.data() + first, lattice_.stride);
    const auto pick_y = [&](int i, int j) HWY_ATTR { return y.pick(corner(i, j)); };
    return gradient_sample<with_slope>(t, pick_x, pick_y);
  }

  void write() const {
    const int rows = block_rows();
    std::size_t at = 0;
    for (int j = 0; j < tile_.out.height(); j += rows)
      for (int i = 0; i < tile_.out.width(); i += block_columns)
        for (int r = 0; r < rows; ++r, at += block_columns) {
          if (j + r >= tile_.out.height()) continue;
          const auto count = std::min(block_columns, tile_.out.width() - i);
          std::copy_n(&sums_.total[at], count, &tile_.out(i, j + r));
        }
  }

  FractalTile tile_;
  const FractalSampler& sampler_;
  const Fractal& f_;
  AxisParts x_, y_;
  LatticeTable lattice_;
  Sums sums_;
};

void fill_fractal_tile(const FractalTile& tile, const FractalSampler& sampler) {
  std::make_unique<FractalTileFill>(tile, sampler)->fill();
}

}  // namespace
}  // namespace wold::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wold {
namespace {
HWY_EXPORT(fill_fractal_tile);
}

void fill_fractal(GridView<float> out, const Fractal& f, DVec2 origin, double step,
                  std::uint32_t seed, Progress& progress) {
  const FractalSampler sampler(f, seed);
  const int octaves = sampler.octaves_at(static_cast<float>(std::abs(step)));
  const int across = (out.width() + tile_columns - 1) / tile_columns;
  const int up = (out.height() + tile_rows - 1) / tile_rows;
  progress.begin("fractal", static_cast<double>(out.width()) * out.height(), "samples");
  parallel_for(0, across * up, [&](int task) {
    progress.check();
    const int column = task % across * tile_columns;
    const int row = task / across * tile_rows;
    const int width = std::min(tile_columns, out.width() - column);
    const int height = std::min(tile_rows, out.height() - row);
    HWY_DYNAMIC_DISPATCH(fill_fractal_tile)
    ({out.sub(column, row, width, height), column, row, origin, step, octaves}, sampler);
    progress.advance(static_cast<double>(width) * height);
  });
  progress.end();
}

}  // namespace wold
#endif
