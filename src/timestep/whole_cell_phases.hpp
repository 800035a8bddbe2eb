#pragma once

#include "dynamics/block_update.hpp"
#include "dynamics/classic_stages.hpp"
#include "timestep/phases.hpp"

/// Phases of the schemes that keep matter in whole cells: ghost-fluid and seed (docs/seed-scheme.md).
namespace recoil {

/// The start of a step: whole cells, the stable step (returned), the surfaces half a step on, donors.
template <int Dim>
double prepare_whole_cells(StepRun<Dim>& step, const Stepping& stepping, double until);
/// Riemann-Signorini states of all walls, and the ghost values that they give.
template <int Dim>
void find_ghosts(StepRun<Dim>& step, double dt, double weight);
/// The same by the traction rule of the seed scheme.
template <int Dim>
void find_seed_ghosts(StepRun<Dim>& step, double kappa, double dt, double weight);
template <int Dim>
void update_whole_cells(StepRun<Dim>& step, FaceScheme scheme, double dt, double weight);
/// One stage of the classical Runge-Kutta rule: Q = Q_old + length dt R, or the whole step if it is the last.
template <int Dim>
void update_classic(StepRun<Dim>& step, FaceScheme scheme, const ClassicStage& stage, bool last, double dt);
/// Counts cut cells that no longer touch what they touched in the last step.
template <int Dim>
void count_lost_contacts(StepRun<Dim>& step);
/// Moves surfaces in contact a little (part `rate` of what is left) onto each other.
template <int Dim>
void close_gaps(StepRun<Dim>& step, double rate);
template <int Dim>
void to_cut_cells(StepRun<Dim>& step);

}  // namespace recoil
