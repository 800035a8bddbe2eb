#pragma once

#include "core/scratch.hpp"
#include "dynamics/block_work.hpp"
#include "state/body.hpp"

namespace recoil::detail {

/// Readies a block for a step of one stage: which cells yield and go on loading, and what half a step by
/// unlimited central differences along all axes changes. Into Work::ahead and Work::change.
/// @param dt of the whole step [s].
template <int Dim>
void find_half_step(const Body<Dim>& body, double dt, Work<Dim>& work, Scratch& scratch);

/// What half a step changes by the axes other than this one: faces across it get that on top of what they
/// find along it. Into Work::ahead.
template <int Dim>
void find_transverse(double g, int axis, Work<Dim>& work);

/// Moves the averages themselves to the middle of the step; the fluxes no longer need them.
template <int Dim>
void move_to_midstep(Work<Dim>& work);

}  // namespace recoil::detail
