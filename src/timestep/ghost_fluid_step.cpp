#include "timestep/ghost_fluid_step.hpp"

#include "timestep/phases.hpp"

namespace recoil {

namespace {

constexpr double closing_rate = 0.05;  // part of a gap or overlap in contact that is closed in a step

}  // namespace

template <int Dim>
double advance_ghost_fluid(State<Dim>& state, const Stepping& stepping, double until, Engine& engine) {
  Phases<Dim> step{state, engine};

  const double dt = step.prepare_whole_cells(stepping, until);
  for (const Stage& stage : ssp_rk3) {
    step.find_ghosts(dt, stage.weight);  // contact: touch, slide, separate
    step.update_whole_cells(FaceScheme::weno_hllc, dt, stage.weight);
    step.average_inadmissible_states();
    step.return_to_yield(dt, stage.old_weight);  // then the Runge-Kutta mean
    step.share(part_matter);
    step.refresh_averages();
  }
  step.find_ghosts(dt, 0);  // of the new state, for the cells that the surfaces uncover

  // The level set goes with the walls, almost without redistancing beside the surface.
  step.move_rigid_bodies(dt);
  step.advect_surfaces(dt);
  step.count_lost_contacts();
  step.remember_contact();
  step.redistance(dt);
  step.cut_cells(Surfaces::own, PhiAt::now);
  step.close_gaps(closing_rate);
  step.cut_cells(Surfaces::own, PhiAt::now);
  step.to_cut_cells();
  step.update_bands();

  state.time += dt;
  ++state.step;
  return dt;
}

template <int Dim>
void prepare_whole_cell_start(State<Dim>& state, Engine& engine) {
  prepare_start(state, engine);
  Phases<Dim> start{state, engine};
  start.cut_cells(Surfaces::own, PhiAt::now);
  start.to_cut_cells();
}

template double advance_ghost_fluid<1>(State<1>&, const Stepping&, double, Engine&);
template double advance_ghost_fluid<2>(State<2>&, const Stepping&, double, Engine&);
template double advance_ghost_fluid<3>(State<3>&, const Stepping&, double, Engine&);
template void prepare_whole_cell_start<1>(State<1>&, Engine&);
template void prepare_whole_cell_start<2>(State<2>&, Engine&);
template void prepare_whole_cell_start<3>(State<3>&, Engine&);

}  // namespace recoil
