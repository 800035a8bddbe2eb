#pragma once

#include <array>
#include <limits>

namespace recoil {

/// The contact of one pair of bodies in one step, summed over all blocks; the lower-numbered body is the
/// first. Sums, not means; vectors have three components whatever the dimension. Per radian where
/// axisymmetric.
struct PairSample {
  double area = 0;                                                // m^(Dim-1)
  std::array<double, 3> force{};                                  // on the first
  std::array<double, 3> impulse{};                                // received by the first since the start
  double work = 0;                                                // received by the first since the start
  double traction = 0, velocity = 0, gap = 0;                     // times area
  std::array<double, 3> place{};                                  // times area
  double widest_gap = 0, deepest_overlap = 0;                     // in dx, at touching cells
  double smallest_gap = std::numeric_limits<double>::infinity();  // m, anywhere; inf: not near each other
};

/// Mass and momentum of a body at one time, in any common unit; axes: three whatever the dimension. Mass 0:
/// it moves as prescribed, with `velocity`.
struct BodyMotion {
  double mass = 0;
  std::array<double, 3> momentum{};
  std::array<double, 3> velocity{};
};

}  // namespace recoil
