#pragma once

#include <limits>
#include <span>
#include <vector>

#include "parallel/exact_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// A material point, and the largest compressive stress that it has met.
template <int Dim>
struct Station {
  Vec<Dim> at;                                             // m
  double peak = std::numeric_limits<double>::quiet_NaN();  // Pa, compressive, along the line; NaN: none yet
  double time = peak;                                      // s, of the peak
};

/// Stations on a straight line through a body: the decay of a shock with the distance that it has run.
template <int Dim>
struct StressLine {
  int body = 0;
  Vec<Dim> along;  // unit vector
  std::vector<Station<Dim>> stations;
};

/// Stations at equal distances from `from` (left out) to `to`.
template <int Dim>
StressLine<Dim> stress_line(int body, const Vec<Dim>& from, const Vec<Dim>& to, int stations);

/// Declares what the stations take. @returns the number of the first; the others follow.
template <int Dim>
int line_items(const StressLine<Dim>& line, ExactSums& sums);

/// Adds the state at each station from the cells around it that hold at least 0.3 of the body, linear between
/// their centres. Not collective.
template <int Dim>
void collect_line(const State<Dim>& state, const StressLine<Dim>& line, int first_item, ExactSums& sums);

/// Takes the peaks of this time [s] and moves the stations on by a step dt [s]. On rank 0, after the
/// reduction.
template <int Dim>
void follow_line(StressLine<Dim>& line, double time, double dt, int first_item, const ExactSums& sums);

}  // namespace recoil
