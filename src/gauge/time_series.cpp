#include "gauge/time_series.hpp"

#include <algorithm>
#include <cmath>

#include "core/nothing.hpp"

namespace recoil {

namespace {

/// Ends of windows and of curves count as equal within this part of the time.
constexpr double same_time = 1e-9;

/// All times at which the integrand may bend, between two ends; empty where a curve does not reach that far.
std::vector<double> knots(const Curve& curve, double from, double to) {
  if (curve.t.empty() || !(to > from)) return {};
  const double slack = same_time * std::max(std::abs(from), std::abs(to));
  if (from < curve.t.front() - slack || to > curve.t.back() + slack) return {};
  std::vector<double> t{from};
  for (const double s : curve.t)
    if (s > from && s < to) t.push_back(s);
  t.push_back(to);
  return t;
}

}  // namespace

std::size_t TimeSeries::find(std::string_view column) const {
  std::size_t part = columns.size(), parts = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string_view name = columns[c].name;
    if (name == column) return c;
    if (!name.starts_with(column) || name.substr(column.size()).find('.') != 0) continue;
    part = c;
    ++parts;
  }
  return parts == 1 ? part : columns.size();
}

Curve curve_of(const TimeSeries& series, std::size_t column) {
  Curve curve;
  for (std::size_t i = 0; i < series.time.size(); ++i) {
    const double y = series.values[column][i];
    if (std::isnan(y)) continue;
    curve.t.push_back(series.time[i]);
    curve.y.push_back(y);
  }
  return curve;
}

double value_at(const Curve& curve, double t) {
  if (curve.t.empty()) return nothing;
  const double slack = same_time * std::abs(t);
  if (t < curve.t.front() - slack || t > curve.t.back() + slack) return nothing;
  const auto above = std::upper_bound(curve.t.begin(), curve.t.end(), t);
  if (above == curve.t.begin()) return curve.y.front();
  const auto i = static_cast<std::size_t>(above - curve.t.begin()) - 1;
  if (i + 1 == curve.t.size()) return curve.y.back();
  const double s = (t - curve.t[i]) / (curve.t[i + 1] - curve.t[i]);
  return curve.y[i] + s * (curve.y[i + 1] - curve.y[i]);
}

double mean_over(const Curve& curve, double from, double to) {
  const std::vector<double> t = knots(curve, from, to);
  if (t.empty()) return nothing;
  double sum = 0;
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    sum += 0.5 * (t[i + 1] - t[i]) * (value_at(curve, t[i]) + value_at(curve, t[i + 1]));
  return sum / (to - from);
}

double rms_over(const Curve& curve, double from, double to) {
  const std::vector<double> t = knots(curve, from, to);
  if (t.empty()) return nothing;
  const double mean = mean_over(curve, from, to);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double a = value_at(curve, t[i]) - mean, b = value_at(curve, t[i + 1]) - mean;
    sum += (t[i + 1] - t[i]) * (a * a + a * b + b * b) / 3;
  }
  return std::sqrt(sum / (to - from));
}

double slope_over(const Curve& curve, double from, double to) {
  const std::vector<double> t = knots(curve, from, to);
  if (t.empty()) return nothing;
  const double middle = 0.5 * (from + to), length = to - from;
  double moment = 0;  // of the curve about the middle
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double a = value_at(curve, t[i]), b = value_at(curve, t[i + 1]);
    const double s = t[i] - middle, e = t[i + 1] - middle;
    moment += (t[i + 1] - t[i]) * (a * (2 * s + e) + b * (s + 2 * e)) / 6;
  }
  return 12 * moment / (length * length * length);
}

double distance_over(const Curve& curve, const Curve& reference, double from, double to) {
  std::vector<double> t = knots(curve, from, to);
  const std::vector<double> other = knots(reference, from, to);
  if (t.empty() || other.empty()) return nothing;
  t.insert(t.end(), other.begin(), other.end());
  std::sort(t.begin(), t.end());
  const auto apart = [&](double s) { return std::abs(value_at(curve, s) - value_at(reference, s)); };
  double sum = 0;
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    sum += 0.5 * (t[i + 1] - t[i]) * (apart(t[i]) + apart(t[i + 1]));
  return sum / (to - from);
}

Peak peak_of(const Curve& curve) {
  Peak peak;
  for (std::size_t i = 0; i < curve.t.size(); ++i)
    if (i == 0 || std::abs(curve.y[i]) > std::abs(peak.value)) peak = {curve.y[i], curve.t[i]};
  return peak;
}

PullBack pull_back_of(const Curve& curve) {
  if (curve.y.empty()) return {};
  const auto peak =
      static_cast<std::size_t>(std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin());
  std::size_t lowest = peak;
  for (std::size_t i = peak; i < curve.y.size(); ++i) {
    if (curve.y[i] < curve.y[lowest]) lowest = i;
    const double fall = curve.y[peak] - curve.y[lowest];
    if (fall > least_pullback * std::abs(curve.y[peak]) &&
        curve.y[i] - curve.y[lowest] > pullback_rebound * fall)
      return {fall, curve.t[peak], curve.t[lowest]};
  }
  return {};
}

double least_over(const Curve& curve, double from, double to) {
  double least = nothing;
  for (const double t : knots(curve, from, to)) least = std::fmin(least, value_at(curve, t));
  return least;
}

double most_over(const Curve& curve, double from, double to) {
  double most = nothing;
  for (const double t : knots(curve, from, to)) most = std::fmax(most, value_at(curve, t));
  return most;
}

double arrival_at(const Curve& curve, double level) {
  if (curve.t.empty()) return nothing;
  const bool rising = curve.y.front() < level;
  for (std::size_t i = 0; i < curve.t.size(); ++i) {
    const bool there = rising ? curve.y[i] >= level : curve.y[i] <= level;
    if (!there) continue;
    if (i == 0) return curve.t[0];
    const double s = (level - curve.y[i - 1]) / (curve.y[i] - curve.y[i - 1]);
    return curve.t[i - 1] + s * (curve.t[i] - curve.t[i - 1]);
  }
  return nothing;
}

double last_at(const Curve& curve, double level) {
  for (std::size_t i = curve.t.size(); i-- > 1;) {
    const double a = curve.y[i - 1], b = curve.y[i];
    if ((a < level) == (b < level)) continue;
    return curve.t[i - 1] + (level - a) / (b - a) * (curve.t[i] - curve.t[i - 1]);
  }
  return nothing;
}

double arrival_of(const Curve& curve) {
  double change = 0;
  for (const double y : curve.y)
    if (std::abs(y - curve.y.front()) > std::abs(change)) change = y - curve.y.front();
  return change == 0 ? nothing : arrival_at(curve, curve.y.front() + 0.5 * change);
}

}  // namespace recoil
