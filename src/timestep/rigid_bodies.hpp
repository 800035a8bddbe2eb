#pragma once

#include "cutcell/geometry.hpp"
#include "timestep/step_run.hpp"

namespace recoil {

/// Takes the velocities of bodies with a history for the coming step of dt [s].
template <int Dim>
void follow_velocity_histories(State<Dim>& state, double dt);

/// Moves all rigid bodies to the end of a step of dt [s]: prescribed ones with their velocity, free ones with
/// what their contacts have given them since the start (BlockLedger::pairs), summed in the order of the
/// blocks. Collective where there is a free one.
template <int Dim>
void move_rigid_bodies(State<Dim>& state, const parallel::World& world, double dt);

/// The level sets of rigid bodies `ahead` seconds from now. Not collective.
template <int Dim>
void place_rigid_bodies(StepRun<Dim>& step, double ahead, PhiAt where);

}  // namespace recoil
