#include "timestep/seed_step.hpp"

#include "timestep/whole_cell_phases.hpp"

namespace recoil {

namespace {

constexpr int redistancing_sweeps = 2;  // of the whole band, every step

}  // namespace

template <int Dim>
double advance_seed(State<Dim>& state, const Stepping& stepping, double until, Engine& engine) {
  StepRun<Dim> step(state, engine);

  const double dt = prepare_whole_cells(step, stepping, until);
  for (const ClassicStage& stage : rk4) {
    const bool last = &stage == &rk4.back();
    find_seed_ghosts(step, stepping.kappa, dt, stage.weight);  // contact or void, by the traction
    update_classic(step, FaceScheme::eno_llf, stage, last, dt);
    average_inadmissible_states(step);
    return_to_yield(step, stage.length * dt, 0);
    refresh_averages(step, 0);
  }
  fail_at_once(step);
  find_seed_ghosts(step, stepping.kappa, dt, 0);  // of the new state, for the cells that the surfaces uncover

  // The level set is advected with the walls and is redistanced everywhere.
  move_rigid_bodies(step, dt);
  advect_surfaces(step, dt);
  count_lost_contacts(step);
  remember_contact(step);
  redistance_band(step, redistancing_sweeps, -1);
  cut_cells(step, Surfaces::own, PhiAt::now);
  to_cut_cells(step);
  update_bands(step);

  state.time += dt;
  ++state.step;
  return dt;
}

template double advance_seed<1>(State<1>&, const Stepping&, double, Engine&);
template double advance_seed<2>(State<2>&, const Stepping&, double, Engine&);
template double advance_seed<3>(State<3>&, const Stepping&, double, Engine&);

}  // namespace recoil
