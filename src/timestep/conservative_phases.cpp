#include "timestep/conservative_phases.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cutcell/around_small.hpp"
#include "cutcell/moves.hpp"
#include "cutcell/redistribution.hpp"
#include "cutcell/surface_exchange.hpp"
#include "dynamics/block_update.hpp"
#include "dynamics/open_voids.hpp"
#include "dynamics/plastic_return.hpp"
#include "interface/fit.hpp"
#include "interface/walls.hpp"
#include "levelset/transport.hpp"
#include "material/eos/isentrope.hpp"
#include "state/beside_contact.hpp"
#include "timestep/detonation.hpp"
#include "timestep/rigid_bodies.hpp"

namespace recoil {

namespace {

using enum Field;

constexpr Following following{.rate = 0.02, .rate_failed = 0.3, .growth_beside_bodies = true};

}  // namespace

template <int Dim>
void drive_rigid_bodies(StepRun<Dim>& step, double dt) {
  step.run_queued();
  follow_velocity_histories(step.state(), dt);
}

template <int Dim>
void mark_beside_contact(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"mark beside contact", contact, {}, role};
  step.queue_each_body(StepPhase::fits, access, [&step](Body<Dim>& body, int slot, Scratch& scratch) {
    mark_beside_contact(step.state(), body, slot, scratch);
  });
}

template <int Dim>
void find_walls(StepRun<Dim>& step, double dt, const Stage& stage) {
  static constexpr FieldAccess access{"find walls", average | phi | contact,
                                      geometry | donors | contents | volume, walls};
  State<Dim>& state = step.state();
  const double booked = stage.faces == FaceTime::now ? stage.weight : 0;
  const ReadAround read{.averages = AveragesSent::asked};
  step.queue_each_slot(StepPhase::walls, {access, read},
                       [&step, &state, dt, booked](int slot, Scratch& scratch) {
                         for (Body<Dim>& body : state.bodies)
                           if (!body.rigid && body.present(slot))
                             evaluate_fits(state, body, slot, step.counters(slot), scratch);
                         find_walls(state, slot, dt, booked, scratch);
                       });
}

template <int Dim>
void move_walls(StepRun<Dim>& step, double dt, const Stage& stage) {
  static constexpr FieldAccess access{"move walls", phi | contact, geometry | volume, walls};
  if (stage.faces == FaceTime::now) return;
  State<Dim>& state = step.state();
  step.queue_each_slot(StepPhase::walls, access,
                       [&state, dt, weight = stage.weight](int slot, Scratch& scratch) {
                         for (Body<Dim>& body : state.bodies)
                           if (!body.rigid && body.present(slot)) move_fits(state, body, slot, 0.5 * dt);
                         find_walls(state, slot, dt, weight, scratch);
                       });
}

template <int Dim>
void update_matter(StepRun<Dim>& step, double dt, const Stage& stage) {
  static constexpr FieldAccess access{"update matter", stencil | role, geometry | walls,
                                      contents | volume | rims},
      coarser{"update coarser matter", stencil | role | rims, geometry | walls, contents | volume | rims};
  State<Dim>& state = step.state();
  step.fill_stand_ins(stencil);
  const auto update = [&state, dt, stage](int slot, Scratch& scratch) {
    for (int m = 0; m < state.count(); ++m) {
      Body<Dim>& body = state.bodies[m];
      if (body.rigid || !body.present(slot)) continue;
      const Scratch::Frame frame(scratch);
      auto& ledger = state.ledger[slot];
      update_block(state, body, slot, stage.faces, dt, stage.weight, ledger.edges[m], ledger.counters,
                   scratch);
    }
  };
  if (state.mesh.levels() == 1) return step.queue_each_slot(StepPhase::flux, access, update);
  // A block takes its fluxes beside finer ones from those.
  for (int level = 0; level < state.mesh.levels(); ++level)
    step.for_each_slot_of(level, StepPhase::flux, level == 0 ? access : coarser, update);
}

template <int Dim>
void mark_around_small(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"mark around small fragments", volume | geometry, {}, {}};
  if (step.state().mesh.peers().empty()) return;
  step.queue_each_body(StepPhase::exchange, access, [&step](Body<Dim>& body, int slot, Scratch& scratch) {
    step.around_small().of(slot, static_cast<std::size_t>(&body - step.state().bodies.data())) =
        mark_around_small(step.state(), body, slot, scratch);
  });
}

template <int Dim>
void redistribute_small_fragments(StepRun<Dim>& step) {
  static constexpr FieldAccess access{
      "redistribute", contents | volume | geometry | phi | role | walls, {}, updates};
  step.queue_each_body(
      StepPhase::redistribution,
      {access, {.cells = 8, .contents = ContentsSent::around_small_fragments, .walls = WallsSent::motion}},
      [&step](Body<Dim>& body, int slot, Scratch& scratch) {
        redistribute(step.state(), body, slot, step.counters(slot), scratch);
      });
  apply_updates(step, StepPhase::redistribution);
}

template <int Dim>
void cut_out_rigid_bodies(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"cut out rigid bodies", {}, {}, phi};
  const auto& bodies = step.state().bodies;
  if (std::none_of(bodies.begin(), bodies.end(), [](const auto& body) { return body.rigid.has_value(); }))
    return;
  step.queue_each_body(StepPhase::level_set, access, [&step](Body<Dim>& body, int slot, Scratch&) {
    cut_out_rigid(step.state(), body, slot);
  });
}

template <int Dim>
void exchange_along_surfaces(StepRun<Dim>& step) {
  static constexpr FieldAccess access{
      "exchange along surfaces", contents | volume | end_geometry, {}, updates};
  if (Dim == 1) return;
  step.queue_each_body(StepPhase::moves, {access, {.cells = 1, .contents = ContentsSent::of_cut_cells}},
                       [&step](Body<Dim>& body, int slot, Scratch& scratch) {
                         exchange_along_surface(step.state(), body, slot, scratch);
                       });
  apply_updates(step, StepPhase::moves);
}

template <int Dim>
void follow_volumes(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"measure mismatch", {}, volume | contents, end_geometry};
  step.queue_each_body(StepPhase::level_set, access, [&step](Body<Dim>& body, int slot, Scratch&) {
    measure_mismatch(step.state(), body, slot);
  });
  follow_mismatch(step, following);
}

/// Void gives way before matter does.
template <int Dim>
void fit_voids(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"fit voids", end_geometry, contents, volume | phi};
  step.queue_each_body(StepPhase::moves, access, [&step](Body<Dim>& body, int slot, Scratch& scratch) {
    if (can_fail(body.material.damage)) fit_voids(step.state(), body, slot, scratch);
    if (is_gas(body.material.eos)) fit_gas(step.state(), body, slot);
  });
}

template <int Dim>
void empty_and_fill(StepRun<Dim>& step, double dt) {
  static constexpr FieldAccess empty{"empty outside", contents | volume | end_geometry | phi, {}, updates},
      fill{"fill inside", contents | volume | end_geometry | phi, {}, updates};
  step.queue_each_body(StepPhase::moves, {empty, {.cells = 3, .contents = ContentsSent::around_moves}},
                       [&step, dt](Body<Dim>& body, int slot, Scratch& scratch) {
                         State<Dim>& state = step.state();
                         empty_outside(state, body, slot, dt,
                                       state.ledger[slot].edges[&body - state.bodies.data()], scratch);
                       });
  apply_updates(step, StepPhase::moves);
  fit_voids(step);
  step.queue_each_body(StepPhase::moves, {fill, {.cells = 3, .contents = ContentsSent::around_moves}},
                       [&step](Body<Dim>& body, int slot, Scratch& scratch) {
                         State<Dim>& state = step.state();
                         fill_inside(state, body, slot, state.ledger[slot].edges[&body - state.bodies.data()],
                                     scratch);
                       });
  apply_updates(step, StepPhase::moves);
}

template <int Dim>
void bound_volumes(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"bound volumes", contents | volume | end_geometry, {}, updates};
  step.queue_each_body(StepPhase::moves, {access, {.cells = 3, .contents = ContentsSent::around_moves}},
                       [&step](Body<Dim>& body, int slot, Scratch& scratch) {
                         bound_volumes(step.state(), body, slot, step.counters(slot), scratch);
                       });
  apply_updates(step, StepPhase::moves);
  fit_voids(step);
}

template <int Dim>
void restore_level_sets(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"restore level sets", {}, contents | volume | end_geometry, phi};
  State<Dim>& state = step.state();
  const auto fails = [](const Body<Dim>& body) { return !body.rigid && can_fail(body.material.damage); };
  if (std::none_of(state.bodies.begin(), state.bodies.end(), fails)) return;
  std::vector<std::uint8_t> any(static_cast<std::size_t>(state.mesh.local()), 0);
  step.for_each_body(StepPhase::level_set, access, [&](Body<Dim>& body, int slot, Scratch&) {
    if (!fails(body) || state.mesh.block(slot).level > 0) return;
    const std::int64_t count = restore_level_set(state, body, slot);
    step.counters(slot).restored_cells += count;
    if (count > 0) any[slot] = 1;
  });
  if (step.engine().world.any(std::count(any.begin(), any.end(), 1) > 0))
    redistance_band(step, sweeps_all, -1, nearer_when_restored);
}

template <int Dim>
void open_voids(StepRun<Dim>& step) {
  static constexpr FieldAccess mark{"mark voids", {}, contents | volume | end_geometry, role},
      open{"open voids", role, contents | volume | end_geometry | phi, phi_next | updates};
  State<Dim>& state = step.state();
  const auto fails = [](const Body<Dim>& body) { return !body.rigid && can_fail(body.material.damage); };
  if (std::none_of(state.bodies.begin(), state.bodies.end(), fails)) return;
  std::vector<std::uint8_t> any(static_cast<std::size_t>(state.mesh.local()), 0);
  step.for_each_body(StepPhase::moves, mark, [&](Body<Dim>& body, int slot, Scratch&) {
    if (fails(body) && state.mesh.block(slot).level == 0 && mark_open(state, body, slot)) any[slot] = 1;
  });
  if (!step.engine().world.any(std::count(any.begin(), any.end(), 1) > 0)) return;
  step.for_each_body(StepPhase::moves, open, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    BodyBlock<Dim>& b = body.at(slot);
    b.phi_next = b.phi;
    b.updates.clear();
    if (fails(body) && state.mesh.block(slot).level == 0)
      step.counters(slot).opened_cells += open_voids(state, body, slot, scratch);
  });
  apply_updates(step, StepPhase::moves);
  swap_phi(step);
  update_bands(step);
  redistance_band(step, sweeps_all, -1);
}

template <int Dim>
void release_detonations(StepRun<Dim>& step, double dt) {
  static constexpr FieldAccess access{"release detonations", {}, volume, contents};
  State<Dim>& state = step.state();
  const auto burns = [](const Body<Dim>& body) { return body.detonation.has_value(); };
  if (std::none_of(state.bodies.begin(), state.bodies.end(), burns)) return;
  step.for_each_body(StepPhase::plasticity, access, [&](Body<Dim>& body, int slot, Scratch&) {
    if (burns(body))
      state.ledger[slot].released[&body - state.bodies.data()] +=
          detonate(state, body, slot, state.time + dt);
  });
}

template <int Dim>
void fail_what_moved(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"fail what moved", {}, volume | average | stencil | role, contents};
  step.queue_each_body(StepPhase::plasticity, access, [&step](Body<Dim>& body, int slot, Scratch&) {
    fail_what_moved(step.state(), body, slot, step.state().ledger[slot]);
  });
}

template <int Dim>
void clear_negative_strain(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"clear negative strain", {}, volume, contents};
  step.queue_each_body(StepPhase::plasticity, access, [&step](Body<Dim>& body, int slot, Scratch&) {
    step.counters(slot).cleared_strains += clear_negative_strain(step.state(), body, slot);
    crush_pores(step.state(), body, slot, step.counters(slot));  // of what has been moved
  });
}

#define RECOIL_INSTANTIATE(Dim)                                          \
  template void drive_rigid_bodies<Dim>(StepRun<Dim>&, double);          \
  template void mark_beside_contact<Dim>(StepRun<Dim>&);                 \
  template void find_walls<Dim>(StepRun<Dim>&, double, const Stage&);    \
  template void move_walls<Dim>(StepRun<Dim>&, double, const Stage&);    \
  template void update_matter<Dim>(StepRun<Dim>&, double, const Stage&); \
  template void mark_around_small<Dim>(StepRun<Dim>&);                   \
  template void redistribute_small_fragments<Dim>(StepRun<Dim>&);        \
  template void cut_out_rigid_bodies<Dim>(StepRun<Dim>&);                \
  template void exchange_along_surfaces<Dim>(StepRun<Dim>&);             \
  template void follow_volumes<Dim>(StepRun<Dim>&);                      \
  template void empty_and_fill<Dim>(StepRun<Dim>&, double);              \
  template void bound_volumes<Dim>(StepRun<Dim>&);                       \
  template void restore_level_sets<Dim>(StepRun<Dim>&);                  \
  template void open_voids<Dim>(StepRun<Dim>&);                          \
  template void release_detonations<Dim>(StepRun<Dim>&, double);         \
  template void fail_what_moved<Dim>(StepRun<Dim>&);                     \
  template void clear_negative_strain<Dim>(StepRun<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
