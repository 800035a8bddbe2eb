#include "timestep/seed_step.hpp"

#include "timestep/phases.hpp"

namespace recoil {

namespace {

constexpr int redistancing_sweeps = 2;  // of the whole band, every step

}  // namespace

template <int Dim>
double advance_seed(State<Dim>& state, const Stepping& stepping, double until, Engine& engine) {
  Phases<Dim> step{state, engine};

  const double dt = step.prepare_whole_cells(stepping, until);
  for (const ClassicStage& stage : rk4) {
    const bool last = &stage == &rk4.back();
    step.find_seed_ghosts(stepping.kappa, dt, stage.weight);  // contact or void, by the traction
    step.update_classic(FaceScheme::eno_llf, stage, last, dt);
    step.average_inadmissible_states();
    step.return_to_yield(stage.length * dt, 0);
    step.share(part_matter);
    step.refresh_averages();
  }
  step.find_seed_ghosts(stepping.kappa, dt, 0);  // of the new state, for the cells that the surfaces uncover

  // The level set goes with the walls and is redistanced everywhere.
  step.move_rigid_bodies(dt);
  step.advect_surfaces(dt);
  step.count_lost_contacts();
  step.remember_contact();
  step.redistance_all(redistancing_sweeps);
  step.cut_cells(Surfaces::own, PhiAt::now);
  step.to_cut_cells();
  step.update_bands();

  state.time += dt;
  ++state.step;
  return dt;
}

template double advance_seed<1>(State<1>&, const Stepping&, double, Engine&);
template double advance_seed<2>(State<2>&, const Stepping&, double, Engine&);
template double advance_seed<3>(State<3>&, const Stepping&, double, Engine&);

}  // namespace recoil
