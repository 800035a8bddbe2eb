#pragma once

#include "core/scratch.hpp"
#include "dynamics/block_work.hpp"
#include "state/body.hpp"

namespace recoil::detail {

/// Adds what the walls do to the rates of cut cells, and moves their volumes by dt seconds.
template <int Dim>
void add_walls(BodyBlock<Dim>& block, Work<Dim>& work, double dt);

/// Adds the sources of the stress deviator (2 G dev D and the Jaumann terms) and of axisymmetry to the rates,
/// from the gradients that the sweeps and the walls have left. Overwrites the primitives of cut cells
/// without a value with those of their walls.
/// @param g shear modulus [Pa]; 0 for fluids.
template <int Dim>
void add_sources(const BodyBlock<Dim>& block, double g, Work<Dim>& work, Scratch& scratch);

}  // namespace recoil::detail
