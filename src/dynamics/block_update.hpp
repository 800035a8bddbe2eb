#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// Of what time the values at faces are: of the start of the stage, or of its middle. With those of the
/// middle one stage is a whole step of second order.
enum class FaceTime { now, midstep };

/// One Euler substage of the matter of one body in one block: fluxes through open faces times their open
/// areas, the velocity gradient integrated over each fragment (no division by V), the sources of the stress
/// deviator (2 G dev D and the Jaumann terms) and of axisymmetry, and what the walls do (BodyBlock::walls).
///   Q += dt R, V += dt R_V.
/// Reads BodyBlock::average up to three cells beyond the block.
/// @param weight part of a whole step that this substage stands for; what leaves through the edges of the
/// domain
///   is booked with it.
template <int Dim>
void update_block(const State<Dim>& state, Body<Dim>& body, int slot, FaceTime faces, double dt,
                  double weight, ExactEdgeAccount<Dim>& edges, Counters& counters, Scratch& scratch);

/// How fluxes through faces are found.
enum class FaceScheme {
  weno_hllc,  // WENO5-Z and an elastic HLLC solver (dynamics/flux.hpp)
  eno_llf     // convex ENO3 and local Lax-Friedrichs (dynamics/flux_llf.hpp)
};

/// One Euler substage of a ghost-fluid scheme: as update_block(), but for whole cells. Cells are real
/// (Role::regular) with all their faces open, or not there; what crosses a face between the two changes the
/// real cell only, so that nothing is conserved at surfaces. Ghost values carry the conditions there.
template <int Dim>
void update_whole_cells(const State<Dim>& state, Body<Dim>& body, int slot, FaceScheme scheme, double dt,
                        double weight, ExactEdgeAccount<Dim>& edges, Counters& counters, Scratch& scratch);

}  // namespace recoil
