#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// Fragments that fill less of a cell are redistributed; neighbourhoods reach it.
inline constexpr double target_fill = 0.5;

/// State redistribution (Berger & Giuliani 2021) of the small fragments of one block: every fragment below
/// half a cell shares its contents with a neighbourhood that reaches half a cell, so that a step is stable
/// whatever the size of a fragment. Volumes stay. All neighbourhoods are formed from one old state, and each
/// cell sums its shares in a fixed order: no block or rank sees another's result. Writes BodyBlock::updates.
/// A fragment that finds no neighbourhood goes, with its volume, to the nearest fragment above 0.3 of a cell.
template <int Dim>
void redistribute(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch);

}  // namespace recoil
