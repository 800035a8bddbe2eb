#pragma once

#include "timestep/phases.hpp"

/// Phases of the conservative scheme only.
namespace recoil {

/// The velocity of rigid bodies that have one over time, for this step.
template <int Dim>
void drive_rigid_bodies(StepRun<Dim>& step, double dt);
/// Says which cells of matter that never yields lie beside a contact.
template <int Dim>
void mark_beside_contact(StepRun<Dim>& step);
/// Fits, contacts and walls of the start of a stage.
template <int Dim>
void find_walls(StepRun<Dim>& step, double dt, const Stage& stage);
/// The same of the middle of the step, for a stage whose values at faces are of then; else nothing.
template <int Dim>
void move_walls(StepRun<Dim>& step, double dt, const Stage& stage);
/// Q += dt R, V += dt R_V.
template <int Dim>
void update_matter(StepRun<Dim>& step, double dt, const Stage& stage);
/// Which cells redistribution may read around the blocks of other processes in this step.
template <int Dim>
void mark_around_small(StepRun<Dim>& step);
template <int Dim>
void redistribute_small_fragments(StepRun<Dim>& step);
/// No level set reaches into a rigid body.
template <int Dim>
void cut_out_rigid_bodies(StepRun<Dim>& step);
template <int Dim>
void exchange_along_surfaces(StepRun<Dim>& step);
template <int Dim>
void follow_volumes(StepRun<Dim>& step);
template <int Dim>
void empty_and_fill(StepRun<Dim>& step, double dt);
template <int Dim>
void bound_volumes(StepRun<Dim>& step);
/// Fragments of matter that can fail keep their level sets.
template <int Dim>
void restore_level_sets(StepRun<Dim>& step);
/// Opens the level sets of failed matter where its voids are resolved.
template <int Dim>
void open_voids(StepRun<Dim>& step);
/// Explosives set free what their detonations bring until the end of the step.
template <int Dim>
void release_detonations(StepRun<Dim>& step, double dt);
/// Matter that came to cells of failed matter, and matter whose damage model has no rate, after all moves.
template <int Dim>
void fail_what_moved(StepRun<Dim>& step);
/// What is left of plastic strain below zero after the step; counted.
template <int Dim>
void clear_negative_strain(StepRun<Dim>& step);

}  // namespace recoil
