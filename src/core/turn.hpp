#pragma once

#include <cmath>

#include "core/vec.hpp"

namespace recoil {

/// a x b in space.
constexpr Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// v turned by an angle [rad] about an axis of length 1 through the origin (Rodrigues' formula).
inline Vec<3> turned(const Vec<3>& v, const Vec<3>& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

}  // namespace recoil
