#pragma once

#include <bit>
#include <cstdint>

namespace recoil {

/// e^r for |r| <= ln 2/2 by its Taylor series to r^13, in pairs of pairs (Estrin): five products behind one
/// another, where Horner's rule has thirteen.
constexpr double exp_of_remainder(double r) {
  constexpr double c2 = 0.5, c3 = 1 / 6.0, c4 = 1 / 24.0, c5 = 1 / 120.0, c6 = 1 / 720.0, c7 = 1 / 5040.0,
                   c8 = 1 / 40320.0, c9 = 1 / 362880.0, c10 = 1 / 3628800.0, c11 = 1 / 39916800.0,
                   c12 = 1 / 479001600.0, c13 = 1 / 6227020800.0;
  const double r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const double middle = (c4 + r * c5) + r2 * (c6 + r * c7);
  const double high = ((c8 + r * c9) + r2 * (c10 + r * c11)) + r4 * (c12 + r * c13);
  return 1 + (r + (r2 * (c2 + r * c3) + (r4 * middle + r8 * high)));
}

/// e^x for -700 <= x <= 700 (beyond: as at the ends), to 2e-16, without branches, divisions or calls, so that
/// loops over cells vectorise. x = k ln 2 + r, |r| <= ln 2/2; 2^k by its bits.
constexpr double quick_exp(double x) {
  constexpr double log2_e = 1.4426950408889634, ln2_high = 0.693147180369123816490,
                   ln2_low = 1.90821492927058770002e-10;
  constexpr double to_integer = 6755399441055744.0;  // 1.5 * 2^52: its sum with k has k in the last bits
  const double bounded = x < -700 ? -700.0 : x > 700 ? 700.0 : x;
  const double shifted = bounded * log2_e + to_integer;
  const double k = shifted - to_integer;
  const double r = (bounded - k * ln2_high) - k * ln2_low;
  const std::uint64_t exponent = (std::bit_cast<std::uint64_t>(shifted) + 1023U) << 52U;
  return exp_of_remainder(r) * std::bit_cast<double>(exponent);
}

}  // namespace recoil
