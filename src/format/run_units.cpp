#include "format/run_units.hpp"

#include <numbers>

namespace recoil {

RunUnits run_units(config::Geometry geometry) {
  using enum config::Geometry;
  RunUnits u;
  u.axes = {"x"};
  u.stresses = {"xx", "yy", "zz"};
  u.balanced = {true};
  u.mass = "kg", u.momentum = "kg m/s", u.energy = "J", u.volume = "m3", u.force = "N", u.area = "m2";
  u.angular_momentum = "kg m2/s";
  switch (geometry) {
    case line:
      u.mass = "kg/m2", u.momentum = "kg/(m s)", u.energy = "J/m2", u.volume = "m", u.force = "N/m2",
      u.area = "1";
      break;
    case spherical:
      u.axes = {"r"};
      u.balanced = {false};
      u.stresses = {"rr", "tt", "pp"};
      u.whole = 4 * std::numbers::pi;
      break;
    case planar:
      u.axes = {"x", "y"};
      u.balanced = {true, true};
      u.stresses = {"xx", "yy", "xy", "zz"};
      u.turns = {"z"};
      u.angular_momentum = "kg m/s";
      u.mass = "kg/m", u.momentum = "kg/s", u.energy = "J/m", u.volume = "m2", u.force = "N/m", u.area = "m";
      break;
    case axisymmetric:
      u.axes = {"r", "z"};
      u.balanced = {false, true};
      u.stresses = {"rr", "zz", "rz", "tt"};
      u.whole = 2 * std::numbers::pi;
      break;
    case space:
      u.axes = {"x", "y", "z"};
      u.balanced = {true, true, true};
      u.stresses = {"xx", "yy", "xy", "xz", "yz", "zz"};
      u.turns = u.axes;
      break;
  }
  return u;
}

}  // namespace recoil
