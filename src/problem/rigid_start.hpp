#pragma once

#include "config/case.hpp"
#include "mesh/grid.hpp"
#include "state/rigid_motion.hpp"

namespace recoil {

/// How a rigid body moves at t = 0, without a mass: with its velocity and spin, or by its history.
/// @param grid that of the case.
template <int Dim>
RigidMotion<Dim> prescribed_motion(const config::Body& body, const config::Case& c, const Grid<Dim>& grid);

/// The same with its mass, if it has one.
template <int Dim>
RigidMotion<Dim> rigid_motion(const config::Body& body, const config::Case& c, const Grid<Dim>& grid);

}  // namespace recoil
