#include "timestep/phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "cutcell/moves.hpp"
#include "cutcell/redistribution.hpp"
#include "dynamics/plastic_return.hpp"
#include "dynamics/primitives.hpp"
#include "interface/fit.hpp"
#include "interface/values.hpp"
#include "interface/walls.hpp"
#include "levelset/band.hpp"
#include "levelset/transport.hpp"
#include "timestep/rigid_bodies.hpp"

namespace recoil {

namespace {

constexpr double follow_rate = 0.02;         // part of the mismatch that phi takes up in a step
constexpr double frozen_band = 1.6;          // [dx] phi nearer to the surface is not redistanced every step
constexpr double travel_to_redistance = 10;  // [dx] that surfaces move between full redistancings
constexpr double shortest_step = 1e-18;      // s

/// 0 where a process has no blocks.
double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, v);
  return most;
}

}  // namespace

template <int Dim>
Phases<Dim>::Phases(State<Dim>& state, Engine& engine) : state_(state), engine_(engine) {
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    for (const Body<Dim>& body : state.bodies)
      if (!body.rigid && body.present(slot)) {
        blocks_.push_back(slot);
        break;
      }
}

template <int Dim>
void Phases<Dim>::share(unsigned parts) {
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::exchange);
  recoil::share(state_, engine_.world, parts);
}

template <int Dim>
void Phases<Dim>::average_states() {
  for_each_body(StepPhase::averages, [&](Body<Dim>& body, int slot, Scratch&) {
    choose_roles(state_, body, slot, counters(slot));
    average_primitives(state_, body, slot, counters(slot));
  });
}

template <int Dim>
void Phases<Dim>::refresh_averages() {
  for_each_body(StepPhase::averages, [&](Body<Dim>& body, int slot, Scratch&) {
    average_primitives(state_, body, slot, counters(slot));
  });
}

template <int Dim>
double Phases<Dim>::choose_length(const Stepping& stepping, double until) {
  std::vector<double> fastest(static_cast<std::size_t>(state_.mesh.local()), 0);
  for_each_body(StepPhase::averages, [&](Body<Dim>& body, int slot, Scratch&) {
    double& f = fastest[slot];
    f = std::max(f, fastest_signal(state_, body, slot, counters(slot)));
  });
  const double signal = engine_.world.max(largest(fastest));
  const double stable = signal > 0 ? stepping.cfl / signal : until - state_.time;
  const double dt = std::min(stepping.fixed_dt.value_or(stable), until - state_.time);
  if (!(stable > shortest_step))
    throw PhysicsError(
        fmt::format("the time step collapsed to {:.3g} s at {:.6g} us", stable, state_.time * 1e6));
  return dt;
}

template <int Dim>
void Phases<Dim>::keep_old() {
  for_each_body(StepPhase::plasticity, [&](Body<Dim>& body, int slot, Scratch&) {
    BodyBlock<Dim>& b = body.at(slot);
    b.contents_old = b.contents;
    b.volume_old = b.volume;
  });
}

template <int Dim>
void Phases<Dim>::advect_surfaces_half(double dt) {
  for_each_body(StepPhase::level_set, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    advect_level_set(state_, body, slot, 0.5 * dt, scratch);
  });
  place_rigid_bodies(0.5 * dt, PhiAt::midstep);
  share(part_phi_next);
}

template <int Dim>
void Phases<Dim>::cut_cells(Surfaces surfaces, PhiAt when, double ahead) {
  for_each_slot(StepPhase::geometry, [&](int slot, Scratch& scratch) {
    find_geometry(state_, slot, surfaces, when, scratch, ahead);
  });
  share(when == PhiAt::midstep ? part_geometry : part_end_geometry);
}

template <int Dim>
void Phases<Dim>::choose_donors_and_ghosts(Cells cells) {
  share(part_average);
  for_each_body(StepPhase::fits, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    choose_donors(state_, body, slot, counters(slot), scratch);
  });
  share(part_geometry);
  for_each_body(StepPhase::fits, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    choose_ghosts(state_, body, slot, cells, scratch);
  });
}

template <int Dim>
void Phases<Dim>::find_walls(double dt, double weight) {
  for_each_slot(StepPhase::walls, [&](int slot, Scratch& scratch) {
    for (Body<Dim>& body : state_.bodies)
      if (!body.rigid && body.present(slot)) evaluate_fits(state_, body, slot);
    recoil::find_walls(state_, slot, dt, weight, scratch);
  });
}

template <int Dim>
void Phases<Dim>::fill_values() {
  for_each_body(StepPhase::values, [&](Body<Dim>& body, int slot, Scratch&) {
    fill_stencil_values(state_, body, slot, counters(slot));
  });
}

template <int Dim>
void Phases<Dim>::update_matter(double dt, double weight) {
  for_each_slot(StepPhase::flux, [&](int slot, Scratch& scratch) {
    for (int m = 0; m < state_.count(); ++m) {
      Body<Dim>& body = state_.bodies[m];
      if (body.rigid || !body.present(slot)) continue;
      const Scratch::Frame frame(scratch);
      auto& ledger = state_.ledger[slot];
      update_block(state_, body, slot, dt, weight, ledger.edges[m], ledger.counters, scratch);
    }
  });
}

template <int Dim>
void Phases<Dim>::apply(StepPhase part) {
  for_each_body(part, [](Body<Dim>& body, int slot, Scratch&) { apply_updates(body.at(slot)); });
  share(part_matter);
}

template <int Dim>
void Phases<Dim>::redistribute_small_fragments() {
  for_each_body(StepPhase::redistribution, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    redistribute(state_, body, slot, counters(slot), scratch);
  });
  apply(StepPhase::redistribution);
}

template <int Dim>
void Phases<Dim>::average_inadmissible_states() {
  for (int width = 1; width <= 3; ++width) {
    for_each_body(StepPhase::redistribution, [&](Body<Dim>& body, int slot, Scratch&) {
      counters(slot).averaged_states += mark_inadmissible(state_, body, slot);
    });
    std::int64_t bad = 0;
    for (const int slot : blocks_)
      for (const Body<Dim>& body : state_.bodies)
        if (!body.rigid && body.present(slot)) bad += has_inadmissible(body.at(slot));
    if (!engine_.world.any(bad > 0)) return;
    share(part_average);
    for_each_body(StepPhase::redistribution, [&](Body<Dim>& body, int slot, Scratch& scratch) {
      average_inadmissible(state_, body, slot, width, scratch);
    });
    apply(StepPhase::redistribution);
  }
  for_each_body(StepPhase::redistribution,
                [&](Body<Dim>& body, int slot, Scratch&) { clear_inadmissible(body.at(slot)); });
}

template <int Dim>
void Phases<Dim>::return_to_yield(double dt, double old_weight) {
  for_each_body(StepPhase::plasticity, [&](Body<Dim>& body, int slot, Scratch&) {
    recoil::return_to_yield(state_, body, slot, dt);
    if (old_weight > 0) combine_with_old(state_, body, slot, old_weight);
  });
}

template <int Dim>
void Phases<Dim>::swap_phi() {
  for (const int slot : blocks_)
    for (Body<Dim>& body : state_.bodies)
      if (!body.rigid && body.present(slot)) std::swap(body.at(slot).phi, body.at(slot).phi_next);
  share(part_phi);
}

template <int Dim>
void Phases<Dim>::advect_surfaces(double dt) {
  for_each_body(StepPhase::level_set, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    spread_wall_velocity(state_, body, slot, dt, counters(slot), scratch);
  });
  for_each_body(StepPhase::level_set, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    advect_level_set(state_, body, slot, dt, scratch);
  });
  share(part_phi_next);
  for_each_body(StepPhase::level_set, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    advect_level_set_again(state_, body, slot, dt, scratch);
  });
  place_rigid_bodies(0, PhiAt::now);
  share(part_phi);
}

template <int Dim>
void Phases<Dim>::cut_out_rigid_bodies() {
  const auto rigid = [](const Body<Dim>& body) { return body.rigid.has_value(); };
  if (std::none_of(state_.bodies.begin(), state_.bodies.end(), rigid)) return;
  for_each_body(StepPhase::level_set,
                [&](Body<Dim>& body, int slot, Scratch&) { cut_out_rigid(state_, body, slot); });
  share(part_phi);
}

template <int Dim>
void Phases<Dim>::place_rigid_bodies(double ahead, PhiAt where) {
  for (Body<Dim>& body : state_.bodies)
    for (int slot = 0; slot < state_.mesh.local(); ++slot)
      if (body.rigid && body.present(slot)) place_rigid(state_, body, slot, ahead, where);
}

template <int Dim>
void Phases<Dim>::move_rigid_bodies(double dt) {
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::walls);
  recoil::move_rigid_bodies(state_, engine_.world, dt);
}

template <int Dim>
void Phases<Dim>::remember_contact() {
  for_each_body(StepPhase::walls,
                [](Body<Dim>& body, int slot, Scratch&) { recoil::remember_contact(body.at(slot)); });
  share(part_contact);
}

template <int Dim>
void Phases<Dim>::redistance(double dt) {
  std::vector<double> fastest(static_cast<std::size_t>(state_.mesh.local()), 0);
  for_each_body(StepPhase::level_set, [&](Body<Dim>& body, int slot, Scratch&) {
    for (const Wall<Dim>& w : body.at(slot).walls)
      fastest[slot] = std::max(fastest[slot], norm(w.mean_velocity));
  });
  state_.travel += dt * engine_.world.max(largest(fastest));
  const bool all = state_.travel > travel_to_redistance * state_.grid().dx;
  if (all) state_.travel = 0;
  for_each_body(StepPhase::level_set, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    if (body.at(slot).near_surface)
      recoil::redistance(state_, body, slot, all ? 4 : 2, all ? -1 : frozen_band, scratch);
    else
      body.at(slot).phi_next = body.at(slot).phi;
  });
  swap_phi();
}

template <int Dim>
void Phases<Dim>::exchange_along_surfaces() {
  if (Dim == 1) return;
  for_each_body(StepPhase::moves, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    exchange_along_surface(state_, body, slot, scratch);
  });
  apply(StepPhase::moves);
}

template <int Dim>
void Phases<Dim>::follow_volumes() {
  for_each_body(StepPhase::level_set,
                [&](Body<Dim>& body, int slot, Scratch&) { measure_mismatch(state_, body, slot); });
  follow_mismatch(follow_rate);
}

template <int Dim>
void Phases<Dim>::follow_mismatch(double rate) {
  share(part_end_geometry);
  for_each_body(StepPhase::level_set, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    follow_volume(state_, body, slot, rate, scratch);
  });
  swap_phi();
}

template <int Dim>
void Phases<Dim>::empty_and_fill() {
  for_each_body(StepPhase::moves, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    empty_outside(state_, body, slot, scratch);
  });
  apply(StepPhase::moves);
  for_each_body(StepPhase::moves, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    fill_inside(state_, body, slot, scratch);
  });
  apply(StepPhase::moves);
}

template <int Dim>
void Phases<Dim>::bound_volumes() {
  for_each_body(StepPhase::moves, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    recoil::bound_volumes(state_, body, slot, counters(slot), scratch);
  });
  apply(StepPhase::moves);
}

template <int Dim>
void Phases<Dim>::update_bands() {
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::band);
  std::vector<int> all(static_cast<std::size_t>(state_.mesh.local()));
  std::iota(all.begin(), all.end(), 0);
  const auto bodies = static_cast<std::size_t>(state_.count());
  std::vector<BandChoice<Dim>> choice(all.size() * bodies);
  parallel::for_each_block(engine_.team, all, [&](int slot, Scratch& scratch) {
    for (std::size_t m = 0; m < bodies; ++m)
      choice[static_cast<std::size_t>(slot) * bodies + m] =
          choose_band(state_, state_.bodies[m], slot, scratch);
  });
  for (const int slot : all)
    for (std::size_t m = 0; m < bodies; ++m) {
      Body<Dim>& body = state_.bodies[m];
      const bool entered = !body.present(slot);
      apply_band(state_, body, slot, choice[static_cast<std::size_t>(slot) * bodies + m]);
      if (entered && body.rigid && body.present(slot)) place_rigid(state_, body, slot, 0, PhiAt::now);
    }
  recoil::share(state_, engine_.world, part_phi | part_matter | part_contact);
}

template class Phases<1>;
template class Phases<2>;
template class Phases<3>;

}  // namespace recoil
