#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// The walls of all cut cells of a block: which parts of a surface touch another body and what they do to
/// each other (contact/touch), and the free rest. Momentum and energy given to one side are taken from the
/// other to the last bit; both volumes move with the velocity that does the work. Writes BodyBlock::walls and
/// State::contacts, and books these.
/// @param weight part of a whole step that this stage stands for (the weight of the Runge-Kutta stage).
template <int Dim>
void find_walls(State<Dim>& state, int slot, double dt, double weight, Scratch& scratch);

/// Stores for the next step which bodies every cell touched.
template <int Dim>
void remember_contact(BodyBlock<Dim>& block);

}  // namespace recoil
