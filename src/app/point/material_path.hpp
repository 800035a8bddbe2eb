#pragma once

#include <optional>
#include <vector>

#include "app/point/material_point.hpp"

namespace recoil::app {

/// How a point is deformed. The strain is the logarithmic one along x, positive where it is stretched, or of
/// simple_shear the slope gamma = du_x/dy dt.
enum class PathKind {
  uniaxial_strain,  // nothing moves along y and z: plate impact
  uniaxial_stress,  // no stress on the sides: a thin bar
  simple_shear
};

/// What is asked of a path.
struct PathOrder {
  PathKind kind = PathKind::uniaxial_strain;
  std::vector<double> strains;                  // where it goes in turn, from 0
  double rate = 1;                              // 1/s, above 0
  int steps = 100;                              // to each of them
  std::optional<double> pressure, temperature;  // at the start [Pa, K]
};

/// One place of it.
struct PathPoint {
  double time = 0;         // s
  double strain = 0;       // 1
  double side_strain = 0;  // logarithmic, along y and z
  double energy = 0;       // J/kg, internal
  PointState<3> state;
};

/// Takes a point of the material along a path; the first one is the start. @throws InputError for an order
/// that makes no sense; PhysicsError where the equation of state ends or no side strain frees the sides of
/// stress.
std::vector<PathPoint> follow_path(const Material& material, const PathOrder& order);

}  // namespace recoil::app
