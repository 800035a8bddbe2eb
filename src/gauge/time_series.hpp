#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace recoil {

/// One column of a record over time.
struct SeriesColumn {
  std::string name;    ///< "velocity", "velocity.x"
  std::string unit;    ///< in which it is written: "m/s", "GPa"
  double to_unit = 1;  ///< times the SI value gives the number in that unit
};

/// A record over time, or over a distance, in SI. NaN: nothing was there.
struct TimeSeries {
  std::string name;
  std::vector<SeriesColumn> columns;
  std::vector<double> time;                 ///< s, or m of a record over distance; rising
  std::vector<std::vector<double>> values;  ///< [column][record]
  SeriesColumn over{"time", "us", 1e6};     ///< what `time` is

  /// Position of a column, or columns.size(). A vector with one component answers to its name without the
  /// axis.
  std::size_t find(std::string_view column) const;
};

/// A curve: the points of one column that have a value.
struct Curve {
  std::vector<double> t, y;
};
Curve curve_of(const TimeSeries& series, std::size_t column);

/// Linear between the points; NaN outside of them.
double value_at(const Curve& curve, double t);
/// Mean over [from, to] of the curve as straight lines between its points; NaN where it does not reach that
/// far.
double mean_over(const Curve& curve, double from, double to);
/// Root of the mean squared deviation from that mean.
double rms_over(const Curve& curve, double from, double to);
/// Slope of the straight line that fits the curve over [from, to] best, by least squares.
double slope_over(const Curve& curve, double from, double to);
/// Mean over [from, to] of |curve - reference|.
double distance_over(const Curve& curve, const Curve& reference, double from, double to);

/// The value of largest magnitude and when it was first there. NaN for an empty curve.
struct Peak {
  double value = std::numeric_limits<double>::quiet_NaN(), time = value;
};
Peak peak_of(const Curve& curve);

inline constexpr double pullback_rebound = 0.1;  // of the fall, by which the velocity rises again
inline constexpr double least_pullback = 0.01;   // fall, as a part of the peak: less is noise on a plateau

/// The pull-back of a free-surface velocity: from its largest value down to the lowest one that follows it
/// before the record rises again. NaN where it does not.
struct PullBack {
  double fall = std::numeric_limits<double>::quiet_NaN(), peak_time = fall, time = fall;
};
PullBack pull_back_of(const Curve& curve);

/// Smallest and largest value over [from, to], of the points and of the ends; NaN where the curve does not
/// reach that far.
double least_over(const Curve& curve, double from, double to);
double most_over(const Curve& curve, double from, double to);

/// First time at which the curve reaches `level`, coming from the side of its first value; NaN if never.
double arrival_at(const Curve& curve, double level);
/// Last time at which the curve crosses `level`; NaN if never.
double last_at(const Curve& curve, double level);
/// First time at which the curve has made half of its largest change from the first value; NaN if it never
/// changes.
double arrival_of(const Curve& curve);

}  // namespace recoil
