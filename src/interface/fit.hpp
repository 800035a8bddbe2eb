#pragma once

#include "core/scratch.hpp"
#include "state/body.hpp"

namespace recoil {

/// The fitted primitives at the surface points from the averages of this stage, limited to the donors' range
/// widened by half of it where they are calm; plastic strain, temperature rise and entropy are the weighted
/// means only.
template <int Dim>
void evaluate_fits(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch);

/// Moves the fitted primitives on by `time` [s] at the surface point, by their own gradients, with the
/// plastic tangent where the surface yields and goes on loading.
template <int Dim>
void move_fits(const State<Dim>& state, Body<Dim>& body, int slot, double time);

}  // namespace recoil
