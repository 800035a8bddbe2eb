#include "picture/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

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
  const double decades = std::log10(scale.hi / scale.lo);
  const bool few = decades < 1.7;                 // label 2 and 5 as well
  const bool every = decades < 1 && wanted >= 5;  // label all
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
      } else if (every || (few && (m == 2 || m == 5))) {
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

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// "kg/m3" as "kg/m³", "us" as "µs".
std::string unit_symbols(const std::string& unit) {
  static const std::map<std::string, std::string> symbols{{"us", "µs"}, {"um", "µm"}, {"ug", "µg"},
                                                          {"uJ", "µJ"}, {"deg", "°"}, {"degC", "°C"}};
  std::string out;
  for (std::size_t k = 0; k < unit.size();) {
    if (!is_letter(unit[k])) {
      out += unit[k++];
      continue;
    }
    std::size_t end = k;
    while (end < unit.size() && is_letter(unit[end])) ++end;
    const std::string name = unit.substr(k, end - k);
    const auto symbol = symbols.find(name);
    out += symbol == symbols.end() ? name : symbol->second;
    if (end < unit.size() && unit[end] == '^') ++end;
    const std::size_t power = end;
    if (end < unit.size() && unit[end] == '-') ++end;
    while (end < unit.size() && unit[end] >= '0' && unit[end] <= '9') ++end;
    if (end > power) out += fmt::format("^{{{}}}", with_minus(unit.substr(power, end - power)));
    k = end;
  }
  return out;
}

}  // namespace

double AxisScale::fraction(double value) const {
  if (!log) return (value - lo) / (hi - lo);
  if (!(value > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::log(value / lo) / std::log(hi / lo);
}

Ticks nice_ticks(const AxisScale& scale, int wanted) {
  if (scale.log) {
    Ticks decades = decade_ticks(scale, wanted);
    if (decades.at.size() > 1 || scale.hi > 10 * scale.lo)
      return decades;  // else the axis is too short for them
  }
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
  const std::string readable = with_unit_symbols(title);
  if (ticks.exponent == 0) return readable;
  return fmt::format("{}   ×10^{{{}}}", readable, with_minus(std::to_string(ticks.exponent)));
}

std::string with_unit_symbols(const std::string& title) {
  const std::size_t open = title.rfind('[');
  if (open == std::string::npos || !title.ends_with(']')) return title;
  const std::string unit = title.substr(open + 1, title.size() - open - 2);
  if (unit == "1") return open == 0 ? "" : title.substr(0, title.find_last_not_of(' ', open - 1) + 1);
  return title.substr(0, open + 1) + unit_symbols(unit) + "]";
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
