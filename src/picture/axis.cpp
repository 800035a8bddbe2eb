#include "picture/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace recoil {
namespace {

/// The typographical minus instead of the hyphen.
std::string with_minus(const std::string& number) {
  return number.starts_with('-') ? "\u2212" + number.substr(1) : number;
}

Ticks decade_ticks(const AxisScale& scale, int wanted) {
  Ticks ticks;
  const int first = static_cast<int>(std::floor(std::log10(scale.lo)));
  const int last = static_cast<int>(std::ceil(std::log10(scale.hi)));
  const int stride = std::max(1, (last - first) / std::max(wanted, 1));
  const bool few = std::log10(scale.hi / scale.lo) < 1.7;  // label 2 and 5 as well
  const double slack = 1e-9;
  for (int decade = first; decade <= last; ++decade)
    for (int m = 1; m <= 9; ++m) {
      const double value = m * std::pow(10.0, decade);
      if (value < scale.lo * (1 - slack) || value > scale.hi * (1 + slack)) continue;
      if (m == 1 && (decade - first) % stride == 0) {
        ticks.at.push_back(value);
        const bool plain = decade >= -3 && decade <= 3;
        ticks.labels.push_back(plain ? fmt::format("{:g}", value)
                                     : fmt::format("10^{{{}}}", with_minus(std::to_string(decade))));
      } else if (few && (m == 2 || m == 5)) {
        ticks.at.push_back(value);
        const bool plain = decade >= -3 && decade <= 3;
        ticks.labels.push_back(plain ? fmt::format("{:g}", value)
                                     : fmt::format("{}·10^{{{}}}", m, with_minus(std::to_string(decade))));
      } else {
        ticks.minor.push_back(value);
      }
    }
  return ticks;
}

double nice_step(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

}  // namespace

double AxisScale::fraction(double value) const {
  if (!log) return (value - lo) / (hi - lo);
  if (!(value > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::log(value / lo) / std::log(hi / lo);
}

Ticks nice_ticks(const AxisScale& scale, int wanted) {
  if (scale.log) return decade_ticks(scale, wanted);
  Ticks ticks;
  const double step = nice_step((scale.hi - scale.lo) / std::max(wanted, 1));
  const double largest = std::max(std::abs(scale.lo), std::abs(scale.hi));
  if (largest >= 1e5 || largest < 1e-2)
    ticks.exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
  const double unit = std::pow(10.0, ticks.exponent);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step / unit) + 1e-9)));
  const double slack = 1e-9 * step;
  for (double k = std::ceil((scale.lo - slack) / step); k * step <= scale.hi + slack; k += 1) {
    const double value = k == 0 ? 0.0 : k * step;  // never -0
    ticks.at.push_back(value);
    ticks.labels.push_back(with_minus(fmt::format("{:.{}f}", value / unit, decimals)));
  }
  return ticks;
}

std::string title_with_exponent(const std::string& title, const Ticks& ticks) {
  if (ticks.exponent == 0) return title;
  return fmt::format("{}   ×10^{{{}}}", title, with_minus(std::to_string(ticks.exponent)));
}

void Range::include(double value, bool log) {
  if (!std::isfinite(value) || (log && !(value > 0))) return;
  lo = std::min(lo, value);
  hi = std::max(hi, value);
}

AxisScale axis_around(const Range& range, double margin, bool log) {
  if (range.empty()) return log ? AxisScale{0.1, 10, true} : AxisScale{0, 1, false};
  if (log) {
    const double factor = range.hi > range.lo ? std::pow(range.hi / range.lo, margin) : 2.0;
    return {range.lo / factor, range.hi * factor, true};
  }
  const double size = range.hi - range.lo, largest = std::max(std::abs(range.lo), std::abs(range.hi));
  if (size <= 1e-12 * largest || size == 0) {  // one value: a stretch of its own size around it
    const double half = largest > 0 ? 0.5 * largest : 1.0;
    return {range.lo - half, range.hi + half, false};
  }
  return {range.lo - margin * size, range.hi + margin * size, false};
}

}  // namespace recoil
