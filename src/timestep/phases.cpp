#include "timestep/phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "dynamics/damage/nonlocal_damage.hpp"
#include "dynamics/inadmissible.hpp"
#include "dynamics/plastic_return.hpp"
#include "dynamics/primitives.hpp"
#include "interface/donors.hpp"
#include "interface/ghosts.hpp"
#include "interface/values.hpp"
#include "interface/walls.hpp"
#include "levelset/band.hpp"
#include "levelset/transport.hpp"
#include "state/state_error.hpp"
#include "timestep/rigid_bodies.hpp"

namespace recoil {

namespace {

using enum Field;

constexpr double frozen_band = 1.6;          // [dx] phi nearer to the surface is not redistanced every step
constexpr double travel_to_redistance = 10;  // [dx] that surfaces move between full redistancings
constexpr double shortest_step = 1e-18;      // s

/// 0 where a process has no blocks.
double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, v);
  return most;
}

/// Whether the damage of a body comes from means over cells.
template <int Dim>
bool averages_damage(const Body<Dim>& body) {
  return !body.rigid && recoil::averages_damage(body.material);
}

}  // namespace

template <int Dim>
void swap_phi(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"swap phi", {}, {}, phi | phi_next};
  step.queue_each_body(StepPhase::level_set, access, [](Body<Dim>& body, int slot, Scratch&) {
    body.at(slot).phi.swap(body.at(slot).phi_next);
  });
}

template <int Dim>
void average_states(StepRun<Dim>& step) {
  static constexpr FieldAccess access{
      "average states", {}, contents | volume | phi, role | average | stencil};
  step.queue_each_body(StepPhase::averages, access, [&step](Body<Dim>& body, int slot, Scratch&) {
    choose_roles(step.state(), body, slot, step.counters(slot));
    average_primitives(step.state(), body, slot, step.counters(slot));
  });
}

template <int Dim>
void refresh_averages(StepRun<Dim>& step, double old_weight) {
  static constexpr FieldAccess access{
      "refresh averages", {}, contents | volume | contents_old | volume_old | role | phi, average | stencil};
  step.queue_each_body(StepPhase::averages, access, [&step, old_weight](Body<Dim>& body, int slot, Scratch&) {
    average_primitives(step.state(), body, slot, step.counters(slot),
                       old_weight > 0 ? AveragesOf::mean : AveragesOf::stage);
  });
}

template <int Dim>
double choose_length(StepRun<Dim>& step, const Stepping& stepping, double until) {
  static constexpr FieldAccess access{"choose length", {}, role | average | phi | extension_velocity, {}};
  const State<Dim>& state = step.state();
  const double sound = sound_in_step(Dim, stepping.stages, state.grid().radial_power);
  std::vector<double> signals(static_cast<std::size_t>(state.mesh.local()), 0);
  step.for_each_body(StepPhase::averages, access, [&](Body<Dim>& body, int slot, Scratch&) {
    double& f = signals[slot];
    f = std::max(f, fastest_signal(state, body, slot, sound, step.counters(slot)));
  });
  double signal = step.engine().world.max(largest(signals));
  for (const Body<Dim>& body : state.bodies)
    if (body.rigid && body.rigid->history)
      signal = std::max(signal, fastest<Dim>(*body.rigid->history) / state.grid().dx);
  const double stable = signal > 0 ? stepping.cfl / signal : until - state.time;
  const double dt = std::min(stepping.fixed_dt.value_or(stable), until - state.time);
  if (!(stable > shortest_step))
    throw PhysicsError(
        fmt::format("the time step collapsed to {:.3g} s at {:.6g} us", stable, state.time * 1e6));
  step.engine().unstable = dt * signal > largest_stable_cfl(stepping.stages);
  return dt;
}

template <int Dim>
void keep_old(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"keep old", {}, contents | volume, contents_old | volume_old};
  step.queue_each_body(StepPhase::plasticity, access, [](Body<Dim>& body, int slot, Scratch&) {
    BodyBlock<Dim>& b = body.at(slot);
    b.contents_old = b.contents;
    b.volume_old = b.volume;
  });
}

template <int Dim>
void advect_surfaces_half(StepRun<Dim>& step, double dt) {
  static constexpr FieldAccess access{"advect surfaces half", phi, extension_velocity,
                                      phi_midstep | phi_next};
  step.queue_each_body(
      StepPhase::level_set, access, [&step, dt](Body<Dim>& body, int slot, Scratch& scratch) {
        BodyBlock<Dim>& b = body.at(slot);
        if (b.phi_midstep.empty()) b.phi_midstep.swap(b.phi_next);  // which is over: they share their memory
        advect_level_set(step.state(), body, slot, 0.5 * dt, &BodyBlock<Dim>::phi_midstep, scratch);
      });
  place_rigid_bodies(step, 0.5 * dt, PhiAt::midstep);
}

template <int Dim>
void cut_cells(StepRun<Dim>& step, Surfaces surfaces, PhiAt when, double ahead) {
  static constexpr FieldAccess middle{"cut cells", phi_midstep | contact, volume, geometry},
      end{"cut cells at the end", phi | contact, volume, end_geometry};
  step.queue_each_slot(StepPhase::geometry, when == PhiAt::midstep ? middle : end,
                       [&step, surfaces, when, ahead](int slot, Scratch& scratch) {
                         find_geometry(step.state(), slot, surfaces, when, scratch, ahead);
                       });
}

template <int Dim>
void choose_donors_and_ghosts(StepRun<Dim>& step, Cells cells) {
  static constexpr FieldAccess fits{"choose donors", role | geometry | phi | volume | contact, contents,
                                    donors | walls},
      beyond{"choose ghosts", role | geometry | walls | phi, {}, ghosts};
  step.queue_each_body(StepPhase::fits, fits, [&step](Body<Dim>& body, int slot, Scratch& scratch) {
    choose_donors(step.state(), body, slot, step.counters(slot), scratch);
  });
  step.queue_each_body(StepPhase::fits, {beyond, {.walls = WallsSent::donors}},
                       [&step, cells](Body<Dim>& body, int slot, Scratch& scratch) {
                         choose_ghosts(step.state(), body, slot, cells, scratch);
                       });
  step.ask_for_cells();
}

template <int Dim>
void fill_values(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"fill values", walls, ghosts | geometry, average | stencil | role};
  step.queue_each_body(StepPhase::values, {access, {.walls = WallsSent::asked}},
                       [&step](Body<Dim>& body, int slot, Scratch&) {
                         fill_stencil_values(step.state(), body, slot, step.counters(slot));
                       });
}

template <int Dim>
void apply_updates(StepRun<Dim>& step, StepPhase part) {
  static constexpr FieldAccess access{"apply updates", {}, {}, contents | volume | updates};
  step.queue_each_body(part, access,
                       [](Body<Dim>& body, int slot, Scratch&) { apply_updates(body.at(slot)); });
}

/// Cells on each side of an inadmissible state that share a mean with it, one try after the other. Where many
/// lie side by side their widest means are not yet one: they are taken again before a run has to stop.
constexpr std::array averaged_widths{1, 2, 3, 3, 3, 3};

template <int Dim>
void average_inadmissible_states(StepRun<Dim>& step, double most_damage) {
  static constexpr FieldAccess mark{"mark inadmissible states", {}, volume, contents | role},
      mean{"average inadmissible states", role | contents | volume | end_geometry, {}, updates},
      clear{"clear marks", {}, {}, role};
  constexpr auto part = StepPhase::redistribution;
  make_room(step.engine().averaged, step.state());
  for (const int width : averaged_widths) {
    std::atomic<bool> any{false};
    step.for_each_body(part, mark, [&](Body<Dim>& body, int slot, Scratch&) {
      const std::int64_t marked =
          mark_inadmissible(step.state(), body, slot, step.counters(slot), most_damage);
      if (marked == 0) return;
      any.store(true, std::memory_order_relaxed);
      step.counters(slot).averaged_states += marked;
      note_averaged(step.engine().averaged, step.state(), body, slot, marked);
    });
    if (!step.engine().world.any(any.load())) return;
    step.queue_each_body(part, {mean, {3 * width}},
                         [&step, width](Body<Dim>& body, int slot, Scratch& scratch) {
                           average_inadmissible(step.state(), body, slot, width, scratch);
                         });
    apply_updates(step, part);
  }
  step.queue_each_body(part, clear,
                       [](Body<Dim>& body, int slot, Scratch&) { clear_inadmissible(body.at(slot)); });
}

template <int Dim>
void return_to_yield(StepRun<Dim>& step, double dt, double old_weight, double most_damage) {
  static constexpr FieldAccess access{"return to yield",
                                      {},
                                      contents_old | volume_old | stencil | average | role,
                                      contents | volume | damage_drive},
      grow{"grow damage", damage_drive, contents_old | volume_old, contents | volume};
  const auto grows_by_mean = [](const Body<Dim>& body) {
    return averages_damage(body) && !fails_at_once(body.material.damage);
  };
  const auto combine = [&step, old_weight](Body<Dim>& body, int slot) {
    if (old_weight > 0) combine_with_old(step.state(), body, slot, old_weight);
    // Of what has been combined: a mean of states on the crush curve is beyond it.
    crush_pores(step.state(), body, slot, step.counters(slot));
  };
  step.queue_each_body(StepPhase::plasticity, access,
                       [&step, dt, most_damage, grows_by_mean, combine](Body<Dim>& body, int slot, Scratch&) {
                         return_to_yield(step.state(), body, slot, dt, step.state().ledger[slot],
                                         most_damage);
                         if (!grows_by_mean(body)) combine(body, slot);
                       });
  if (std::ranges::none_of(step.state().bodies, grows_by_mean)) return;
  step.queue_each_body(
      StepPhase::plasticity, {grow, {averaged_cells(step.state())}},
      [&step, dt, most_damage, grows_by_mean, combine](Body<Dim>& body, int slot, Scratch& scratch) {
        if (!grows_by_mean(body)) return;
        grow_by_mean(step.state(), body, slot, dt, most_damage, step.state().ledger[slot], scratch);
        combine(body, slot);
      });
}

template <int Dim>
void fail_at_once(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"fail at once", {}, volume, contents | damage_drive},
      by_mean{"fail at once by means", damage_drive, volume, contents};
  const auto fails_by_mean = [](const Body<Dim>& body) {
    return averages_damage(body) && fails_at_once(body.material.damage);
  };
  step.queue_each_body(StepPhase::plasticity, access,
                       [&step, fails_by_mean](Body<Dim>& body, int slot, Scratch&) {
                         if (can_fail(body.material.damage)) bound_damage(step.state(), body, slot);
                         if (fails_by_mean(body))
                           note_damage_drive(step.state(), body, slot);
                         else
                           fail_at_once(step.state(), body, slot, step.state().ledger[slot]);
                       });
  if (std::ranges::none_of(step.state().bodies, fails_by_mean)) return;
  step.queue_each_body(StepPhase::plasticity, {by_mean, {averaged_cells(step.state())}},
                       [&step, fails_by_mean](Body<Dim>& body, int slot, Scratch& scratch) {
                         if (fails_by_mean(body))
                           fail_at_once_by_mean(step.state(), body, slot, step.state().ledger[slot], scratch);
                       });
}

template <int Dim>
void advect_surfaces(StepRun<Dim>& step, double dt) {
  static constexpr FieldAccess spread{"spread wall velocity", phi_midstep | geometry | walls, role | average,
                                      extension_velocity},
      first{"advect surfaces", phi, extension_velocity, phi_midstep | phi_next},
      again{"advect surfaces again", phi_next, extension_velocity, phi};
  const State<Dim>& state = step.state();
  step.queue_each_body(StepPhase::level_set, {spread, {.walls = WallsSent::motion}},
                       [&step, &state, dt](Body<Dim>& body, int slot, Scratch& scratch) {
                         spread_wall_velocity(state, body, slot, dt, step.counters(slot), scratch);
                       });
  step.queue_each_body(StepPhase::level_set, first,
                       [&state, dt](Body<Dim>& body, int slot, Scratch& scratch) {
                         body.at(slot).phi_next.swap(body.at(slot).phi_midstep);
                         advect_level_set(state, body, slot, dt, &BodyBlock<Dim>::phi_next, scratch);
                       });
  step.queue_each_body(StepPhase::level_set, again,
                       [&state, dt](Body<Dim>& body, int slot, Scratch& scratch) {
                         advect_level_set_again(state, body, slot, dt, scratch);
                       });
  place_rigid_bodies(step, 0, PhiAt::now);
}

template <int Dim>
void move_rigid_bodies(StepRun<Dim>& step, double dt) {
  step.run_queued();
  const Timers<StepPhase>::Span span(step.engine().timers, StepPhase::walls);
  move_rigid_bodies(step.state(), step.engine().world, dt);
}

template <int Dim>
void remember_contact(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"remember contact", {}, geometry | walls, contact};
  step.queue_each_body(StepPhase::walls, access,
                       [](Body<Dim>& body, int slot, Scratch&) { remember_contact(body.at(slot)); });
}

template <int Dim>
void redistance(StepRun<Dim>& step, double dt) {
  static constexpr FieldAccess access{"surface speed", {}, walls, {}};
  State<Dim>& state = step.state();
  std::vector<double> fastest(static_cast<std::size_t>(state.mesh.local()), 0);
  step.for_each_body(StepPhase::level_set, access, [&](Body<Dim>& body, int slot, Scratch&) {
    for (const Wall<Dim>& w : body.at(slot).walls)
      fastest[slot] = std::max(fastest[slot], norm(w.mean_velocity));
  });
  state.travel += dt * step.engine().world.max(largest(fastest));
  const bool all = state.travel > travel_to_redistance * step.grid().dx;
  if (all) state.travel = 0;
  redistance_band(step, all ? sweeps_all : 2, all ? -1 : frozen_band);
}

template <int Dim>
void redistance_band(StepRun<Dim>& step, int sweeps, double frozen, double most_nearer) {
  static constexpr FieldAccess access{"redistance", phi, {}, phi_next | phi_midstep};
  step.queue_each_body(StepPhase::level_set, access,
                       [&step, sweeps, frozen, most_nearer](Body<Dim>& body, int slot, Scratch& scratch) {
                         BodyBlock<Dim>& b = body.at(slot);
                         if (b.phi_next.empty())
                           b.phi_next.swap(b.phi_midstep);  // of a block that the body has just entered
                         if (b.near_surface)
                           redistance(step.state(), body, slot, sweeps, frozen, most_nearer, scratch);
                         else
                           b.phi_next = b.phi;
                       });
  swap_phi(step);
}

template <int Dim>
void follow_mismatch(StepRun<Dim>& step, const Following& following) {
  static constexpr FieldAccess access{"follow mismatch", phi | end_geometry, {}, phi_next | lag};
  step.queue_each_body(StepPhase::level_set, access,
                       [&step, following](Body<Dim>& body, int slot, Scratch& scratch) {
                         follow_volume(step.state(), body, slot, following, scratch);
                       });
  swap_phi(step);
}

template <int Dim>
void update_bands(StepRun<Dim>& step) {
  State<Dim>& state = step.state();
  step.update_copies(phi | volume);
  step.fill_stand_ins(phi);
  step.run_queued();
  {
    const Timers<StepPhase>::Span span(step.engine().timers, StepPhase::band);
    const auto bodies = static_cast<std::size_t>(state.count());
    std::vector<BandChoice<Dim>> choice(static_cast<std::size_t>(state.mesh.local()) * bodies);
    step.for_each_own([&](int slot, Scratch& scratch) {
      for (std::size_t m = 0; m < bodies; ++m)
        choice[slot * bodies + m] = choose_band(state, state.bodies[m], slot, scratch);
    });
    for (int slot = 0; slot < state.mesh.local(); ++slot)
      for (std::size_t m = 0; m < bodies; ++m) {
        Body<Dim>& body = state.bodies[m];
        const bool entered = !body.present(slot);
        apply_band(state, body, slot, choice[slot * bodies + m]);
        if (entered && body.rigid && body.present(slot)) place_rigid(state, body, slot, 0, PhiAt::now);
      }
    // Where a body enters a block, there and in the copies, its phi is far; that of a rigid one is found.
    const bool same_phi =
        std::ranges::none_of(state.bodies, [](const Body<Dim>& body) { return body.rigid.has_value(); });
    step.has_changed(same_phi ? FieldSet::all() - phi : FieldSet::all());
  }
  // What the start of the next step and what stands between steps read.
  const bool contents_too = state.mesh.levels() > 1 || step.engine().contents_between_steps;
  const FieldSet changed = state.stale.has(phi) ? volume | contact | phi : volume | contact;
  step.exchange(contents_too ? changed | contents : changed, {widest_halo, ContentsSent::between_steps});
  step.run_queued();
  step.fill_stand_ins(contents | volume | phi);
}

#define RECOIL_INSTANTIATE(Dim)                                               \
  template void average_states<Dim>(StepRun<Dim>&);                           \
  template void refresh_averages<Dim>(StepRun<Dim>&, double);                 \
  template double choose_length<Dim>(StepRun<Dim>&, const Stepping&, double); \
  template void keep_old<Dim>(StepRun<Dim>&);                                 \
  template void advect_surfaces_half<Dim>(StepRun<Dim>&, double);             \
  template void cut_cells<Dim>(StepRun<Dim>&, Surfaces, PhiAt, double);       \
  template void choose_donors_and_ghosts<Dim>(StepRun<Dim>&, Cells);          \
  template void fill_values<Dim>(StepRun<Dim>&);                              \
  template void apply_updates<Dim>(StepRun<Dim>&, StepPhase);                 \
  template void average_inadmissible_states<Dim>(StepRun<Dim>&, double);      \
  template void return_to_yield<Dim>(StepRun<Dim>&, double, double, double);  \
  template void fail_at_once<Dim>(StepRun<Dim>&);                             \
  template void advect_surfaces<Dim>(StepRun<Dim>&, double);                  \
  template void move_rigid_bodies<Dim>(StepRun<Dim>&, double);                \
  template void remember_contact<Dim>(StepRun<Dim>&);                         \
  template void redistance<Dim>(StepRun<Dim>&, double);                       \
  template void swap_phi<Dim>(StepRun<Dim>&);                                 \
  template void redistance_band<Dim>(StepRun<Dim>&, int, double, double);     \
  template void follow_mismatch<Dim>(StepRun<Dim>&, const Following&);        \
  template void update_bands<Dim>(StepRun<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
