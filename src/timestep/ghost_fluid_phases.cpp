#include "dynamics/primitives.hpp"
#include "interface/fit.hpp"
#include "interface/ghost_walls.hpp"
#include "interface/seed_walls.hpp"
#include "interface/values.hpp"
#include "levelset/distance.hpp"
#include "timestep/phases.hpp"

namespace recoil {

template <int Dim>
void Phases<Dim>::to_whole_cells() {
  for_each_body(StepPhase::averages, [&](Body<Dim>& body, int slot, Scratch&) {
    recoil::to_whole_cells(state_, body, slot, counters(slot));
  });
  share(part_matter);
}

template <int Dim>
double Phases<Dim>::prepare_whole_cells(const Stepping& stepping, double until) {
  to_whole_cells();
  average_states();
  const double dt = choose_length(stepping, until);
  keep_old();
  advect_surfaces_half(dt);
  find_surfaces(0.5 * dt);
  choose_donors_and_ghosts(Cells::whole);
  return dt;
}

template <int Dim>
void Phases<Dim>::find_surfaces(double ahead) {
  for_each_slot(StepPhase::geometry, [&](int slot, Scratch& scratch) {
    find_geometry(state_, slot, Surfaces::own, PhiAt::midstep, scratch, ahead);
    for (Body<Dim>& body : state_.bodies)
      if (!body.rigid && body.present(slot)) centre_donors(body.at(slot));
  });
  share(part_geometry);
}

/// Walls by `find(slot, scratch)`, then the values beyond them.
template <int Dim>
template <class Find>
void Phases<Dim>::find_ghosts_by(Find&& find) {
  share(part_average);
  for_each_body(StepPhase::walls,
                [&](Body<Dim>& body, int slot, Scratch&) { evaluate_fits(state_, body, slot); });
  share(part_geometry);
  for_each_slot(StepPhase::walls, find);
  share(part_geometry);
  fill_values();
  share(part_average);
}

template <int Dim>
void Phases<Dim>::find_ghosts(double dt, double part) {
  find_ghosts_by([&](int slot, Scratch& scratch) { find_ghost_walls(state_, slot, dt, part, scratch); });
}

template <int Dim>
void Phases<Dim>::find_seed_ghosts(double kappa, double dt, double part) {
  find_ghosts_by(
      [&](int slot, Scratch& scratch) { find_seed_walls(state_, slot, kappa, dt, part, scratch); });
}

template <int Dim>
void Phases<Dim>::update_whole_cells(FaceScheme scheme, double dt, double part) {
  for_each_slot(StepPhase::flux, [&](int slot, Scratch& scratch) {
    for (int m = 0; m < state_.count(); ++m) {
      Body<Dim>& body = state_.bodies[m];
      if (body.rigid || !body.present(slot)) continue;
      const Scratch::Frame frame(scratch);
      auto& ledger = state_.ledger[slot];
      recoil::update_whole_cells(state_, body, slot, scheme, dt, part, ledger.edges[m], ledger.counters,
                                 scratch);
    }
  });
  share(part_matter);
}

template <int Dim>
void Phases<Dim>::update_classic(FaceScheme scheme, const ClassicStage& stage, bool last, double dt) {
  for_each_body(StepPhase::plasticity,
                [](Body<Dim>& body, int slot, Scratch&) { start_stage(body.at(slot)); });
  update_whole_cells(scheme, stage.length * dt, stage.weight / stage.length);
  for_each_body(StepPhase::plasticity, [&](Body<Dim>& body, int slot, Scratch&) {
    collect_stage(body.at(slot), stage);
    if (last) finish_stages(body.at(slot));
  });
  share(part_matter);
}

template <int Dim>
void Phases<Dim>::count_lost_contacts() {
  for_each_body(StepPhase::walls, [&](Body<Dim>& body, int slot, Scratch&) {
    const BodyBlock<Dim>& b = body.at(slot);
    for (std::size_t k = 0; k < b.walls.size(); ++k)
      if ((b.contact[b.geometry.cuts[k].cell] & ~b.walls[k].partners) != 0) ++counters(slot).contacts_lost;
  });
}

template <int Dim>
void Phases<Dim>::redistance_all(int sweeps) {
  for_each_body(StepPhase::level_set, [&](Body<Dim>& body, int slot, Scratch& scratch) {
    if (body.at(slot).near_surface)
      recoil::redistance(state_, body, slot, sweeps, -1, scratch);
    else
      body.at(slot).phi_next = body.at(slot).phi;
  });
  swap_phi();
}

template <int Dim>
void Phases<Dim>::close_gaps(double rate) {
  for_each_slot(StepPhase::level_set,
                [&](int slot, Scratch& scratch) { measure_gaps(state_, slot, scratch); });
  follow_mismatch(rate);
}

template <int Dim>
void Phases<Dim>::to_cut_cells() {
  for_each_body(StepPhase::moves, [&](Body<Dim>& body, int slot, Scratch&) {
    recoil::to_cut_cells(state_, body, slot, counters(slot));
  });
  share(part_matter);
}

#define RECOIL_INSTANTIATE(Dim)                                                             \
  template double Phases<Dim>::prepare_whole_cells(const Stepping&, double);                \
  template void Phases<Dim>::find_ghosts(double, double);                                   \
  template void Phases<Dim>::find_seed_ghosts(double, double, double);                      \
  template void Phases<Dim>::update_classic(FaceScheme, const ClassicStage&, bool, double); \
  template void Phases<Dim>::count_lost_contacts();                                         \
  template void Phases<Dim>::redistance_all(int);                                           \
  template void Phases<Dim>::update_whole_cells(FaceScheme, double, double);                \
  template void Phases<Dim>::close_gaps(double);                                            \
  template void Phases<Dim>::to_cut_cells();
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
