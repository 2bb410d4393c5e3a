// The lattice hash, gradients, values and the fade of lattice.hpp and noise_cell.hpp on vectors,
// for Highway's targets: included once per target, after foreach_target.h.

#if defined(WOLD_NOISE_LATTICE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WOLD_NOISE_LATTICE_INL
#undef WOLD_NOISE_LATTICE_INL
#else
#define WOLD_NOISE_LATTICE_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstdint>

#include "noise/lattice.hpp"

HWY_BEFORE_NAMESPACE();
namespace wold::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Unsigneds = hn::RebindToUnsigned<Floats>;
using Signeds = hn::RebindToSigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using UnsignedVector = hn::Vec<Unsigneds>;
using SignedVector = hn::Vec<Signeds>;

HWY_INLINE UnsignedVector mix_bits32(UnsignedVector h) {
  const Unsigneds d;
  h = hn::Xor(h, hn::ShiftRight<16>(h));
  h = hn::Mul(h, hn::Set(d, 0x21f0aaadU));
  h = hn::Xor(h, hn::ShiftRight<15>(h));
  h = hn::Mul(h, hn::Set(d, 0xd35a2d97U));
  return hn::Xor(h, hn::ShiftRight<15>(h));
}

HWY_INLINE UnsignedVector lattice_hash(UnsignedVector x, std::uint32_t row) {
  const Unsigneds d;
  const auto column = hn::Mul(x, hn::Set(d, lattice_x_factor));
  return HWY_NAMESPACE::mix_bits32(hn::Xor(column, hn::Set(d, row)));
}

/// One of four floats per lane, by the two bits above bit 28 of the hash.
HWY_INLINE FloatVector direction(const std::array<float, 4>& table, UnsignedVector hash) {
  const Floats d;
  const auto index =
      hn::BitCast(Signeds(), hn::And(hn::ShiftRight<28>(hash), hn::Set(Unsigneds(), 3U)));
#if HWY_TARGET == HWY_SCALAR
  return hn::GatherIndex(d, table.data(), index);
#else
  return hn::TableLookupLanes(hn::LoadDup128(d, table.data()), hn::IndicesFromVec(d, index));
#endif
}

alignas(16) inline constexpr std::array<float, 4> scaled_quadrant_x{
    detail::gradients2[0].x, detail::gradients2[1].x, detail::gradients2[2].x,
    detail::gradients2[3].x};
alignas(16) inline constexpr std::array<float, 4> scaled_quadrant_y{
    detail::gradients2[0].y, detail::gradients2[1].y, detail::gradients2[2].y,
    detail::gradients2[3].y};

HWY_INLINE void lattice_gradient2(UnsignedVector hash, FloatVector& x, FloatVector& y) {
  const Floats d;
  const auto sign = hn::Set(Unsigneds(), 0x80000000U);
  x = hn::Xor(direction(scaled_quadrant_x, hash), hn::BitCast(d, hn::And(hash, sign)));
  y = hn::Xor(direction(scaled_quadrant_y, hash),
              hn::BitCast(d, hn::And(hn::ShiftLeft<1>(hash), sign)));
}

HWY_INLINE FloatVector lattice_value(UnsignedVector hash) {
  const Floats d;
  return hn::Mul(hn::ConvertTo(d, hn::BitCast(Signeds(), hash)), hn::Set(d, lattice_value_scale));
}

HWY_INLINE FloatVector fade(FloatVector t) {
  const Floats d;
  const auto inner = hn::MulAdd(t, hn::Set(d, 6.0F), hn::Set(d, -15.0F));
  return hn::Mul(hn::Mul(hn::Mul(t, t), t), hn::MulAdd(t, inner, hn::Set(d, 10.0F)));
}
HWY_INLINE FloatVector fade_slope(FloatVector t) {
  const Floats d;
  const auto a = hn::NegMulAdd(t, t, t);
  return hn::Mul(hn::Mul(a, a), hn::Set(d, 30.0F));
}
HWY_INLINE FloatVector lerp(FloatVector a, FloatVector b, FloatVector t) {
  return hn::MulAdd(t, hn::Sub(b, a), a);
}

}  // namespace wold::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
