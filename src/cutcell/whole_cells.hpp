#pragma once

#include "core/scratch.hpp"
#include "cutcell/body.hpp"

namespace recoil {

/// What a body's matter is kept in while a step advances it.
enum class Cells {
  cut,   // pieces of cells: conservative scheme
  whole  // whole cells, real where phi < 0: ghost-fluid schemes
};

/// From pieces to whole cells, at the start of a step of a ghost-fluid scheme: a cell whose centre lies in
/// the body is real, its contents are scaled from its piece to the whole cell; all other cells are emptied.
/// Between steps a body is held in pieces (show_pieces), so that sums, gauges and pictures need not know the
/// scheme.
template <int Dim>
void take_whole_cells(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters);

/// Puts the values of all donors in the middle of their cells: whole cells have no other centroid.
template <int Dim>
void centre_donors(BodyBlock<Dim>& block);

/// From whole cells back to pieces, with the settled geometry: V = V_phi and Q = V U, U from the cell itself
/// where it was real and from its ghost value (BodyBlock::stencil) elsewhere.
template <int Dim>
void show_pieces(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters);

}  // namespace recoil
