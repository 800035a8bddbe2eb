#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace recoil {

/// Equivalent stress squared, 3/2 S:S [Pa^2].
template <int Dim>
double equivalent_stress_squared(const double* s, std::size_t stride) {
  const auto at = [&](int c) { return s[static_cast<std::size_t>(c) * stride]; };
  if constexpr (Dim == 1) {
    return 2.25 * at(0) * at(0);
  } else {
    const double zz = at(0) + at(1);
    double shear = at(2) * at(2);
    if constexpr (Dim == 3) shear += at(3) * at(3) + at(4) * at(4);
    return 1.5 * (at(0) * at(0) + at(1) * at(1) + zz * zz + 2 * shear);
  }
}

/// The largest principal value of a stress deviator [Pa], tension positive: O. K. Smith, Comm. ACM 4 (1961)
/// 168.
template <int Dim>
double largest_principal_deviator(const double* s, std::size_t stride) {
  const auto at = [&](int c) { return s[static_cast<std::size_t>(c) * stride]; };
  if constexpr (Dim == 1) {
    return std::max(at(0), -0.5 * at(0));
  } else if constexpr (Dim == 2) {
    const double mean = 0.5 * (at(0) + at(1));
    return std::max(mean + std::hypot(0.5 * (at(0) - at(1)), at(2)), -2 * mean);
  } else {
    const double xx = at(0), yy = at(1), zz = -(xx + yy), xy = at(2), xz = at(3), yz = at(4);
    const double j2 = equivalent_stress_squared<3>(s, stride) / 3;
    if (!(j2 > 0)) return 0;
    const double j3 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    const double cosine = std::clamp(1.5 * std::numbers::sqrt3 * j3 / (j2 * std::sqrt(j2)), -1.0, 1.0);
    return 2 * std::sqrt(j2 / 3) * std::cos(std::acos(cosine) / 3);
  }
}

}  // namespace recoil
