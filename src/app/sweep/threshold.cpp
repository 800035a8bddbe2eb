#include "app/sweep/threshold.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/sweep/swept_keys.hpp"
#include "core/error.hpp"
#include "core/nothing.hpp"

namespace recoil::app {

namespace {}  // namespace

Threshold::Threshold(std::vector<double> points, double within)
    : points_(std::move(points)), within_(within) {
  require(points_.size() >= 2 && within_ > 0, "a threshold has a range and a tolerance");
}

bool Threshold::complete() const {
  return std::ranges::all_of(points_, [this](double x) { return known_.contains(x); });
}

std::vector<double> Threshold::wanted(std::size_t most) const {
  std::vector<double> next;
  for (const double x : points_)
    if (!known_.contains(x)) next.push_back(x);
  if (!next.empty()) return next;
  const Interval at = first_change();
  if (!at.found || 0.5 * (at.hi - at.lo) <= within_) return {};
  const auto parts = static_cast<double>(std::max<std::size_t>(most, 1) + 1);
  for (double k = 1; k < parts; ++k) {
    const double x = rounded_in_range(at.lo + (at.hi - at.lo) * k / parts);
    if (x > at.lo && x < at.hi && (next.empty() || x > next.back())) next.push_back(x);
  }
  return next;
}

void Threshold::learn(double x, bool holds) { known_[x] = holds; }

Threshold::Interval Threshold::first_change() const {
  if (!complete()) return {};
  for (auto at = known_.begin(); at != known_.end() && std::next(at) != known_.end(); ++at)
    if (at->second != std::next(at)->second) return {at->first, std::next(at)->first, true};
  return {};
}

std::size_t Threshold::changes() const {
  std::size_t n = 0;
  for (auto at = known_.begin(); at != known_.end() && std::next(at) != known_.end(); ++at)
    n += at->second != std::next(at)->second;
  return n;
}

double Threshold::middle() const {
  const Interval at = first_change();
  return at.found ? 0.5 * (at.lo + at.hi) : nothing;
}

double Threshold::half_width() const {
  const Interval at = first_change();
  return at.found ? 0.5 * (at.hi - at.lo) : nothing;
}

bool Threshold::holds_above() const {
  const Interval at = first_change();
  return !known_.empty() && (at.found ? known_.at(at.hi) : known_.rbegin()->second);
}

}  // namespace recoil::app
