#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace recoil {

namespace detail {

/// 1 + f(1) + f(1) f(2) + ... to rounding, for a sum near 1: f(k) is a term over the one before it.
template <class Factor>
[[gnu::always_inline]] inline double sum_of_powers(Factor&& factor) {
  constexpr int most = 12;
  constexpr double negligible = 1e-17;
  double term = 1, sum = 1;
  for (int k = 1; k <= most; ++k) {
    term *= factor(k);
    sum += term;
    if (!(std::fabs(term) > negligible)) break;
  }
  return sum;
}

inline constexpr std::array<double, 13> reciprocals{0,        1.0,      1.0 / 2, 1.0 / 3, 1.0 / 4,
                                                    1.0 / 5,  1.0 / 6,  1.0 / 7, 1.0 / 8, 1.0 / 9,
                                                    1.0 / 10, 1.0 / 11, 1.0 / 12};

}  // namespace detail

/// exp(x); where |x| is at most 0.01 by its series, which is faster and exact to rounding.
inline double exp_of_small(double x) {
  if (!(std::fabs(x) <= 0.01)) return std::exp(x);
  return detail::sum_of_powers([x](int k) { return x * detail::reciprocals[static_cast<std::size_t>(k)]; });
}

/// (1 + x)^n for 0 <= x <= 0.01, to rounding, by its series.
inline double power_near_one(double x, double n) {
  return detail::sum_of_powers(
      [x, n](int k) { return (n - (k - 1)) * detail::reciprocals[static_cast<std::size_t>(k)] * x; });
}

}  // namespace recoil
