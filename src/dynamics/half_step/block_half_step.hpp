#pragma once

#include "core/scratch.hpp"
#include "dynamics/block_work.hpp"
#include "state/body.hpp"

namespace recoil::detail {

/// Readies a block for a step of one stage: which cells yield and go on loading, and what half a step by
/// unlimited differences along each axis changes. Into Work::ahead.
/// @param dt of the whole step [s].
template <int Dim>
void find_half_step(const Body<Dim>& body, double dt, Work<Dim>& work, Scratch& scratch);

/// What half a step by the other axes changes in the cells beside the faces across `Axis`: T, by upwind
/// differences, and what half a step along `Axis` makes of T. Into HalfStep::across, from `scratch`.
template <int Dim, int Axis>
void find_across(Work<Dim>& work, Scratch& scratch);

/// Moves the averages themselves to the middle of the step; the fluxes no longer need them.
template <int Dim>
void move_to_midstep(Work<Dim>& work);

}  // namespace recoil::detail
