#pragma once

#include <cstddef>
#include <map>
#include <vector>

namespace recoil::app {

/// Searches for the place where a condition changes along one variable, by runs: first at given points, then
/// by dividing the first interval between neighbours that differ.
class Threshold {
 public:
  /// @param points at least two, rising or falling. @param within what the half width of the last interval
  /// may be.
  Threshold(std::vector<double> points, double within);

  /// What to try next, up to `most` values inside of the interval, evenly spaced; empty: it is done. All the
  /// given points come first, whatever `most` says.
  std::vector<double> wanted(std::size_t most = 1) const;
  /// What a run at x has shown.
  void learn(double x, bool holds);

  /// Number of changes between the neighbours known so far; 0 after the search: there is none in the range.
  std::size_t changes() const;
  /// Of the interval of the first change; NaN where there is none.
  double middle() const;
  double half_width() const;
  /// Whether the condition holds at the larger end of that interval (or everywhere, without a change).
  bool holds_above() const;
  std::size_t runs() const { return known_.size(); }

 private:
  struct Interval {
    double lo = 0, hi = 0;
    bool found = false;
  };
  Interval first_change() const;
  bool complete() const;

  std::vector<double> points_;
  double within_;
  std::map<double, bool> known_;
};

}  // namespace recoil::app
