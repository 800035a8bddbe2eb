#include "timestep/whole_cell_phases.hpp"

#include <cstddef>

#include "interface/fit.hpp"
#include "interface/ghost_walls.hpp"
#include "interface/seed_walls.hpp"

namespace recoil {

namespace {

using enum Field;

template <int Dim>
void to_whole_cells(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"to whole cells", {}, phi, contents | volume};
  step.for_each_body(StepPhase::averages, access, [&](Body<Dim>& body, int slot, Scratch&) {
    to_whole_cells(step.state(), body, slot, step.counters(slot));
  });
}

/// Cuts every body by its own mid-step level set, `ahead` seconds from now, with the donors in the middle of
/// their whole cells.
template <int Dim>
void find_surfaces(StepRun<Dim>& step, double ahead) {
  static constexpr FieldAccess access{"find surfaces", phi_midstep | contact, volume, geometry};
  State<Dim>& state = step.state();
  step.for_each_slot(StepPhase::geometry, access, [&](int slot, Scratch& scratch) {
    find_geometry(state, slot, Surfaces::own, PhiAt::midstep, scratch, ahead);
    for (Body<Dim>& body : state.bodies)
      if (!body.rigid && body.present(slot)) centre_donors(body.at(slot));
  });
}

/// Walls by `find(slot, scratch)`, then the values beyond them.
template <int Dim, class Find>
void find_ghosts_by(StepRun<Dim>& step, Find&& find) {
  static constexpr FieldAccess fits{"evaluate fits", average, geometry | donors | contents | volume, walls},
      contacts{"find ghost walls", phi_midstep | phi | role | contact | geometry | average, donors, walls};
  step.for_each_body(StepPhase::walls, fits, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    evaluate_fits(step.state(), body, slot, step.counters(slot), scratch);
  });
  step.update_copies(walls);
  step.for_each_slot(StepPhase::walls, contacts, find);
  fill_values(step);
}

}  // namespace

template <int Dim>
double prepare_whole_cells(StepRun<Dim>& step, const Stepping& stepping, double until) {
  to_whole_cells(step);
  average_states(step);
  const double dt = choose_length(step, stepping, until);
  keep_old(step);
  advect_surfaces_half(step, dt);
  find_surfaces(step, 0.5 * dt);
  choose_donors_and_ghosts(step, Cells::whole);
  return dt;
}

template <int Dim>
void find_ghosts(StepRun<Dim>& step, double dt, double weight) {
  find_ghosts_by(
      step, [&](int slot, Scratch& scratch) { find_ghost_walls(step.state(), slot, dt, weight, scratch); });
}

template <int Dim>
void find_seed_ghosts(StepRun<Dim>& step, double kappa, double dt, double weight) {
  find_ghosts_by(step, [&](int slot, Scratch& scratch) {
    find_seed_walls(step.state(), slot, kappa, dt, weight, scratch);
  });
}

template <int Dim>
void update_whole_cells(StepRun<Dim>& step, FaceScheme scheme, double dt, double weight) {
  static constexpr FieldAccess access{"update whole cells", stencil | role, geometry | walls,
                                      contents | volume};
  State<Dim>& state = step.state();
  step.for_each_slot(StepPhase::flux, access, [&](int slot, Scratch& scratch) {
    for (int m = 0; m < state.count(); ++m) {
      Body<Dim>& body = state.bodies[m];
      if (body.rigid || !body.present(slot)) continue;
      const Scratch::Frame frame(scratch);
      auto& ledger = state.ledger[slot];
      update_whole_cells(state, body, slot, scheme, dt, weight, ledger.edges[m], ledger.counters, scratch);
    }
  });
}

template <int Dim>
void update_classic(StepRun<Dim>& step, FaceScheme scheme, const ClassicStage& stage, bool last, double dt) {
  static constexpr FieldAccess start{"start of a stage", {}, contents_old | volume_old, contents | volume},
      collect{"end of a stage", {}, contents_old | volume_old, contents | volume | contents_sum};
  step.for_each_body(StepPhase::plasticity, start,
                     [](Body<Dim>& body, int slot, Scratch&) { start_stage(body.at(slot)); });
  update_whole_cells(step, scheme, stage.length * dt, stage.weight / stage.length);
  step.for_each_body(StepPhase::plasticity, collect, [&](Body<Dim>& body, int slot, Scratch&) {
    collect_stage(body.at(slot), stage);
    if (last) finish_stages(body.at(slot));
  });
}

template <int Dim>
void count_lost_contacts(StepRun<Dim>& step) {
  static constexpr FieldAccess access{"count lost contacts", {}, walls | geometry | contact, {}};
  step.for_each_body(StepPhase::walls, access, [&](Body<Dim>& body, int slot, Scratch&) {
    const BodyBlock<Dim>& b = body.at(slot);
    for (std::size_t k = 0; k < b.walls.size(); ++k)
      if ((b.contact[b.geometry.cuts[k].cell] & ~b.walls[k].partners) != 0)
        ++step.counters(slot).contacts_lost;
  });
}

template <int Dim>
void close_gaps(StepRun<Dim>& step, double rate) {
  static constexpr FieldAccess access{"measure gaps", phi | contact | role | geometry, volume, end_geometry};
  step.for_each_slot(StepPhase::level_set, access,
                     [&](int slot, Scratch& scratch) { measure_gaps(step.state(), slot, scratch); });
  follow_mismatch(step, {.rate = rate});
}

template <int Dim>
void to_cut_cells(StepRun<Dim>& step) {
  static constexpr FieldAccess access{
      "to cut cells", {}, phi | end_geometry | role | stencil, contents | volume};
  step.for_each_body(StepPhase::moves, access, [&](Body<Dim>& body, int slot, Scratch&) {
    to_cut_cells(step.state(), body, slot, step.counters(slot));
  });
}

#define RECOIL_INSTANTIATE(Dim)                                                                    \
  template double prepare_whole_cells<Dim>(StepRun<Dim>&, const Stepping&, double);                \
  template void find_ghosts<Dim>(StepRun<Dim>&, double, double);                                   \
  template void find_seed_ghosts<Dim>(StepRun<Dim>&, double, double, double);                      \
  template void update_whole_cells<Dim>(StepRun<Dim>&, FaceScheme, double, double);                \
  template void update_classic<Dim>(StepRun<Dim>&, FaceScheme, const ClassicStage&, bool, double); \
  template void count_lost_contacts<Dim>(StepRun<Dim>&);                                           \
  template void close_gaps<Dim>(StepRun<Dim>&, double);                                            \
  template void to_cut_cells<Dim>(StepRun<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
