#pragma once

#include "core/vec.hpp"
#include "state/body.hpp"

namespace recoil {

/// The coefficients of mean and gradient of the least-squares fit at a wall, from the weights of its donors
/// and their places (kept in slope_weight).
/// @param normal of the surface. @param by_nearest the mean is that of the nearest donors alone.
template <int Dim>
void find_coefficients(Wall<Dim>& wall, Donors<Dim>& donors, const Vec<Dim>& normal, bool by_nearest);

}  // namespace recoil
