#pragma once

#include "core/scratch.hpp"
#include "cutcell/whole_cells.hpp"

namespace recoil {

/// Lists the cells of a block that a reconstruction reads but whose fragments are not regular (within three
/// of an open face, along its axis), each with the cut cell nearest to its foot point, whose wall gives it
/// its value. Once a step. Writes BodyBlock::ghosts.
/// @param cells whole: the faces of real cells (Role::regular) are the open ones.
template <int Dim>
void choose_ghosts(const State<Dim>& state, Body<Dim>& body, int slot, Cells cells, Scratch& scratch);

/// Turns averages into the values that reconstructions read in this stage, in the same memory
/// (BodyBlock::average is empty afterwards, ::stencil holds them; Role::valued marks them): regular uncut
/// cells keep their average; regular cut cells their average moved from the centroid to the cell's centre
/// with a limited slope along the normal; ghost cells the state of their wall, extrapolated along the normal.
template <int Dim>
void fill_stencil_values(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters);

}  // namespace recoil
