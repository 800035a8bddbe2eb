#pragma once

#include <string>
#include <vector>

#include "config/case.hpp"

namespace recoil {

/// How sums are named and scaled for people. Sums are per m2 in 1d and per metre of depth in planar geometry;
/// of an axisymmetric body the whole ring is meant: what the solver holds per radian, times 2 pi. So is the
/// whole shell of a spherical one: what it holds per steradian, times 4 pi.
struct RunUnits {
  std::vector<std::string> axes;  ///< "x"; "r"; "x", "y"; "r", "z"; "x", "y", "z"
  std::vector<std::string>
      stresses;      ///< in the order of Components::stress: "xx", "yy", ..., then the out-of-plane ones
  double whole = 1;  ///< factor of every sum: 1, 2 pi or 4 pi
  std::vector<bool> balanced;      ///< whether momentum along the axis is kept; not along r
  std::vector<std::string> turns;  ///< axes about which bodies turn: none, "z", or all three
  std::string mass, momentum, energy, volume, force, area, angular_momentum;  ///< units of sums
};

RunUnits run_units(config::Geometry geometry);

}  // namespace recoil
