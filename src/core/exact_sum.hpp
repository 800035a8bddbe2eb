#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace recoil {

/// A sum of doubles without rounding: its value, rounded once at the end, has the same bits in whatever order
/// the terms were added. It holds numbers that do not overlap (J. R. Shewchuk, Discrete Comput. Geom. 18
/// (1997) 305). Terms must be finite, and so must all their sums.
class ExactSum {
 public:
  void add(double x) {
    std::size_t kept = 0;
    for (double y : parts_) {
      if (std::abs(x) < std::abs(y)) std::swap(x, y);
      const double sum = x + y, rest = y - (sum - x);
      if (rest != 0) parts_[kept++] = rest;
      x = sum;
    }
    parts_.resize(kept);
    if (x != 0) parts_.push_back(x);
  }
  void add(const ExactSum& other) {
    for (const double part : std::vector<double>(other.parts_)) add(part);
  }

  /// The double that is nearest to the sum; of two that are equally near the even one.
  double value() const {
    if (parts_.empty()) return 0;
    std::size_t n = parts_.size() - 1;
    double sum = parts_[n], rest = 0;
    while (n > 0 && rest == 0) {
      const double x = sum, y = parts_[--n];
      sum = x + y;
      rest = y - (sum - x);
    }
    // What remains may decide a tie that has just been rounded.
    if (n > 0 && ((rest < 0 && parts_[n - 1] < 0) || (rest > 0 && parts_[n - 1] > 0))) {
      const double twice = 2 * rest, other = sum + twice;
      if (twice == other - sum) sum = other;
    }
    return sum;
  }

  /// For parallel/archive.hpp.
  template <class Archive>
  void transfer(Archive& a) {
    a(parts_);
  }

 private:
  std::vector<double> parts_;  // by rising size
};

}  // namespace recoil
