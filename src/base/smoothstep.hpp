#pragma once
// A smooth step between two values.

#include <algorithm>
#include <type_traits>

namespace wold {

/// 0 below `low`, 1 above `high`, 3t² - 2t³ between; a plain step when they are equal.
template <class Real>
constexpr Real smoothstep(std::type_identity_t<Real> low, std::type_identity_t<Real> high, Real x) {
  if (high <= low) return x < low ? Real(0) : Real(1);
  const Real t = std::clamp((x - low) / (high - low), Real(0), Real(1));
  return t * t * (Real(3) - Real(2) * t);
}

}  // namespace wold
