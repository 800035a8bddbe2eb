#pragma once

#include "core/scratch.hpp"
#include "cutcell/whole_cells.hpp"
#include "state/body.hpp"

namespace recoil {

/// Lists the cells of a block that a reconstruction reads but whose fragments are not regular (within three
/// of an open face, along its axis), each with the cut cell nearest to its foot point, whose wall gives it
/// its value; where none is near that point, with the nearest one that the ghost lies outside of. Once a
/// step. Writes BodyBlock::ghosts.
/// @param cells whole: the faces of real cells (Role::regular) are the open ones.
template <int Dim>
void choose_ghosts(const State<Dim>& state, Body<Dim>& body, int slot, Cells cells, Scratch& scratch);

}  // namespace recoil
