#include "erosion/thermal_pass.hpp"

#include <algorithm>

namespace wold {

namespace {

using Ints = const std::int32_t*;

/// Transfers of two rows of faces, this one and the one to its south; [-1] is the column before.
struct Around {
  Ints first, second, south_first, south_second;
};

/// What cell i gives to others, as the signs of transfers through its own four faces.
struct FourOut {
  std::int32_t a, b, c, d;
};

template <bool diagonal>
FourOut outgoing(const Around& faces, int i) {
  if constexpr (diagonal)
    return {faces.first[i], faces.second[i - 1], -faces.south_first[i - 1], -faces.south_second[i]};
  else
    return {faces.first[i], faces.second[i], -faces.first[i - 1], -faces.south_second[i]};
}

template <bool diagonal>
void add_transfers(Ints from, const Around& faces, std::int32_t* __restrict to, int count) {
  for (int i = 0; i < count; ++i) {
    const FourOut out = outgoing<diagonal>(faces, i);
    to[i] = from[i] - out.a - out.b - out.c - out.d;
  }
}

bool any(Ints values, int count, std::int32_t least = 0) {
  std::int32_t most = 0;
  for (int i = 0; i < count; ++i) most = std::max({most, values[i], -values[i]});
  return most > least;
}

std::int32_t positive(std::int32_t x) {
  return std::max(x, 0);
}

/// The share of its offers that a cell can keep: 1 or, so that rounding never makes them more than
/// it holds, a little less than the quotient.
template <bool diagonal>
void offer_shares(Ints surface, Ints bed, const Around& faces, float* __restrict share, int count) {
  for (int i = 0; i < count; ++i) {
    const FourOut out = outgoing<diagonal>(faces, i);
    const std::int32_t offered =
        positive(out.a) + positive(out.b) + positive(out.c) + positive(out.d);
    const std::int32_t held = surface[i] - bed[i];
    const float quotient = static_cast<float>(held) / static_cast<float>(std::max(offered, 1));
    share[i] = std::min(1.0F, quotient * (1 - 1e-6F));
  }
}

/// `share` of what is wanted; all of it, to the last unit, if that is 1.
std::int32_t offer(std::int32_t wanted, float share) {
  const auto part = static_cast<std::int32_t>(static_cast<float>(wanted) * share);
  const std::int32_t in_part = -static_cast<std::int32_t>(share < 1);
  return (part & in_part) | (wanted & ~in_part);
}

/// The offers of the loose, held to the share of the cell that gives; or of the rock if that is
/// more.
void agree(std::int32_t* __restrict loose, Ints rock, const float* share_first,
           const float* share_second, int count) {
  for (int i = 0; i < count; ++i) {
    const std::int32_t wanted = loose[i];
    const std::int32_t down = offer(wanted, share_first[i]);
    const std::int32_t up = offer(wanted, share_second[i]);
    loose[i] = std::max({down, rock[i], 0}) + std::min({up, rock[i], 0});
  }
}

template <bool diagonal>
void add_to_layers(Ints surface, Ints bed, const Around& faces, std::int32_t* __restrict surface_to,
                   std::int32_t* __restrict bed_to, int count) {
  for (int i = 0; i < count; ++i) {
    const FourOut out = outgoing<diagonal>(faces, i);
    const std::int32_t left =
        surface[i] - positive(out.a) - positive(out.b) - positive(out.c) - positive(out.d);
    bed_to[i] = std::min(bed[i], left);
    surface_to[i] = surface[i] - out.a - out.b - out.c - out.d;
  }
}

/// A stack of rows of working memory: row j, from column `first_column` on.
template <class T>
struct Rows {
  T* data;
  int first_row, first_column, stride;
  T* at(int i, int j) const {
    return data + static_cast<std::ptrdiff_t>(j - first_row) * stride + (i - first_column);
  }
};

template <bool diagonal>
bool slide_layers_as(const SlidePass& pass, const SlideTile& tile, SlideHeights from,
                     SlideHeights bed, GridView<std::int32_t> to, GridView<std::int32_t> bed_to,
                     SlideScratch& scratch) {
  const int a = tile.i0 - 2;
  const int b = tile.i1 + 1;
  const int stride = b - a;
  const int rows = tile.j1 + 1 - (tile.j0 - 2);
  const auto area = static_cast<std::size_t>(stride) * static_cast<std::size_t>(rows);
  scratch.ints.resize(4 * area);
  scratch.floats.resize(area + slide_faces_work(stride));
  const auto ints = [&](std::size_t k) {
    return Rows<std::int32_t>{scratch.ints.data() + k * area, tile.j0 - 2, a, stride};
  };
  const Rows<std::int32_t> first = ints(0);
  const Rows<std::int32_t> second = ints(1);
  const Rows<std::int32_t> rock_first = ints(2);
  const Rows<std::int32_t> rock_second = ints(3);
  const Rows<float> share{scratch.floats.data(), tile.j0 - 2, a, stride};
  const auto around = [&](int i, int j) {
    return Around{first.at(i, j), second.at(i, j), first.at(i, j - 1), second.at(i, j - 1)};
  };
  bool moved = false;
  for (int j = tile.j0 - 2; j <= tile.j1; ++j) {
    const SlideFaces rock{rock_first.at(a, j), rock_second.at(a, j)};
    slide_faces(pass, from, j, a, b, {first.at(a, j), second.at(a, j)}, &rock,
                scratch.floats.data() + area);
    moved = moved || any(first.at(a, j), stride) || any(second.at(a, j), stride) ||
            any(rock.first, stride) || any(rock.second, stride);
  }
  for (int j = tile.j0 - 1; j <= tile.j1 && moved; ++j)
    offer_shares<diagonal>(&from(a + 1 + slide_frame, j + slide_frame),
                           &bed(a + 1 + slide_frame, j + slide_frame), around(a + 1, j),
                           share.at(a + 1, j), stride - 1);
  bool changed = false;
  const int count = tile.i1 - tile.i0;
  for (int j = tile.j0 - 1; j < tile.j1 && moved; ++j) {
    // Faces of the column before the tile and of the tile: ends within the columns of shares.
    const int i = tile.i0 - 1;
    const int first_j = j + (diagonal ? 1 : 0);
    agree(first.at(i, j), rock_first.at(i, j), share.at(i, j), share.at(i + 1, first_j), count + 1);
    const int start = diagonal ? i + 1 : i;
    agree(second.at(i, j), rock_second.at(i, j), share.at(start, j), share.at(i, j + 1), count + 1);
    changed = changed || any(first.at(i, j), count + 1, pass.least) ||
              any(second.at(i, j), count + 1, pass.least);
  }
  for (int j = tile.j0; j < tile.j1; ++j) {
    const int i = tile.i0 + slide_frame;
    const int k = j + slide_frame;
    if (changed)
      add_to_layers<diagonal>(&from(i, k), &bed(i, k), around(tile.i0, j), &to(i, k), &bed_to(i, k),
                              count);
    else {
      std::copy_n(&from(i, k), count, &to(i, k));
      std::copy_n(&bed(i, k), count, &bed_to(i, k));
    }
  }
  return changed;
}

template <bool diagonal>
bool slide_as(const SlidePass& pass, const SlideTile& tile, SlideHeights from,
              GridView<std::int32_t> to, SlideScratch& scratch) {
  const int a = tile.i0 - 1;
  const int stride = tile.i1 - a;
  const auto row_size = static_cast<std::size_t>(stride);
  scratch.ints.resize(4 * row_size);
  scratch.floats.resize(slide_faces_work(stride));
  SlideFaces south{scratch.ints.data(), scratch.ints.data() + row_size};
  SlideFaces here{south.second + row_size, south.second + 2 * row_size};
  bool moved = false;
  for (int j = tile.j0 - 1; j < tile.j1; ++j) {
    slide_faces(pass, from, j, a, tile.i1, here, nullptr, scratch.floats.data());
    moved = moved || any(here.first, stride, pass.least) || any(here.second, stride, pass.least);
    if (j >= tile.j0)
      add_transfers<diagonal>(&from(tile.i0 + slide_frame, j + slide_frame),
                              {here.first + 1, here.second + 1, south.first + 1, south.second + 1},
                              &to(tile.i0 + slide_frame, j + slide_frame), stride - 1);
    std::swap(south, here);
  }
  return moved;
}

}  // namespace

bool slide_tile(const SlidePass& pass, const SlideTile& tile, SlideHeights from,
                GridView<std::int32_t> to, SlideScratch& scratch) {
  return pass.diagonal ? slide_as<true>(pass, tile, from, to, scratch)
                       : slide_as<false>(pass, tile, from, to, scratch);
}

bool slide_layers_tile(const SlidePass& pass, const SlideTile& tile, SlideHeights from,
                       SlideHeights bed, GridView<std::int32_t> to, GridView<std::int32_t> bed_to,
                       SlideScratch& scratch) {
  return pass.diagonal ? slide_layers_as<true>(pass, tile, from, bed, to, bed_to, scratch)
                       : slide_layers_as<false>(pass, tile, from, bed, to, bed_to, scratch);
}

}  // namespace wold
