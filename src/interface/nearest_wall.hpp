#pragma once

#include "state/body.hpp"

namespace recoil {

/// The wall that is nearest to a point.
template <int Dim>
struct NearWall {
  int slot = -1, wall = 0;  // place in BodyBlock::walls; -1: none is near
  unsigned flips = 0;       // between the window and the wall
  Vec<Dim> from_wall;       // the point minus the wall's x_I [m], in the wall's own frame
};

/// Looks for the wall of a body with a fit whose x_I is nearest to x, in the cells of a window up to `reach`
/// from that of x.
/// @param index places in BodyBlock::walls of the cells of the window, -1 where there is none.
template <int Dim>
NearWall<Dim> nearest_wall(const State<Dim>& state, const Body<Dim>& body, const Window<Dim>& window,
                           const int* index, const Vec<Dim>& x, int reach);

/// The fitted state of a wall continued by from_wall [m] along its gradient, as it appears under `flips`.
/// Density, plastic strain, temperature rise and entropy are not extrapolated.
template <int Dim>
Primitives<Dim> continued_value(const Wall<Dim>& wall, const Vec<Dim>& from_wall, unsigned flips, double dx);

/// v with the axes of `flips` turned round.
template <int Dim>
Vec<Dim> flipped(Vec<Dim> v, unsigned flips) {
  for (int d = 0; d < Dim; ++d)
    if ((flips >> d & 1U) != 0) v[d] = -v[d];
  return v;
}

}  // namespace recoil
