#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <string>

namespace recoil::app {

/// A number of things, of which three digits are known, for people: "17300" and not "1.73e+04"; from ten
/// millions on with a power of ten.
inline std::string count_text(double n, int digits = 3) {
  if (!(n >= 10) || n >= 1e7) return fmt::format("{:.{}g}", n, digits);
  const double unit = std::pow(10, std::floor(std::log10(n)) + 1 - digits);
  return unit > 1 ? fmt::format("{:.0f}", std::round(n / unit) * unit) : fmt::format("{:.{}g}", n, digits);
}

/// "1 case", "2 cases".
inline std::string counted(std::integral auto n, const char* one, const char* several) {
  return fmt::format("{} {}", n, n == 1 ? one : several);
}

/// The largest number of so many digits that is not above x > 0, but for round-off.
inline double rounded_down(double x, int digits) {
  const double unit = std::pow(10, std::floor(std::log10(x)) + 1 - digits);
  return std::floor(x / unit * (1 + 1e-12)) * unit;
}

}  // namespace recoil::app
