#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// What a body's matter is kept in while a step advances it.
enum class Cells {
  cut,   // fragments of cells: conservative scheme
  whole  // whole cells, real where phi < 0: ghost-fluid schemes
};

/// From fragments to whole cells, at the start of a step of a ghost-fluid scheme: a cell whose centre lies in
/// the body is real, its contents are scaled from its fragment to the whole cell; all other cells are
/// emptied. Between steps a body is held in fragments (to_cut_cells), so that sums, gauges and pictures need
/// not know the scheme.
template <int Dim>
void to_whole_cells(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters);

/// Puts the values of all donors in the middle of their cells: whole cells have no other centroid.
template <int Dim>
void centre_donors(BodyBlock<Dim>& block);

/// From whole cells back to fragments, with the end-of-step geometry: V = V_phi and Q = V U, U from the cell
/// itself where it was real and from its ghost value (BodyBlock::stencil) elsewhere.
template <int Dim>
void to_cut_cells(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters);

}  // namespace recoil
