#pragma once

#include <cstdint>

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

// States that the equations do not admit: they are marked, averaged with what is around, and the marks are
// cleared.

/// Whether contents are beyond what the equations admit: density outside the DensityRange of the equation of
/// state (of solids 0.5-2.5 rho0), or c^2 below 0.02 c0^2.
template <int Dim>
bool inadmissible(const Material& material, const Contents<Dim>& contents, double volume);

/// Marks (Role::has_bad_contents) the fragments of a block above 0.02 of a cell whose state is inadmissible.
/// Matter that can fail, and is expanded beyond its equation of state, has failed instead: its damage is set
/// to `most_damage` and counted (torn-states).
/// @returns how many are marked.
template <int Dim>
std::int64_t mark_inadmissible(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters,
                               double most_damage = 1);
template <int Dim>
void clear_inadmissible(BodyBlock<Dim>& block);

/// Averages every inadmissible state (Role::has_bad_contents) with the fragments up to `width` cells around,
/// conservatively; where windows overlap, each cell is shared evenly between them. Cells of another size take
/// no part: a state beside them is averaged with those of its own level alone. Writes BodyBlock::updates and
/// leaves the state as it is.
template <int Dim>
void average_inadmissible(const State<Dim>& state, Body<Dim>& body, int slot, int width, Scratch& scratch);

}  // namespace recoil
