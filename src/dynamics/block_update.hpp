#pragma once

#include "core/scratch.hpp"
#include "cutcell/body.hpp"

namespace recoil {

/// One Euler substage of the matter of one body in one block: fluxes through open faces times their open
/// areas, the velocity gradient integrated over each piece (no division by V), the sources of the stress
/// deviator (2 G dev D and the Jaumann terms) and of axisymmetry, and what the walls do (BodyBlock::walls).
///   Q += dt R, V += dt R_V.
/// Reads BodyBlock::average up to three cells beyond the block.
/// @param share part of a whole step that this substage stands for; what leaves through the edges of the
/// domain
///   is booked with it.
template <int Dim>
void update_block(const State<Dim>& state, Body<Dim>& body, int slot, double dt, double share,
                  Account<Dim>& edges, Counters& counters, Scratch& scratch);

}  // namespace recoil
