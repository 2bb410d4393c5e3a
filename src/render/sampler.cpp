#include "render/sampler.hpp"

#include "base/hash.hpp"

namespace wold {

namespace {

std::uint32_t reversed_bits(std::uint32_t x) {
  x = (x << 16U) | (x >> 16U);
  x = ((x & 0x00ff00ffU) << 8U) | ((x & 0xff00ff00U) >> 8U);
  x = ((x & 0x0f0f0f0fU) << 4U) | ((x & 0xf0f0f0f0U) >> 4U);
  x = ((x & 0x33333333U) << 2U) | ((x & 0xccccccccU) >> 2U);
  return ((x & 0x55555555U) << 1U) | ((x & 0xaaaaaaaaU) >> 1U);
}

// Each bit is changed by hashes of the bits below it only: an Owen scramble of the reversed digits.
std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16U) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

std::uint32_t mixed(std::uint32_t x) {
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  x ^= x >> 16U;
  return x;
}

float to_unit(std::uint32_t x) {
  return static_cast<float>(x >> 8U) * 0x1p-24F;
}

}  // namespace

SobolPoint sobol_point(std::uint32_t index) {
  // The generator matrix of the second dimension is Pascal's triangle modulo 2, a Kronecker power
  // of [1 1; 0 1], so it is applied in five steps instead of 32.
  std::uint32_t y = index;
  y ^= (y & 0xffff0000U) >> 16U;
  y ^= (y & 0xff00ff00U) >> 8U;
  y ^= (y & 0xf0f0f0f0U) >> 4U;
  y ^= (y & 0xccccccccU) >> 2U;
  y ^= (y & 0xaaaaaaaaU) >> 1U;
  return {reversed_bits(index), reversed_bits(y)};
}

std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  return reversed_bits(laine_karras(reversed_bits(x), seed));
}

Sampler::Sampler(std::uint64_t seed, int pixel_x, int pixel_y, std::uint32_t index)
    : pixel_seed_(static_cast<std::uint32_t>(random_bits(seed, pixel_x, pixel_y))), index_(index) {}

Vec2 Sampler::next() {
  const std::uint32_t seed = mixed(pixel_seed_ ^ (pair_ * 0x9e3779b9U));
  ++pair_;
  // Scrambling the index shuffles the order of points and keeps every aligned power-of-two block
  // together.
  const std::uint32_t index = reversed_bits(laine_karras(reversed_bits(index_), seed));
  const SobolPoint p = sobol_point(index);
  return {to_unit(owen_scramble(p.x, mixed(seed ^ 0x68bc21ebU))),
          to_unit(owen_scramble(p.y, mixed(seed ^ 0x02e5be93U)))};
}

}  // namespace wold
