// Numbers of several drops at once for the walk of droplets (droplet_walk.cpp): two vectors that go
// through the same operations side by side, since a chain of operations on one leaves the units
// waiting for each result. Included once per target of Highway, after foreach_target.h.

#if defined(WOLD_DROPLET_VECTORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WOLD_DROPLET_VECTORS_INL
#undef WOLD_DROPLET_VECTORS_INL
#else
#define WOLD_DROPLET_VECTORS_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstdint>

#include "erosion/droplet_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace wold::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, droplet_group / 2>;
using Ints = hn::RebindToSigned<Floats>;

/// A vector and the next.
template <class V>
struct Two {
  V a, b;
};

using F = Two<hn::Vec<Floats>>;
using I = Two<hn::Vec<Ints>>;
using FMask = Two<hn::Mask<Floats>>;
using IMask = Two<hn::Mask<Ints>>;

/// Drops in one vector.
constexpr int vector_drops = static_cast<int>(hn::MaxLanes(Floats()));

HWY_INLINE F number(float x) {
  return {hn::Set(Floats(), x), hn::Set(Floats(), x)};
}
HWY_INLINE I whole(std::int32_t x) {
  return {hn::Set(Ints(), x), hn::Set(Ints(), x)};
}
HWY_INLINE F load(const float* from) {
  return {hn::Load(Floats(), from), hn::Load(Floats(), from + vector_drops)};
}
HWY_INLINE I load(const std::int32_t* from) {
  return {hn::Load(Ints(), from), hn::Load(Ints(), from + vector_drops)};
}
HWY_INLINE void store(F x, float* to) {
  hn::Store(x.a, Floats(), to);
  hn::Store(x.b, Floats(), to + vector_drops);
}
HWY_INLINE void store(I x, std::int32_t* to) {
  hn::Store(x.a, Ints(), to);
  hn::Store(x.b, Ints(), to + vector_drops);
}

template <class V>
HWY_INLINE Two<V> operator+(Two<V> x, Two<V> y) {
  return {hn::Add(x.a, y.a), hn::Add(x.b, y.b)};
}
template <class V>
HWY_INLINE Two<V> operator-(Two<V> x, Two<V> y) {
  return {hn::Sub(x.a, y.a), hn::Sub(x.b, y.b)};
}
template <class V>
HWY_INLINE Two<V> operator*(Two<V> x, Two<V> y) {
  return {hn::Mul(x.a, y.a), hn::Mul(x.b, y.b)};
}
template <class V>
HWY_INLINE Two<V> operator^(Two<V> x, Two<V> y) {
  return {hn::Xor(x.a, y.a), hn::Xor(x.b, y.b)};
}
HWY_INLINE F operator/(F x, F y) {
  return {hn::Div(x.a, y.a), hn::Div(x.b, y.b)};
}
HWY_INLINE F operator-(F x) {
  return {hn::Neg(x.a), hn::Neg(x.b)};
}
/// x y + z
HWY_INLINE F mul_add(F x, F y, F z) {
  return {hn::MulAdd(x.a, y.a, z.a), hn::MulAdd(x.b, y.b, z.b)};
}
/// z - x y
HWY_INLINE F neg_mul_add(F x, F y, F z) {
  return {hn::NegMulAdd(x.a, y.a, z.a), hn::NegMulAdd(x.b, y.b, z.b)};
}
template <class V>
HWY_INLINE Two<V> min(Two<V> x, Two<V> y) {
  return {hn::Min(x.a, y.a), hn::Min(x.b, y.b)};
}
template <class V>
HWY_INLINE Two<V> max(Two<V> x, Two<V> y) {
  return {hn::Max(x.a, y.a), hn::Max(x.b, y.b)};
}
HWY_INLINE F abs(F x) {
  return {hn::Abs(x.a), hn::Abs(x.b)};
}
HWY_INLINE F sqrt(F x) {
  return {hn::Sqrt(x.a), hn::Sqrt(x.b)};
}
HWY_INLINE F floor(F x) {
  return {hn::Floor(x.a), hn::Floor(x.b)};
}
template <int bits>
HWY_INLINE I shift_right(I x) {
  return {hn::ShiftRight<bits>(x.a), hn::ShiftRight<bits>(x.b)};
}

HWY_INLINE F real(I x) {
  return {hn::ConvertTo(Floats(), x.a), hn::ConvertTo(Floats(), x.b)};
}
HWY_INLINE I bits_of(F x) {
  return {hn::BitCast(Ints(), x.a), hn::BitCast(Ints(), x.b)};
}
// Integers from numbers below 2^30 in size: without what Highway does for larger ones.

HWY_INLINE hn::Vec<Ints> truncated(hn::Vec<Floats> x) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  return hn::Vec<Ints>{_mm512_cvttps_epi32(x.raw)};
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  return hn::Vec<Ints>{_mm256_cvttps_epi32(x.raw)};
#else
  return hn::ConvertTo(Ints(), x);
#endif
}
HWY_INLINE hn::Vec<Ints> nearest(hn::Vec<Floats> x) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  return hn::Vec<Ints>{_mm512_cvtps_epi32(x.raw)};
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  return hn::Vec<Ints>{_mm256_cvtps_epi32(x.raw)};
#else
  return hn::NearestInt(x);
#endif
}
HWY_INLINE I truncated(F x) {
  return {truncated(x.a), truncated(x.b)};
}
HWY_INLINE I nearest(F x) {
  return {nearest(x.a), nearest(x.b)};
}

HWY_INLINE FMask operator<(F x, F y) {
  return {hn::Lt(x.a, y.a), hn::Lt(x.b, y.b)};
}
HWY_INLINE FMask operator<=(F x, F y) {
  return {hn::Le(x.a, y.a), hn::Le(x.b, y.b)};
}
HWY_INLINE FMask operator>(F x, F y) {
  return y < x;
}
HWY_INLINE FMask operator>=(F x, F y) {
  return y <= x;
}
HWY_INLINE FMask operator==(F x, F y) {
  return {hn::Eq(x.a, y.a), hn::Eq(x.b, y.b)};
}
HWY_INLINE FMask operator&(FMask x, FMask y) {
  return {hn::And(x.a, y.a), hn::And(x.b, y.b)};
}
HWY_INLINE FMask operator|(FMask x, FMask y) {
  return {hn::Or(x.a, y.a), hn::Or(x.b, y.b)};
}
HWY_INLINE FMask operator!(FMask x) {
  return {hn::Not(x.a), hn::Not(x.b)};
}
HWY_INLINE FMask positive(I x) {
  const Ints i;
  return {hn::RebindMask(Floats(), hn::Gt(x.a, hn::Zero(i))),
          hn::RebindMask(Floats(), hn::Gt(x.b, hn::Zero(i)))};
}
HWY_INLINE IMask for_ints(FMask x) {
  return {hn::RebindMask(Ints(), x.a), hn::RebindMask(Ints(), x.b)};
}
template <class M, class V>
HWY_INLINE Two<V> choose(Two<M> where, Two<V> x, Two<V> otherwise) {
  return {hn::IfThenElse(where.a, x.a, otherwise.a), hn::IfThenElse(where.b, x.b, otherwise.b)};
}
template <class M, class V>
HWY_INLINE Two<V> only(Two<M> where, Two<V> x) {
  return {hn::IfThenElseZero(where.a, x.a), hn::IfThenElseZero(where.b, x.b)};
}

/// One bit per drop, the first lowest.
HWY_INLINE std::uint32_t bits_of(FMask mask) {
  std::array<std::uint8_t, 8> a{};
  std::array<std::uint8_t, 8> b{};
  hn::StoreMaskBits(Floats(), mask.a, a.data());
  hn::StoreMaskBits(Floats(), mask.b, b.data());
  const auto low = static_cast<std::uint32_t>(a[0] | a[1] << 8U);
  const auto high = static_cast<std::uint32_t>(b[0] | b[1] << 8U);
  return low | high << static_cast<unsigned>(vector_drops);
}

// Heights of the four samples under a drop lie together in a block of 16 bytes, where drop 4 b + j
// of a vector has block b of the vector's j-th part: so that they are sorted into lanes within
// blocks. What a drop changes at one of the four is a word of 8 bytes; drops 4 b + j and
// 4 b + j + 1 have block b of the vector's part j / 2.

/// Where the block of a drop of the group begins.
constexpr std::size_t block_of(std::size_t drop) {
  constexpr std::size_t lanes = vector_drops;
  return 4 * (drop / lanes * lanes) + drop % 4 * lanes + drop % lanes / 4 * 4;
}

/// Which word is a drop's.
constexpr std::size_t word_of(std::size_t drop) {
  constexpr std::size_t lanes = vector_drops;
  return drop / lanes * lanes + drop % 4 / 2 * (lanes / 2) + drop % lanes / 4 * 2 + drop % 2;
}

struct Four {
  I a, b, c, d;
};

struct FourOfVector {
  hn::Vec<Ints> a, b, c, d;
};

HWY_INLINE FourOfVector load_blocks(const std::int32_t* blocks) {
  const Ints i;
  const hn::Repartition<std::int64_t, Ints> pairs;
  const auto a = hn::Load(i, blocks);
  const auto b = hn::Load(i, blocks + vector_drops);
  const auto c = hn::Load(i, blocks + 2 * vector_drops);
  const auto d = hn::Load(i, blocks + 3 * vector_drops);
  const auto low_ab = hn::BitCast(pairs, hn::InterleaveLower(i, a, b));
  const auto low_cd = hn::BitCast(pairs, hn::InterleaveLower(i, c, d));
  const auto high_ab = hn::BitCast(pairs, hn::InterleaveUpper(i, a, b));
  const auto high_cd = hn::BitCast(pairs, hn::InterleaveUpper(i, c, d));
  return {hn::BitCast(i, hn::InterleaveLower(pairs, low_ab, low_cd)),
          hn::BitCast(i, hn::InterleaveUpper(pairs, low_ab, low_cd)),
          hn::BitCast(i, hn::InterleaveLower(pairs, high_ab, high_cd)),
          hn::BitCast(i, hn::InterleaveUpper(pairs, high_ab, high_cd))};
}

/// Those of two vectors of drops from the k-th of the group.
HWY_INLINE Four load_blocks(const DropletBlocks& blocks, int k) {
  const std::int32_t* first = &blocks[4 * static_cast<std::size_t>(k)];
  const FourOfVector u = load_blocks(first);
  const FourOfVector v = load_blocks(first + 4 * vector_drops);
  return {{u.a, v.a}, {u.b, v.b}, {u.c, v.c}, {u.d, v.d}};
}

HWY_INLINE void store_words(hn::Vec<Ints> low, hn::Vec<Ints> high, std::uint64_t* to) {
  const Ints i;
  const hn::Repartition<std::uint64_t, Ints> words;
  hn::Store(hn::BitCast(words, hn::InterleaveLower(i, low, high)), words, to);
  hn::Store(hn::BitCast(words, hn::InterleaveUpper(i, low, high)), words, to + vector_drops / 2);
}

/// Words of two vectors of drops from the k-th of the group.
HWY_INLINE void store_words(I low, I high, DropletWords& words, int k) {
  std::uint64_t* first = &words[static_cast<std::size_t>(k)];
  store_words(low.a, high.a, first);
  store_words(low.b, high.b, first + vector_drops);
}

}  // namespace
}  // namespace wold::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
