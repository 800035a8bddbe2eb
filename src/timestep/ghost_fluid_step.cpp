#include "timestep/ghost_fluid_step.hpp"

#include "timestep/whole_cell_phases.hpp"

namespace recoil {

namespace {

constexpr double closing_rate = 0.05;  // part of a gap or overlap in contact that is closed in a step

}  // namespace

template <int Dim>
double advance_ghost_fluid(State<Dim>& state, const Stepping& stepping, double until, Engine& engine) {
  StepRun<Dim> step(state, engine);

  const double dt = prepare_whole_cells(step, stepping, until);
  for (const Stage& stage : ssp_rk3) {
    find_ghosts(step, dt, stage.weight);  // contact: touch, slide, separate
    update_whole_cells(step, FaceScheme::weno_hllc, dt, stage.weight);
    average_inadmissible_states(step);
    return_to_yield(step, dt, stage.old_weight);  // then the Runge-Kutta mean
    refresh_averages(step, 0);
  }
  fail_at_once(step);
  find_ghosts(step, dt, 0);  // of the new state, for the cells that the surfaces uncover

  // The level set is advected with the walls, almost without redistancing beside the surface.
  move_rigid_bodies(step, dt);
  advect_surfaces(step, dt);
  count_lost_contacts(step);
  remember_contact(step);
  redistance(step, dt);
  cut_cells(step, Surfaces::own, PhiAt::now);
  close_gaps(step, closing_rate);
  cut_cells(step, Surfaces::own, PhiAt::now);
  to_cut_cells(step);
  update_bands(step);

  state.time += dt;
  ++state.step;
  return dt;
}

template <int Dim>
void prepare_whole_cell_start(State<Dim>& state, Engine& engine) {
  prepare_start(state, engine);
  StepRun<Dim> start(state, engine);
  cut_cells(start, Surfaces::own, PhiAt::now);
  to_cut_cells(start);
}

template double advance_ghost_fluid<1>(State<1>&, const Stepping&, double, Engine&);
template double advance_ghost_fluid<2>(State<2>&, const Stepping&, double, Engine&);
template double advance_ghost_fluid<3>(State<3>&, const Stepping&, double, Engine&);
template void prepare_whole_cell_start<1>(State<1>&, Engine&);
template void prepare_whole_cell_start<2>(State<2>&, Engine&);
template void prepare_whole_cell_start<3>(State<3>&, Engine&);

}  // namespace recoil
