#include "timestep/step.hpp"

#include <algorithm>

#include "timestep/phases.hpp"

namespace recoil {

template <int Dim>
double advance(State<Dim>& state, const Stepping& stepping, double until, Engine& engine) {
  Phases<Dim> step{state, engine};

  // The start of the step: averages, the stable step, and the geometry half a step on.
  step.average_states();
  const double dt = step.choose_length(stepping, until);
  step.keep_old();
  step.advect_surfaces_half(dt);
  step.cut_cells(Surfaces::shared, PhiAt::midstep, 0.5 * dt);
  step.choose_donors_and_ghosts();

  for (const Stage& stage : ssp_rk3) {
    step.share(part_average);
    step.find_walls(dt, stage.weight);  // contact: touch, slide, separate
    step.share(part_geometry);
    step.fill_values();  // ghosts speak for the walls
    step.share(part_average);
    step.update_matter(dt, stage.weight);  // Q += dt R, V += dt R_V
    step.share(part_matter);
    step.redistribute_small_fragments();
    step.average_inadmissible_states();
    step.return_to_yield(dt, stage.old_weight);  // then the Runge-Kutta mean
    step.share(part_matter);
    step.refresh_averages();
  }

  // The level set goes with the walls, then follows the volumes; volume moves only with its contents.
  step.move_rigid_bodies(dt);
  step.advect_surfaces(dt);
  step.remember_contact();
  step.redistance(dt);
  step.cut_out_rigid_bodies();
  step.cut_cells(Surfaces::own, PhiAt::now);
  step.exchange_along_surfaces();
  step.follow_volumes();
  step.cut_cells(Surfaces::shared, PhiAt::now);
  step.empty_and_fill();
  step.bound_volumes();
  step.average_inadmissible_states();
  step.update_bands();

  state.time += dt;
  ++state.step;
  return dt;
}

template <int Dim>
void prepare_start(State<Dim>& state, Engine& engine) {
  Phases<Dim> start{state, engine};
  start.share(part_phi | part_matter | part_contact);
  start.update_bands();
}

const char* name_of(StepPhase part) {
  constexpr std::array names{"averages",       "geometry",   "fits",      "walls", "values",   "flux",
                             "redistribution", "plasticity", "level set", "moves", "exchange", "band"};
  return names[static_cast<std::size_t>(part)];
}

template double advance<1>(State<1>&, const Stepping&, double, Engine&);
template double advance<2>(State<2>&, const Stepping&, double, Engine&);
template double advance<3>(State<3>&, const Stepping&, double, Engine&);
template void prepare_start<1>(State<1>&, Engine&);
template void prepare_start<2>(State<2>&, Engine&);
template void prepare_start<3>(State<3>&, Engine&);

}  // namespace recoil
