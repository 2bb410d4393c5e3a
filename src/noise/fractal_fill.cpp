// Fractals over a grid, by tiles of 64 × 64 samples.
//
// The lattice of every octave is turned, so no coordinate is constant along a row. What can be
// shared:
//
// - The place in an octave's lattice is a part by the column plus a part by the row, each split
// into
//   cell and fraction in double once per tile; a sample adds them and carries.
// - The gradients (or values) of all lattice points under the tile are hashed once into a small
//   table: at four samples per feature and fewer points than samples.
// - A vector holds a block of samples, four columns by lanes / 4 rows, so that it spans few cells,
// at
//   most three by three. The 4 × 4 lattice points around fit one register of 16 lanes (or two of
//   8), and each lane picks its corners from there. Octaves so coarse that one such register serves
//   the whole tile load it once.
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
constexpr int tile_rows = 64;
constexpr int tile_samples = tile_columns * tile_rows;

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

/// The places of the samples of a tile along one axis of the grid.
template <std::size_t count>
std::array<double, count> sample_places(double origin, double step, int first) {
  std::array<double, count> places;
  for (std::size_t i = 0; i < count; ++i) places[i] = origin + step * (first + static_cast<int>(i));
  return places;
}

constexpr float below_one = 0x1.fffffeP-1F;  // so that two fractions carry once at most

/// One part, by column or by row, of one axis of the lattice place: fraction, and cell counted from
/// the least.
template <std::size_t count>
struct AxisPart {
  alignas(64) std::array<float, count> fraction;
  std::array<std::int32_t, count> cell;
  std::int64_t least = 0;
  int cells = 0;
  bool rising = true;

  void set(const std::array<double, count>& places, double along, double shift) {
    std::array<double, count> below;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = along * places[i] + shift;
      below[i] = std::floor(x);
      fraction[i] = std::min(static_cast<float>(x - below[i]), below_one);
    }
    const auto [low, high] = std::minmax(below.front(), below.back());
    for (std::size_t i = 0; i < count; ++i) cell[i] = static_cast<std::int32_t>(below[i] - low);
    least = static_cast<std::int64_t>(low);
    cells = static_cast<int>(high - low) + 1;
    rising = places.back() * along >= places.front() * along;
  }
};

/// One axis of the lattice place of the samples: (i, j) lies at cell column.cell[i] + row.cell[j]
/// of the tile, and at the sum of the fractions in it, or one cell on if that reaches 1.
struct AxisParts {
  AxisPart<tile_columns> column;
  AxisPart<tile_rows> row;

  std::uint32_t first_cell() const { return static_cast<std::uint32_t>(column.least + row.least); }
  /// Under the tile: with the carry and the neighbour on the right.
  int cells() const { return column.cells + row.cells + 1; }

  /// 1 if the least place of the block whose first sample is (i, j) carries.
  HWY_INLINE int carry(int i, int j, int rows) const {
    const int least_i = column.rising ? i : i + block_columns - 1;
    const int least_j = row.rising ? j : j + rows - 1;
    return static_cast<int>(column.fraction[static_cast<std::size_t>(least_i)] +
                                row.fraction[static_cast<std::size_t>(least_j)] >=
                            1.0F);
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
    stride = (px.cells() + margin + lanes - 1) / lanes * lanes;
    const auto size =
        static_cast<std::size_t>(stride) * static_cast<std::size_t>(py.cells() + margin);
    if (x.size() < size) x.resize(size);
    if (y.size() < size) y.resize(size);
    for (int j = 0; j < py.cells(); ++j) {
      const std::uint32_t row = lattice_line(py.first_cell() + static_cast<std::uint32_t>(j), key);
      for (int i = 0; i < stride; i += lanes) {
        const auto column = hn::Iota(du, px.first_cell() + static_cast<std::uint32_t>(i));
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

/// How the lanes of a block find their lattice points. Each has the points' difference of index by
/// row, whether blocks count cells from the tile or from their own first cell, and that cell with
/// or without its carry; `pick(index, i, j)` is the corner (i, j) of the lane's cell.

/// The whole tile lies on 4 × 4 points.
class TilePoints {
 public:
  static constexpr bool by_block = false;
  static constexpr bool with_carry = false;
  static int row_stride(int /*stride*/) { return 4; }

  TilePoints(const float* first, int stride)
      : points_{{first, stride},
                {first + 1, stride},
                {first + stride, stride},
                {first + stride + 1, stride}} {}
  HWY_INLINE const TilePoints& at(std::ptrdiff_t /*first*/) const { return *this; }
  HWY_INLINE FloatVector pick(SignedVector index, int i, int j) const {
    return points_[i + 2 * j].pick(index);
  }

 private:
  PointBlock points_[4];
};

/// Every block has its own 4 × 4 points.
template <bool carry>
class BlockPoints {
 public:
  static constexpr bool by_block = true;
  static constexpr bool with_carry = carry;
  static int row_stride(int /*stride*/) { return 4; }

  BlockPoints(const float* first, int stride) : first_(first), stride_(stride) {}
  struct Picker {
    PointBlock points;
    HWY_INLINE FloatVector pick(SignedVector index, int i, int j) const {
      return points.pick(hn::Add(index, hn::Set(Signeds(), i + 4 * j)));
    }
  };
  HWY_INLINE Picker at(std::ptrdiff_t first) const { return {{first_ + first, stride_}}; }

 private:
  const float* first_;
  int stride_;
};

/// Points in memory: for blocks that span too many cells.
class FarPoints {
 public:
  static constexpr bool by_block = false;
  static constexpr bool with_carry = false;
  static int row_stride(int stride) { return stride; }

  FarPoints(const float* first, int stride) : first_(first), stride_(stride) {}
  HWY_INLINE const FarPoints& at(std::ptrdiff_t /*first*/) const { return *this; }
  HWY_INLINE FloatVector pick(SignedVector index, int i, int j) const {
    return hn::GatherIndex(Floats(), first_ + i + j * stride_, index);
  }

 private:
  const float* first_;
  int stride_;
};

/// The cells that the lanes of blocks are in, as indices of their lattice points: a part by column
/// and a part by row, in floats (exact) above 2^23, so that their lowest bits are the integer.
struct CellIndices {
  alignas(64) std::array<float, tile_columns> column;
  alignas(64) std::array<float, tile_rows * block_columns> row;
  std::array<std::int32_t, tile_columns / block_columns> column_first;  // of blocks
  std::array<std::int32_t, tile_rows> row_first;

  void set(const AxisParts& x, const AxisParts& y, bool by_block, int row_stride,
           int table_stride) {
    set_part(x.column, y.column, by_block ? block_columns : tile_columns, row_stride, table_stride,
             column_first.data(),
             [&](std::size_t i, int index) { column[i] = static_cast<float>(index); });
    set_part(x.row, y.row, by_block ? block_rows() : tile_rows, row_stride, table_stride,
             row_first.data(), [&](std::size_t j, int index) {
               std::fill_n(&row[j * block_columns], block_columns,
                           0x1p23F + static_cast<float>(index));
             });
  }

 private:
  // Groups of `group` samples count from their own least cells.
  template <std::size_t count, class Put>
  static void set_part(const AxisPart<count>& x, const AxisPart<count>& y, int group,
                       int row_stride, int table_stride, std::int32_t* first, const Put& put) {
    const auto size = static_cast<std::size_t>(group);
    for (std::size_t begin = 0; begin < count; begin += size) {
      const int least_x = std::min(x.cell[begin], x.cell[begin + size - 1]);
      const int least_y = std::min(y.cell[begin], y.cell[begin + size - 1]);
      *first++ = least_x + table_stride * least_y;
      for (std::size_t i = begin; i < begin + size; ++i)
        put(i, x.cell[i] - least_x + row_stride * (y.cell[i] - least_y));
    }
  }
};

/// The noise and, if asked for, its slope in lattice coordinates.
struct VectorSample {
  FloatVector value, slope_x, slope_y;
};

/// The place of a lane in its cell.
struct Fractions {
  FloatVector x, y;
};

template <bool with_slope, class Picker>
HWY_INLINE VectorSample gradient_sample(Fractions t, const Picker& x, const Picker& y,
                                        SignedVector index) {
  const auto one = hn::Set(Floats(), 1.0F);
  const auto left = hn::Sub(t.x, one);
  const auto below = hn::Sub(t.y, one);
  const auto x00 = x.pick(index, 0, 0);
  const auto x10 = x.pick(index, 1, 0);
  const auto x01 = x.pick(index, 0, 1);
  const auto x11 = x.pick(index, 1, 1);
  const auto y00 = y.pick(index, 0, 0);
  const auto y10 = y.pick(index, 1, 0);
  const auto y01 = y.pick(index, 0, 1);
  const auto y11 = y.pick(index, 1, 1);
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

template <bool with_slope, class Picker>
HWY_INLINE VectorSample value_sample(Fractions t, const Picker& a, SignedVector index) {
  const auto a00 = a.pick(index, 0, 0);
  const auto a10 = a.pick(index, 1, 0);
  const auto a01 = a.pick(index, 0, 1);
  const auto a11 = a.pick(index, 1, 1);
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

/// The vector of a block whose lanes in row r are all values[r].
HWY_INLINE FloatVector each_four(const float* values) {
  alignas(64) std::array<float, HWY_MAX_BYTES / sizeof(float) + block_columns> lanes;
  for (int r = 0; r < block_rows(); ++r)
    std::fill_n(&lanes[static_cast<std::size_t>(r * block_columns)], block_columns, values[r]);
  return hn::Load(Floats(), lanes.data());
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
      : tile_(tile),
        sampler_(sampler),
        f_(sampler.parameters()),
        column_places_(sample_places<tile_columns>(tile.origin.x, tile.step, tile.column)),
        row_places_(sample_places<tile_rows>(tile.origin.y, tile.step, tile.row)) {
    sums_.total.fill(0);
    if (f_.kind == FractalKind::hybrid || f_.kind == FractalKind::ridged) sums_.w.fill(1);
    if (f_.kind != FractalKind::eroded) return;
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
    x_.column.set(column_places_, m[0][0], 0);
    x_.row.set(row_places_, m[1][0], octave.shift2.x);
    y_.column.set(column_places_, m[0][1], 0);
    y_.row.set(row_places_, m[1][1], octave.shift2.y);
    lattice_.set(x_, y_, basis, octave.key);
    const float spacing = static_cast<float>(std::abs(tile_.step)) * octave.frequency;
    const Term term{&f_, octave.amplitude, octave_weight(spacing), Mat2(m)};
    // Blocks span 3 √2 spacing, and count from up to one cell less without carry.
    if (x_.cells() <= 4 && y_.cells() <= 4)
      add_blocks<basis, kind, TilePoints>(term);
    else if (spacing < 0.23F)
      add_blocks<basis, kind, BlockPoints<false>>(term);
    else if (spacing < 0.47F)
      add_blocks<basis, kind, BlockPoints<true>>(term);
    else
      add_blocks<basis, kind, FarPoints>(term);
  }

  template <NoiseBasis basis, FractalKind kind, class Points>
  void add_blocks(const Term& term) {
    const Floats d;
    const Signeds di;
    constexpr bool with_slope = kind == FractalKind::eroded;
    const int rows = block_rows();
    const int stride = lattice_.stride;
    const int row_stride = Points::row_stride(stride);
    const Points points_x(lattice_.x.data(), stride);
    const Points points_y(lattice_.y.data(), stride);
    indices_.set(x_, y_, Points::by_block, row_stride, stride);
    std::size_t at = 0;
    for (int j = 0; j < tile_.out.height(); j += rows) {
      const auto lane = static_cast<std::size_t>(j * block_columns);
      const auto row_x = each_four(&x_.row.fraction[static_cast<std::size_t>(j)]);
      const auto row_y = each_four(&y_.row.fraction[static_cast<std::size_t>(j)]);
      const auto row_index = hn::LoadU(d, &indices_.row[lane]);
      const std::int32_t row_first =
          Points::by_block ? indices_.row_first[static_cast<std::size_t>(j / rows)] : 0;
      for (int i = 0; i < tile_.out.width(); i += block_columns, at += hn::Lanes(d)) {
        const auto ci = static_cast<std::size_t>(i);
        Fractions t{hn::Add(hn::LoadDup128(d, &x_.column.fraction[ci]), row_x),
                    hn::Add(hn::LoadDup128(d, &y_.column.fraction[ci]), row_y)};
        const Fractions carry{hn::Floor(t.x), hn::Floor(t.y)};
        t.x = hn::Sub(t.x, carry.x);
        t.y = hn::Sub(t.y, carry.y);
        auto index = hn::Add(hn::LoadDup128(d, &indices_.column[ci]), row_index);
        std::ptrdiff_t first = 0;
        if constexpr (Points::by_block)
          first = row_first + indices_.column_first[ci / block_columns];
        if constexpr (Points::with_carry) {
          const int carry_x = x_.carry(i, j, rows);
          const int carry_y = y_.carry(i, j, rows);
          first += carry_x + stride * carry_y;
          index = hn::Sub(index, hn::Set(d, static_cast<float>(carry_x + row_stride * carry_y)));
        }
        index = hn::Add(index,
                        hn::MulAdd(carry.y, hn::Set(d, static_cast<float>(row_stride)), carry.x));
        const auto corner = hn::And(hn::BitCast(di, index), hn::Set(di, 0x3fffff));
        VectorSample n;
        if constexpr (basis == NoiseBasis::value)
          n = value_sample<with_slope>(t, points_x.at(first), corner);
        else
          n = gradient_sample<with_slope>(t, points_x.at(first), points_y.at(first), corner);
        add_term<kind>(term, n, sums_, at);
      }
    }
  }

  void write() const {
    const hn::FixedTag<float, block_columns> four;
    const int rows = block_rows();
    const int width = tile_.out.width();
    const int whole = width - width % block_columns;
    const auto lanes = static_cast<std::size_t>(rows * block_columns);
    const auto blocks = static_cast<std::size_t>((width + block_columns - 1) / block_columns);
    for (int j = 0; j < tile_.out.height(); ++j) {
      const auto block_row = static_cast<std::size_t>(j / rows) * blocks * lanes;
      const float* from =
          &sums_.total[block_row + static_cast<std::size_t>(j % rows) * block_columns];
      float* to = tile_.out.row(j).data();
      for (int i = 0; i < whole; i += block_columns, from += lanes)
        hn::StoreU(hn::LoadU(four, from), four, to + i);
      std::copy_n(from, width - whole, to + whole);
    }
  }

  FractalTile tile_;
  const FractalSampler& sampler_;
  const Fractal& f_;
  std::array<double, tile_columns> column_places_;
  std::array<double, tile_rows> row_places_;
  AxisParts x_, y_;
  LatticeTable lattice_;
  CellIndices indices_;
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
