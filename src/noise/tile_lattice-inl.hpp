// What lies under a tile of samples in the turned lattice of one octave, on vectors: see
// fractal_fill.cpp. Included once per target of Highway, after foreach_target.h.

#if defined(WOLD_NOISE_TILE_LATTICE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WOLD_NOISE_TILE_LATTICE_INL
#undef WOLD_NOISE_TILE_LATTICE_INL
#else
#define WOLD_NOISE_TILE_LATTICE_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "noise/lattice-inl.hpp"
#include "noise/noise.hpp"

HWY_BEFORE_NAMESPACE();
namespace wold::HWY_NAMESPACE {
namespace {

constexpr std::size_t tile_columns = 128;
constexpr std::size_t tile_rows = 64;
constexpr std::size_t block_columns = 4;

int block_rows() {
  return std::max(1, static_cast<int>(hn::Lanes(Floats()) / block_columns));
}

/// The samples that are in use, in whole blocks.
struct TileExtent {
  std::size_t columns, rows;
};

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

  /// Of the first `used` places.
  void set(const std::array<double, count>& places, std::size_t used, double along, double shift) {
    const double first = std::floor(along * places[0] + shift);
    const double last = std::floor(along * places[used - 1] + shift);
    const double low = std::min(first, last);
    for (std::size_t i = 0; i < used; ++i) {
      const double x = along * places[i] + shift;
      const double below = std::floor(x);
      fraction[i] = std::min(static_cast<float>(x - below), below_one);
      cell[i] = static_cast<std::int32_t>(below - low);
    }
    least = static_cast<std::int64_t>(low);
    cells = static_cast<int>(std::max(first, last) - low) + 1;
    rising = places[used - 1] * along >= places[0] * along;
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
  HWY_INLINE int carry(std::size_t i, std::size_t j, std::size_t rows) const {
    const std::size_t least_i = column.rising ? i : i + block_columns - 1;
    const std::size_t least_j = row.rising ? j : j + rows - 1;
    return static_cast<int>(column.fraction[least_i] + row.fraction[least_j] >= 1.0F);
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
        const auto at = static_cast<std::size_t>(j) * static_cast<std::size_t>(stride) +
                        static_cast<std::size_t>(i);
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
  std::array<float, tile_rows> row;
  std::array<std::int32_t, tile_columns / block_columns> column_first;  // of blocks
  std::array<std::int32_t, tile_rows> row_first;

  void set(const AxisParts& x, const AxisParts& y, TileExtent used, bool by_block, int row_stride,
           int table_stride) {
    set_part(x.column, y.column, used.columns, by_block ? block_columns : used.columns, row_stride,
             table_stride, 0.0F, column.data(), column_first.data());
    set_part(x.row, y.row, used.rows, by_block ? static_cast<std::size_t>(block_rows()) : used.rows,
             row_stride, table_stride, 0x1p23F, row.data(), row_first.data());
  }

 private:
  // Groups of `group` samples count from their own least cells.
  template <std::size_t count>
  static void set_part(const AxisPart<count>& x, const AxisPart<count>& y, std::size_t used,
                       std::size_t group, int row_stride, int table_stride, float base,
                       float* index, std::int32_t* first) {
    for (std::size_t begin = 0; begin < used; begin += group) {
      const int least_x = std::min(x.cell[begin], x.cell[begin + group - 1]);
      const int least_y = std::min(y.cell[begin], y.cell[begin + group - 1]);
      *first++ = least_x + table_stride * least_y;
      const int least = least_x + row_stride * least_y;
      for (std::size_t i = begin; i < begin + group; ++i)
        index[i] = base + static_cast<float>(x.cell[i] + row_stride * y.cell[i] - least);
    }
  }
};

}  // namespace
}  // namespace wold::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
