#pragma once

#include <bit>
#include <cstdint>

namespace recoil {

/// e^x for -700 <= x <= 700 (beyond: as at the ends), to 4e-16, without branches or calls, so that loops
/// over cells vectorise. x = k ln 2 + r, |r| <= ln 2/2; e^r by its Taylor series to r^13, 2^k by its bits.
constexpr double quick_exp(double x) {
  constexpr double log2_e = 1.4426950408889634, ln2_high = 0.693147180369123816490,
                   ln2_low = 1.90821492927058770002e-10;
  constexpr double to_integer = 6755399441055744.0;  // 1.5 * 2^52: its sum with k has k in the last bits
  const double bounded = x < -700 ? -700.0 : x > 700 ? 700.0 : x;
  const double shifted = bounded * log2_e + to_integer;
  const double k = shifted - to_integer;
  const double r = (bounded - k * ln2_high) - k * ln2_low;
  double series = 1;
  for (int n = 13; n >= 1; --n) series = 1 + series * r / n;
  const std::uint64_t exponent = (std::bit_cast<std::uint64_t>(shifted) + 1023U) << 52U;
  return series * std::bit_cast<double>(exponent);
}

}  // namespace recoil
