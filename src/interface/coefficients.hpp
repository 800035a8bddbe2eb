#pragma once

#include "core/vec.hpp"
#include "state/body.hpp"

namespace recoil {

/// What the weights of a mean fall by [1/dx^2] beyond those of the gradient: along the surface, and in all
/// directions.
struct Narrower {
  double along = 0, around = 0;
};

/// The coefficients of mean and gradient of the least-squares fit at a wall, from the weights of its donors
/// and their places (kept in slope_weight).
/// @param normal of the surface.
template <int Dim>
void find_coefficients(Wall<Dim>& wall, FieldArray<Donor<Dim>>& donors, const Vec<Dim>& normal,
                       const Narrower& mean_by);

}  // namespace recoil
