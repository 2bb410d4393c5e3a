#include "erosion/stream_power_directions.hpp"

#include <algorithm>
#include <cmath>

#include "erosion/flow_routing.hpp"

namespace wold {

namespace {

constexpr int chunk = 256;  // samples whose state stays in the first cache
constexpr float least_cosine = 0.7F;

/// Unit vectors to the neighbours, and none for a pit.
constexpr float diagonal = 0.70710678F;
constexpr std::array<float, 9> unit_x{1, diagonal, 0, -diagonal, -1, -diagonal, 0, diagonal, 0};
constexpr std::array<float, 9> unit_y{0, diagonal, 1, diagonal, 0, -diagonal, -1, -diagonal, 0};

/// 32 random bits of a sample: an integer hash cheap in vectors (Wellons, "lowbias32", 2018).
std::uint32_t bits_of(const DirectionRow& row, int i) {
  std::uint32_t x = row.key + static_cast<std::uint32_t>(i) * 0x9e3779b9U +
                    static_cast<std::uint32_t>(row.row) * 0x85ebca6bU;
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  return x ^ (x >> 16U);
}

/// From 4 of the bits.
float chance_of(std::uint32_t bits, int d, float wandering) {
  const auto part = static_cast<int>((bits >> (4U * static_cast<unsigned>(d))) & 15U);
  return (1 - wandering / 2) + static_cast<float>(part) * (wandering / 15);
}

/// What is known of some samples so far.
struct Chunk {
  alignas(64) std::array<std::uint32_t, chunk> bits;
  alignas(64) std::array<float, chunk> steepest;
  alignas(64) std::array<int, chunk> direction;
  alignas(64) std::array<float, chunk> fall_x;
  alignas(64) std::array<float, chunk> fall_y;
};

void begin(Chunk& s, const DirectionRow& row, int first) {
  for (int c = 0; c < chunk; ++c) s.bits[static_cast<std::size_t>(c)] = bits_of(row, first + c);
  s.steepest.fill(0);
  s.direction.fill(flow_stops);
  s.fall_x.fill(0);
  s.fall_y.fill(0);
}

/// Neighbour d of `count` samples from `height` on; bits are masked, not chosen,
/// because masked stores to the same place would wait for each other.
template <bool has_nearness>
void look(Chunk& s, const float* height, const float* near, const DirectionRow& row, int d,
          int count) {
  const float* there = height + flow_step(d, row.width);
  const int dx = flow_dx[static_cast<std::size_t>(d)];
  const int dy = flow_dy[static_cast<std::size_t>(d)];
  const auto near_d = static_cast<float>(1 / flow_distance(d));
  const auto sobel_x = static_cast<float>(dx * (dy == 0 ? 2 : 1));
  const auto sobel_y = static_cast<float>(dy * (dx == 0 ? 2 : 1));
  const float wandering = row.wandering;
  for (int k = 0; k < count; ++k) {
    const auto c = static_cast<std::size_t>(k);
    const float fall = height[k] - there[k];
    const float slope =
        fall * (has_nearness ? near[k] : near_d) * chance_of(s.bits[c], d, wandering);
    const float before = s.steepest[c];
    const int mask = -static_cast<int>(slope > before);
    s.fall_x[c] += fall * sobel_x;
    s.fall_y[c] += fall * sobel_y;
    s.steepest[c] = std::max(slope, before);
    s.direction[c] = (d & mask) | (s.direction[c] & ~mask);
  }
}

}  // namespace

float slope_chance(const DirectionRow& row, int i, int d) {
  return chance_of(bits_of(row, i), d, row.wandering);
}

void find_directions(const DirectionRow& row, std::uint8_t* direction, float* cosine) {
  Chunk s;
  for (int first = 1; first < row.width - 1; first += chunk) {
    const int count = std::min(chunk, row.width - 1 - first);
    begin(s, row, first);
    for (int d = 0; d < 8; ++d) {
      const float* near = row.nearness[static_cast<std::size_t>(d)];
      if (near != nullptr)
        look<true>(s, row.height + first, near + first, row, d, count);
      else
        look<false>(s, row.height + first, nullptr, row, d, count);
    }
    for (int k = 0; k < count; ++k) {
      const auto c = static_cast<std::size_t>(k);
      const float length =
          std::sqrt(s.fall_x[c] * s.fall_x[c] + s.fall_y[c] * s.fall_y[c] + 1e-12F);
      const auto d = static_cast<std::size_t>(s.direction[c]);
      const float along = s.fall_x[c] * unit_x[d] + s.fall_y[c] * unit_y[d];
      cosine[first + k] = std::min(1.0F, std::max(least_cosine, along / length));
    }
    for (int k = 0; k < count; ++k)
      direction[first + k] = static_cast<std::uint8_t>(s.direction[static_cast<std::size_t>(k)]);
  }
}

}  // namespace wold
