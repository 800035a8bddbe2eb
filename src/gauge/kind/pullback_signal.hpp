#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/nothing.hpp"
#include "gauge/time_series.hpp"

namespace recoil {

/// The velocity of a free surface, followed from step to step: peak, minimum behind it, and the two maxima
/// that follow. The minimum stands once the velocity has risen again, as in pull_back_of()
/// (time_series.hpp); a velocity above the peak begins anew.
class PullbackSignal {
 public:
  void add(double time, double velocity) {
    if (!(velocity <= peak_)) return begin(time, velocity);
    if (rings_) return ring(time, velocity);
    keep(time, velocity);
    if (velocity < low_) low_ = velocity, low_time_ = time;
    const double fall = peak_ - low_;
    if (fall > least_pullback * std::abs(peak_) && velocity - low_ > pullback_rebound * fall)
      stand(time, velocity);
  }

  double peak() const { return std::isfinite(peak_) ? peak_ : nothing; }
  double peak_time() const { return peak_time_; }
  double low() const { return rings_ ? low_ : nothing; }
  double low_time() const { return rings_ ? low_time_ : nothing; }
  double fall() const { return peak_ - low(); }
  /// Mean slope [m/s2] of the fall, between the last time at 0.1 and the first one at 0.9 of it.
  double slope() const { return rings_ ? slope_ : nothing; }
  /// Between the two maxima behind the minimum [s].
  double period() const { return maxima_ == 2 ? second_.first - first_.first : nothing; }

  /// For parallel/archive.hpp.
  template <class Archive>
  void transfer(Archive& a) {
    a(peak_, peak_time_, low_, low_time_, slope_, rings_, rising_, maxima_, turn_, first_, second_, fall_,
      skipped_, stride_);
  }

 private:
  using Point = std::pair<double, double>;  // time, velocity

  void begin(double time, double velocity) {
    *this = PullbackSignal();
    if (std::isnan(velocity)) return;
    peak_ = low_ = velocity, peak_time_ = low_time_ = time;
    fall_.emplace_back(time, velocity);
  }

  /// All points, then every second one, every fourth, ...: as many as it takes for a slope.
  void keep(double time, double velocity) {
    constexpr std::size_t most = 1024;
    if (skipped_++ % stride_ != 0) return;
    fall_.emplace_back(time, velocity);
    if (fall_.size() < most) return;
    for (std::size_t k = 0; 2 * k < most; ++k) fall_[k] = fall_[2 * k];
    fall_.resize(most / 2);
    stride_ *= 2;
  }

  void stand(double time, double velocity) {
    rings_ = rising_ = true;
    turn_ = {time, velocity};
    const double depth = peak_ - low_, upper = peak_ - 0.1 * depth, lower = peak_ - 0.9 * depth;
    std::size_t from = 0, to = 0;
    for (std::size_t k = 0; k < fall_.size(); ++k) {
      if (to == 0 && fall_[k].second >= upper) from = k;
      if (to == 0 && fall_[k].second <= lower) to = k;
    }
    if (to == 0) to = fall_.size() - 1;
    slope_ = (fall_[from].second - fall_[to].second) / (fall_[to].first - fall_[from].first);
    fall_.clear();
  }

  /// Behind the minimum: a maximum, or a minimum, once the velocity has turned by a tenth of the fall.
  void ring(double time, double velocity) {
    if (maxima_ == 2) return;
    if (rising_ ? velocity > turn_.second : velocity < turn_.second) turn_ = {time, velocity};
    if (std::abs(velocity - turn_.second) <= pullback_rebound * (peak_ - low_)) return;
    if (rising_) (maxima_++ == 0 ? first_ : second_) = turn_;
    rising_ = !rising_;
    turn_ = {time, velocity};
  }

  double peak_ = -std::numeric_limits<double>::infinity(), peak_time_ = nothing, low_ = nothing,
         low_time_ = nothing, slope_ = nothing;
  bool rings_ = false, rising_ = false;
  int maxima_ = 0;
  std::uint64_t skipped_ = 0, stride_ = 1;
  Point turn_{nothing, nothing}, first_ = turn_, second_ = turn_;
  std::vector<Point> fall_;  // from the peak on
};

}  // namespace recoil
