#include "timestep/step.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "timestep/conservative_phases.hpp"

namespace recoil {

template <int Dim>
double advance(State<Dim>& state, const Stepping& stepping, double until, Engine& engine) {
  StepRun<Dim> step(state, engine);

  // The start of the step: averages, the stable step, and the geometry half a step on.
  average_states(step);
  const double dt = choose_length(step, stepping, until);
  drive_rigid_bodies(step, dt);
  const auto stages = stages_of(stepping.stages);
  if (stages.size() > 1) keep_old(step);
  advect_surfaces_half(step, dt);
  cut_cells(step, Surfaces::shared, PhiAt::midstep, 0.5 * dt);
  choose_donors_and_ghosts(step);
  if (stages.size() > 1) mark_beside_contact(step);  // one stage would grow with what is done there
  mark_around_small(step);                           // for messages between processes

  for (const Stage& stage : stages) {
    find_walls(step, dt, stage);     // contact: touch, slide, separate
    fill_values(step);               // ghost values of the walls
    move_walls(step, dt, stage);     // to the middle of the step, where it has one stage
    update_matter(step, dt, stage);  // Q += dt R, V += dt R_V
    redistribute_small_fragments(step);
    average_inadmissible_states(step, stage.most_damage);
    return_to_yield(step, dt, stage.old_weight, stage.most_damage);  // then the Runge-Kutta mean
    refresh_averages(step, stage.old_weight);
  }
  fail_at_once(step);

  // The level set is advected with the walls, then follows the volumes; volume moves only with its contents.
  move_rigid_bodies(step, dt);
  advect_surfaces(step, dt);
  remember_contact(step);
  redistance(step, dt);
  restore_level_sets(step);
  cut_out_rigid_bodies(step);
  cut_cells(step, Surfaces::own, PhiAt::now);
  exchange_along_surfaces(step);
  follow_volumes(step);
  cut_cells(step, Surfaces::shared, PhiAt::now);
  empty_and_fill(step, dt);
  bound_volumes(step);
  average_inadmissible_states(step);
  fail_what_moved(step);
  clear_negative_strain(step);
  release_detonations(step, dt);
  open_voids(step);
  update_bands(step);

  state.time += dt;
  ++state.step;
  return dt;
}

template <int Dim>
void prepare_start(State<Dim>& state, Engine& engine) {
  StepRun<Dim> start(state, engine);
  start.exchange(run_fields<Dim>());
  update_bands(start);
}

const char* name_of(StepPhase part) {
  constexpr std::array names{"averages", "geometry",       "fits",       "walls",     "values",
                             "flux",     "redistribution", "plasticity", "level set", "moves",
                             "exchange", "band",           "waiting"};
  return names[static_cast<std::size_t>(part)];
}

template double advance<1>(State<1>&, const Stepping&, double, Engine&);
template double advance<2>(State<2>&, const Stepping&, double, Engine&);
template double advance<3>(State<3>&, const Stepping&, double, Engine&);
template void prepare_start<1>(State<1>&, Engine&);
template void prepare_start<2>(State<2>&, Engine&);
template void prepare_start<3>(State<3>&, Engine&);

}  // namespace recoil
