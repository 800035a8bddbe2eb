#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// Volume moves only with its contents, from one old state; all functions here write BodyBlock::updates and
/// leave the state as it is. They use the end-of-step geometry (after the step).

/// Sets CutCell::mismatch of the end-of-step geometry, limited to half a cell.
template <int Dim>
void measure_mismatch(const State<Dim>& state, Body<Dim>& body, int slot);

/// Cells that the geometry shows empty give all to their neighbour inwards. Where that lies beyond an open
/// edge of the domain the body has left, and what the cell still holds leaves too; so does the last of a body
/// that moves out there, less than half a cell with no more around. Both are booked in `edges`. Fragments of
/// matter that can fail which have no such neighbour go on with their own velocity (lost_fragment.hpp).
/// @param dt of the step [s]; state.time is that of its start.
template <int Dim>
void empty_outside(const State<Dim>& state, Body<Dim>& body, int slot, double dt,
                   ExactEdgeAccount<Dim>& edges, Scratch& scratch);

/// Cells that the geometry shows full pass what they hold beyond a whole cell to their neighbour outwards, or
/// take what they lack from it. A deficit stays where it would take the neighbour below its least volume
/// (bound_volumes), or failed matter, most of which is void, below a mass of zero. Where outwards is beyond
/// an open edge of the domain, the body goes on there in the cell's own state, and what passes is booked in
/// `edges`. Farther than six cells inside nothing moves.
template <int Dim>
void fill_inside(const State<Dim>& state, Body<Dim>& body, int slot, ExactEdgeAccount<Dim>& edges,
                 Scratch& scratch);

/// Bounds the volume of cut cells: below the bound all goes to the fullest neighbour, above it the excess to
/// the emptiest cut one. The bounds are [0, full] where a body is thinner than about two cells, 0.1 full
/// wider elsewhere.
template <int Dim>
void bound_volumes(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch);

}  // namespace recoil
