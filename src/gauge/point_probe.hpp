#pragma once

#include <cstddef>
#include <span>

#include "gauge/point_state.hpp"
#include "parallel/exact_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// A point of a body: one that stays where it is, or one that moves with the matter.
template <int Dim>
struct BodyPoint {
  int body = 0;
  bool follows = false;
  Vec<Dim> at;         // m
  bool moves = false;  // `velocity` is known
  Vec<Dim> velocity;   // m/s, of the matter there at `time`
  double time = 0;     // s, of the last step it has followed
};

/// Sums that the state at a place takes: density, velocity, pressure, stresses, von Mises stress, strain,
/// temperature, molten part, and the place itself.
template <int Dim>
inline constexpr std::size_t point_sums = 6 + 2 * Dim + PointState<Dim>::stresses;

/// Adds the state of a body at a point, if this rank has the cell that holds it and the point lies within the
/// body or at most half a cell outside of its surface. Where the 2^Dim cells around the point are full of the
/// body's matter the state is linear in each axis between their centres. Else it is the value there of the
/// linear function that fits those of the 4^Dim cells around that hold at least 0.3 of it best, by least
/// squares with weights that fall to zero at 2 dx; a fragment counts at its middle, and density, strain,
/// temperature and molten part stay within the range of the cells. Cells beyond a plane of symmetry or the
/// axis are mirrored. Fragments of the body count that other bodies have taken up. A point that follows the
/// matter is moved first, from its own time to that of the state, by Heun's rule, and comes in again
/// where it leaves across the edge of a period. After a step, or at the start.
template <int Dim>
void probe_point(const State<Dim>& state, const BodyPoint<Dim>& point, int item, ExactSums& sums);

/// Moves a point that follows the matter to where probe_point() found it, and remembers its velocity. On rank
/// 0, after the reduction, at the state's time [s].
template <int Dim>
void follow_point(BodyPoint<Dim>& point, double time, bool found, std::span<const double> sums);

}  // namespace recoil
