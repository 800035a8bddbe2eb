#pragma once

#include <cstdint>

#include "core/scratch.hpp"
#include "state/body.hpp"

/// Level sets that open where the voids of failed matter are resolved (theory: fracture).
namespace recoil {

/// Below this part of solid matter in a whole cell the level set opens there.
inline constexpr double open_solid = 0.5;

/// Marks the whole cells of failed matter that are solid to less than open_solid (Role::opens).
/// @returns whether there are any.
template <int Dim>
bool mark_open(const State<Dim>& state, Body<Dim>& body, int slot);

/// Opens the level set at the marked cells and in the whole cells around them:
///   phi = max(phi, (1/2 - f) dx), V := f V
/// with the solid fraction f; contents stay. Writes BodyBlock::phi_next, which
/// holds phi, and BodyBlock::updates.
/// @returns how many cells open.
template <int Dim>
std::int64_t open_voids(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch);

/// Whole matter that the level set has lost gets it back: phi = min(phi, (1/2 - f) dx) where the level set
/// lies more than half a cell away and matter fills the part f >= 1/2 of the cell without voids. So fragments
/// of a cell or less keep a surface of their own. What has left a cell as a whole takes it along.
/// @returns how many cells are restored.
template <int Dim>
std::int64_t restore_level_set(const State<Dim>& state, Body<Dim>& body, int slot);

/// Fits the voids of failed matter to the room that other bodies leave in its cells, instead of moving
/// matter: a cell that the geometry shows full is filled up with void, and what is beyond the room is taken
/// off the void, as far as there is any. Bodies do so in their order. A cell that void would make thinner
/// than thinnest_failed is left to fill_inside(): stencils could not use it, and its faces would let out what
/// its neighbours have. Far within (phi <= -far_cells dx) a cell that lacks volume is filled up whatever its
/// matter: fill_inside() has no way outwards there, and the tension that comes of it is judged as any other.
/// So is a cell with less than half of a cell of matter among full ones: what is left of a void that has
/// closed to less than two cells (decision 0075). Matter so thin has torn.
template <int Dim>
void fit_voids(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch);

/// Gas gives way before other matter does: where bodies hold more than 1.1 of a cell together, the gas among
/// them is compressed to the room that they leave, to half of its volume in a step at most. Its contents
/// stay: its energy, which the walls have worked on, is its own. Without this a film of gas thinner than a
/// cell between two plates would be sent from cell to cell, and its level set would grow into the plates.
template <int Dim>
void fit_gas(const State<Dim>& state, Body<Dim>& body, int slot);

}  // namespace recoil
