#pragma once

#include <limits>
#include <string>
#include <vector>

namespace recoil {

/// The stretch of values that an axis shows, lo < hi; logarithmic ones need lo > 0.
struct AxisScale {
  double lo = 0, hi = 1;
  bool log = false;

  /// Place of the value along the axis: 0 at lo, 1 at hi; NaN for values a logarithm does not have.
  double fraction(double value) const;
};

/// Marks of an axis with their labels.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> labels;
  std::vector<double> minor;  ///< unlabelled marks between (logarithmic axes)
  int exponent = 0;           ///< the labels are to be multiplied by 10^exponent; belongs into the title
};

/// Marks at 1, 2 or 5 times a power of ten (decades on a logarithmic axis, unless it is too short for them),
/// about `wanted` of them.
Ticks nice_ticks(const AxisScale& scale, int wanted);

/// The title of a column with its unit in brackets, for people: "time [us]" as "time [µs]", "density [kg/m3]"
/// with a raised 3 (see draw_text), "friction [1]" as "friction".
std::string with_unit_symbols(const std::string& title);

/// The same with the common power of ten of the labels, if there is one.
std::string title_with_exponent(const std::string& title, const Ticks& ticks);

/// Grows to hold every finite value put in (for a logarithm: every positive one).
struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  void include(double value, bool log = false);
  bool empty() const { return !(lo <= hi); }
};

/// An axis around the range with `margin` (part of its length) to spare at both ends; a usable one also
/// for an empty range or a single value.
AxisScale axis_around(const Range& range, double margin, bool log = false);

}  // namespace recoil
