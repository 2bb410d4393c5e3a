#pragma once
// Counter-based random numbers: every random value is a hash of what it is for, never the next of
// a sequence, so results do not depend on threads, tiles or order.
//
//   uniform(random_bits(seed, Purpose::scatter, cell_x, cell_y, which))
//
// The mixer is the finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom
// number generators", OOPSLA 2014, with the constants of Stafford's variant 13).

#include <cstdint>
#include <type_traits>

namespace wold {

/// Mixes all 64 bits; a bijection.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x ^= x >> 30U;
  x *= 0xbf58476d1ce4e5b9U;
  x ^= x >> 27U;
  x *= 0x94d049bb133111ebU;
  x ^= x >> 31U;
  return x;
}

/// 64 random bits that belong to the given key. The parts are integers or enumerators; their order
/// matters, and negative numbers are as good as positive ones.
template <class... Parts>
constexpr std::uint64_t random_bits(std::uint64_t seed, Parts... parts) {
  static_assert(((std::is_integral_v<Parts> || std::is_enum_v<Parts>)&&...),
                "random keys are integers or enumerators");
  constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15U;
  std::uint64_t h = mix_bits(seed + golden_ratio);
  ((h = mix_bits((h ^ static_cast<std::uint64_t>(parts)) * 5U + golden_ratio)), ...);
  return h;
}

/// Uniform in [0, 1), from the upper 24 bits.
constexpr float uniform(std::uint64_t bits) {
  return static_cast<float>(bits >> 40U) * 0x1p-24F;
}

/// Uniform in [0, 1), from the upper 53 bits.
constexpr double uniform_double(std::uint64_t bits) {
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

/// Hash of a name, to give every named thing (a species, a step) random numbers of its own.
/// FNV-1a followed by the mixer.
template <class Text>
constexpr std::uint64_t hash_text(const Text& text) {
  std::uint64_t h = 0xcbf29ce484222325U;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return mix_bits(h);
}

}  // namespace wold
