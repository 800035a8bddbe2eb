#pragma once

#include "core/scratch.hpp"
#include "dynamics/face_rows.hpp"
#include "state/body.hpp"

namespace recoil::detail {

/// Keeps the fluxes and star velocities of the faces beyond which cells are coarser, and replaces those
/// beyond which they are finer by the means that were kept there, weighted with the areas: what leaves the
/// one enters the other. Finer blocks first.
template <int Dim>
void meet_other_levels(const Faces<Dim>& faces, int axis, const Work<Dim>& w);

/// Adds what the walls do to the rates of cut cells, and moves their volumes by dt seconds.
template <int Dim>
void add_walls(BodyBlock<Dim>& block, Work<Dim>& work, double dt);

/// Adds the sources of the stress deviator (2 G dev D and the Jaumann terms) and of axisymmetry to the rates,
/// from the gradients that the sweeps and the walls have left. Overwrites the primitives of cut cells
/// without a value with those of their walls.
template <int Dim>
void add_sources(const Body<Dim>& body, int slot, Work<Dim>& work, Scratch& scratch);

}  // namespace recoil::detail
