// Fractals over a grid, by tiles of 128 × 64 samples.
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

#include "noise/tile_lattice-inl.hpp"
#include "noise/tile_sum-inl.hpp"

#ifndef WOLD_FRACTAL_FILL_TILE
#define WOLD_FRACTAL_FILL_TILE
namespace wold {
namespace {

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

/// An octave under a tile.
struct TileOctave {
  enum class Points { tile, block, block_with_carry, far };

  explicit TileOctave(const Term& t) : term(t) {}

  AxisParts x, y;
  LatticeTable lattice;
  CellIndices indices;
  Term term;
  Points points = Points::far;
};

class FractalTileFill {
 public:
  FractalTileFill(const FractalTile& tile, const FractalSampler& sampler)
      : tile_(tile), f_(sampler.parameters()), used_(whole_blocks(tile.out)) {
    const auto columns = sample_places<tile_columns>(tile.origin.x, tile.step, tile.column);
    const auto rows = sample_places<tile_rows>(tile.origin.y, tile.step, tile.row);
    octaves_.reserve(static_cast<std::size_t>(tile.octaves));
    for (int i = 0; i < tile.octaves; ++i) {
      const FractalSampler::Octave& from = sampler.octave(i);
      const float spacing = static_cast<float>(std::abs(tile.step)) * from.frequency;
      TileOctave& octave = octaves_.emplace_back(Term(f_, from, octave_weight(spacing)));
      const DMat2& m = from.matrix2;
      octave.x.column.set(columns, used_.columns, m[0][0], 0);
      octave.x.row.set(rows, used_.rows, m[1][0], from.shift2.x);
      octave.y.column.set(columns, used_.columns, m[0][1], 0);
      octave.y.row.set(rows, used_.rows, m[1][1], from.shift2.y);
      octave.lattice.set(octave.x, octave.y, f_.basis, from.key);
      choose_points(octave, m);
    }
  }

  void fill() {
    const auto height = static_cast<std::size_t>(tile_.out.height());
    for (std::size_t row = 0; row < height; row += strip_rows) {
      const std::size_t end = std::min(row + strip_rows, height);
      clear();
      if (f_.basis == NoiseBasis::gradient)
        add_octaves<NoiseBasis::gradient>(row, end);
      else
        add_octaves<NoiseBasis::value>(row, end);
      write(row, end);
    }
  }

 private:
  static TileExtent whole_blocks(const GridView<float>& out) {
    const auto up = [](int count, std::size_t unit) {
      return (static_cast<std::size_t>(count) + unit - 1) / unit * unit;
    };
    return {up(out.width(), block_columns),
            up(out.height(), static_cast<std::size_t>(block_rows()))};
  }

  // A block spans `span` cells along an axis. Its lanes count cells from the sum of the least cells
  // by column and by row: up to ⌈span⌉ of them, and one more for the carry unless that is taken
  // out. Four points serve three cells.
  void choose_points(TileOctave& octave, const DMat2& m) const {
    using Points = TileOctave::Points;
    const double rows = block_rows() - 1;
    const double columns = block_columns - 1;
    const double span =
        std::abs(tile_.step) * std::max(columns * std::abs(m[0][0]) + rows * std::abs(m[1][0]),
                                        columns * std::abs(m[0][1]) + rows * std::abs(m[1][1]));
    constexpr double margin = 1e-3;
    if (octave.x.cells() <= 4 && octave.y.cells() <= 4)
      octave.points = Points::tile;
    else if (span < 1 - margin)
      octave.points = Points::block;
    else if (span < 2 - margin)
      octave.points = Points::block_with_carry;
    const bool by_block =
        octave.points == Points::block || octave.points == Points::block_with_carry;
    const int stride = octave.lattice.stride;
    octave.indices.set(octave.x, octave.y, used_, by_block,
                       octave.points == Points::far ? stride : 4, stride);
  }

  void clear() {
    sums_.total.fill(0);
    if (f_.kind == FractalKind::hybrid || f_.kind == FractalKind::ridged) sums_.w.fill(1);
    if (f_.kind != FractalKind::eroded) return;
    sums_.slope_x.fill(0);
    sums_.slope_y.fill(0);
  }

  template <NoiseBasis basis>
  void add_octaves(std::size_t row, std::size_t end) {
    for (const TileOctave& octave : octaves_) {
      switch (f_.kind) {
        case FractalKind::fbm: add_octave<basis, FractalKind::fbm>(octave, row, end); break;
        case FractalKind::hybrid: add_octave<basis, FractalKind::hybrid>(octave, row, end); break;
        case FractalKind::ridged: add_octave<basis, FractalKind::ridged>(octave, row, end); break;
        case FractalKind::turbulence:
          add_octave<basis, FractalKind::turbulence>(octave, row, end);
          break;
        case FractalKind::eroded: add_octave<basis, FractalKind::eroded>(octave, row, end); break;
      }
    }
  }

  template <NoiseBasis basis, FractalKind kind>
  void add_octave(const TileOctave& octave, std::size_t row, std::size_t end) {
    switch (octave.points) {
      case TileOctave::Points::tile: add_blocks<basis, kind, TilePoints>(octave, row, end); break;
      case TileOctave::Points::block:
        add_blocks<basis, kind, BlockPoints<false>>(octave, row, end);
        break;
      case TileOctave::Points::block_with_carry:
        add_blocks<basis, kind, BlockPoints<true>>(octave, row, end);
        break;
      case TileOctave::Points::far: add_blocks<basis, kind, FarPoints>(octave, row, end); break;
    }
  }

  template <NoiseBasis basis, FractalKind kind, class Points>
  void add_blocks(const TileOctave& octave, std::size_t row, std::size_t end) {
    const Floats d;
    const auto rows = static_cast<std::size_t>(block_rows());
    const Term term = octave.term;  // of our own: the stores below cannot alter it
    const int stride = octave.lattice.stride;
    const float row_stride = static_cast<float>(Points::row_stride(stride));
    const Points points_x(octave.lattice.x.data(), stride);
    const Points points_y(octave.lattice.y.data(), stride);
    std::size_t at = 0;
    for (std::size_t j = row; j < end; j += rows) {
      const Fractions row_place{each_four(&octave.x.row.fraction[j]),
                                each_four(&octave.y.row.fraction[j])};
      const auto row_index = each_four(&octave.indices.row[j]);
      const std::int32_t row_first = Points::by_block ? octave.indices.row_first[j / rows] : 0;
      for (std::size_t i = 0; i < used_.columns; i += block_columns, at += hn::Lanes(d)) {
        Fractions t{hn::Add(hn::LoadDup128(d, &octave.x.column.fraction[i]), row_place.x),
                    hn::Add(hn::LoadDup128(d, &octave.y.column.fraction[i]), row_place.y)};
        const Fractions carry{hn::Floor(t.x), hn::Floor(t.y)};
        t.x = hn::Sub(t.x, carry.x);
        t.y = hn::Sub(t.y, carry.y);
        auto index = hn::Add(hn::LoadDup128(d, &octave.indices.column[i]), row_index);
        std::ptrdiff_t first = 0;
        if constexpr (Points::by_block)
          first = row_first + octave.indices.column_first[i / block_columns];
        if constexpr (Points::with_carry) {
          const int carry_x = octave.x.carry(i, j, rows);
          const int carry_y = octave.y.carry(i, j, rows);
          first += carry_x + stride * carry_y;
          index = hn::Sub(index, hn::Set(d, static_cast<float>(carry_x + 4 * carry_y)));
        }
        index = hn::Add(index, hn::MulAdd(carry.y, hn::Set(d, row_stride), carry.x));
        const auto corner = hn::And(hn::BitCast(Signeds(), index), hn::Set(Signeds(), 0x3fffff));
        constexpr bool with_slope = kind == FractalKind::eroded;
        VectorSample n;
        if constexpr (basis == NoiseBasis::value)
          n = value_sample<with_slope>(t, points_x.at(first), corner);
        else
          n = gradient_sample<with_slope>(t, points_x.at(first), points_y.at(first), corner);
        add_term<kind>(term, n, sums_, at);
      }
    }
  }

  // From blocks to rows.
  void write(std::size_t row, std::size_t end) const {
    const hn::FixedTag<float, block_columns> four;
    const auto rows = static_cast<std::size_t>(block_rows());
    const auto width = static_cast<std::size_t>(tile_.out.width());
    const std::size_t whole = width - width % block_columns;
    for (std::size_t j = row; j < end; ++j) {
      const std::size_t block_row = (j - row) / rows * rows * used_.columns;
      const float* from = &sums_.total[block_row + (j - row) % rows * block_columns];
      float* to = tile_.out.row(static_cast<int>(j)).data();
      for (std::size_t i = 0; i < whole; i += block_columns, from += rows * block_columns)
        hn::StoreU(hn::LoadU(four, from), four, to + i);
      std::copy_n(from, width - whole, to + whole);
    }
  }

  FractalTile tile_;
  const Fractal& f_;
  TileExtent used_;
  std::vector<TileOctave> octaves_;
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
  constexpr int tile_width = 128;
  constexpr int tile_height = 64;
  const int across = (out.width() + tile_width - 1) / tile_width;
  const int up = (out.height() + tile_height - 1) / tile_height;
  const ProgressStage stage(progress, "fractal", static_cast<double>(out.width()) * out.height(),
                            "samples");
  parallel_for(0, across * up, [&](int task) {
    progress.check();
    const int column = task % across * tile_width;
    const int row = task / across * tile_height;
    const int width = std::min(tile_width, out.width() - column);
    const int height = std::min(tile_height, out.height() - row);
    HWY_DYNAMIC_DISPATCH(fill_fractal_tile)
    ({out.sub(column, row, width, height), column, row, origin, step, octaves}, sampler);
    progress.advance(static_cast<double>(width) * height);
  });
}

}  // namespace wold
#endif
