#pragma once

#include "state/body.hpp"

namespace recoil {

/// Sets the energy of detonation free in the cells of one block that the front of a body passes until `now`
/// [s]. It comes over the time that the front needs for `front_cells` cells, about its arrival at the middle
/// of the cell.
/// @returns the energy [J; per radian where axisymmetric].
template <int Dim>
ExactSum detonate(const State<Dim>& state, Body<Dim>& body, int slot, double now);

}  // namespace recoil
