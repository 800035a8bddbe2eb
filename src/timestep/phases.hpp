#pragma once

#include <array>
#include <span>

#include "cutcell/geometry.hpp"
#include "cutcell/whole_cells.hpp"
#include "dynamics/block_update.hpp"
#include "levelset/transport.hpp"
#include "timestep/step_run.hpp"

/// The phases that the schemes have in common; those of one scheme are in conservative_phases.hpp and
/// whole_cell_phases.hpp. A phase that changes the state is collective.
namespace recoil {

/// A stage of a step: a full Euler step from the values at faces of its start or of its middle, mixed with
/// `old_weight` of the old state; `weight` is its own in the whole step.
struct Stage {
  double old_weight, weight;
  FaceTime faces = FaceTime::now;
  double most_damage = 1;  // how far damage may grow
};
/// How far damage may grow in one of several stages: beyond 1, so that the mean of the stages is 1 or more
/// where the step ends with failure. Cut off at 1 in each stage, the mean with the state before the step
/// would approach 1 by a factor of 3 a step: four steps too late where damage grows by 0.1 in one.
inline constexpr double most_damage_in_stage = 2;
/// SSP-RK3 (Shu & Osher 1988).
inline constexpr std::array<Stage, 3> ssp_rk3{{{0, 1.0 / 6, FaceTime::now, most_damage_in_stage},
                                               {0.75, 1.0 / 6, FaceTime::now, most_damage_in_stage},
                                               {1.0 / 3, 2.0 / 3, FaceTime::now, most_damage_in_stage}}};
/// One stage with values at faces, and walls, of the middle of the step.
inline constexpr std::array<Stage, 1> one_stage{{{0, 1, FaceTime::midstep}}};
inline std::span<const Stage> stages_of(StepStages stages) {
  if (stages == StepStages::one) return one_stage;
  return ssp_rk3;
}

/// Chooses the role of each fragment, and finds the primitives of all averages.
template <int Dim>
void average_states(StepRun<Dim>& step);
/// The stable step, cut to end at `until`. @throws PhysicsError if it collapses.
template <int Dim>
double choose_length(StepRun<Dim>& step, const Stepping& stepping, double until);
template <int Dim>
void keep_old(StepRun<Dim>& step);
/// phi_midstep = phi half a step on, with the last step's extension velocity.
template <int Dim>
void advect_surfaces_half(StepRun<Dim>& step, double dt);
/// @param ahead seconds from now to `when`.
template <int Dim>
void cut_cells(StepRun<Dim>& step, Surfaces surfaces, PhiAt when, double ahead = 0);
template <int Dim>
void choose_donors_and_ghosts(StepRun<Dim>& step, Cells cells = Cells::cut);

/// From averages to the values that reconstructions read.
template <int Dim>
void fill_values(StepRun<Dim>& step);
/// Averages inadmissible states with what is around them, in wider and wider windows, and counts them.
template <int Dim>
void average_inadmissible_states(StepRun<Dim>& step, double most_damage = 1);
/// Radial return, then the Runge-Kutta mean with `old_weight` of the old state.
/// @param most_damage how far damage may grow in the stage.
template <int Dim>
void return_to_yield(StepRun<Dim>& step, double dt, double old_weight, double most_damage = 1);
/// At the end of the stages: damage is at most 1, and matter fails whose damage model has no rate.
template <int Dim>
void fail_at_once(StepRun<Dim>& step);
/// Primitives of the new averages, with the roles of the step. @param old_weight of the Runge-Kutta mean that
/// they are.
template <int Dim>
void refresh_averages(StepRun<Dim>& step, double old_weight);

/// To the end of the step; free ones with what their contacts have given them.
template <int Dim>
void move_rigid_bodies(StepRun<Dim>& step, double dt);
/// Advects the level set with the walls' mean velocity over the step.
template <int Dim>
void advect_surfaces(StepRun<Dim>& step, double dt);
template <int Dim>
void remember_contact(StepRun<Dim>& step);
template <int Dim>
void redistance(StepRun<Dim>& step, double dt);
/// Redistances the whole band: `sweeps` of it. @param frozen [dx] phi nearer to the surface stays; -1: none.
/// @param most_nearer [dx] by which phi falls at most away from the surface: 2, that of a surface that moves
/// by a cell in a block that it has just entered, and 0.4 after level sets have been restored.
template <int Dim>
void redistance_band(StepRun<Dim>& step, int sweeps, double frozen, double most_nearer = 2);
inline constexpr double nearer_when_restored = 0.4;
/// Sweeps that bring the band back to a distance after it has changed at once.
inline constexpr int sweeps_all = 4;
/// What a phase has written to phi_next becomes phi.
template <int Dim>
void swap_phi(StepRun<Dim>& step);
/// Moves phi by a part of the mismatch (CutCell::mismatch of the end-of-step geometry).
template <int Dim>
void follow_mismatch(StepRun<Dim>& step, const Following& following);
/// Enters and leaves blocks as the surfaces move; brings all that output reads up to date.
template <int Dim>
void update_bands(StepRun<Dim>& step);
/// Puts BodyBlock::updates in place.
template <int Dim>
void apply_updates(StepRun<Dim>& step, StepPhase part);

}  // namespace recoil
