#include "timestep/step_run.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "state/levels.hpp"

namespace recoil {

namespace {

/// What a block costs in a step, in cells without a surface: a cut cell takes about ten times as long as
/// another.
template <int Dim>
std::size_t cost_of(const State<Dim>& state, int slot) {
  constexpr std::size_t cut_cell = 10;
  std::size_t cost = 0;
  for (const Body<Dim>& body : state.bodies)
    if (!body.rigid && body.present(slot)) {
      const BodyBlock<Dim>& b = body.at(slot);
      cost += static_cast<std::size_t>(b.reach.size()) + cut_cell * b.geometry.cuts.size();
    }
  return cost;
}

}  // namespace

template <int Dim>
StepRun<Dim>::StepRun(State<Dim>& state, Engine& engine)
    : state_(state), engine_(engine), by_level_(static_cast<std::size_t>(state.mesh.levels())) {
  // The largest first: threads then end at about the same time.
  std::vector<std::pair<std::size_t, int>> present;
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    for (const Body<Dim>& body : state.bodies)
      if (!body.rigid && body.present(slot)) {
        present.emplace_back(cost_of(state, slot), slot);
        break;
      }
  if (engine.team.threads() > 1)
    std::stable_sort(present.begin(), present.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [cost, slot] : present) {
    blocks_.push_back(slot);
    by_level_[state.mesh.block(slot).level].push_back(slot);
  }
}

template <int Dim>
void StepRun<Dim>::update_copies(FieldSet fields, int reach) {
  FieldSet needed;
  for_each_field<Dim>([&](const auto& d) {
    if (!fields.has(d.id) || !state_.stale.has(d.id)) return;
    if (fresh_within_[static_cast<std::size_t>(d.id)] < std::min(reach, reach_of(d.id)))
      needed = needed | d.id;
  });
  if (!needed.empty()) exchange(needed, reach);
}

template <int Dim>
void StepRun<Dim>::fill_stand_ins(FieldSet fields) {
  if (state_.mesh.levels() == 1) return;
  update_copies(fields,
                reach_of(Field::stencil));  // beside other levels stand-ins get what they need in any case
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::exchange);
  recoil::fill_stand_ins(state_, fields, engine_.team);
}

template <int Dim>
void StepRun<Dim>::exchange(FieldSet fields, int reach) {
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::exchange);
  exchange_fields(state_, engine_.world, fields, reach);
  for_each_field<Dim>([&](const auto& d) {
    if (!fields.has(d.id)) return;
    fresh_within_[static_cast<std::size_t>(d.id)] = reach;
    if (reach >= reach_of(d.id)) state_.stale = state_.stale - d.id;
  });
}

template <int Dim>
void StepRun<Dim>::has_changed(FieldSet fields) {
  state_.stale = state_.stale | fields;
  for_each_field<Dim>([&](const auto& d) {
    if (fields.has(d.id)) fresh_within_[static_cast<std::size_t>(d.id)] = 0;
  });
}

template class StepRun<1>;
template class StepRun<2>;
template class StepRun<3>;

}  // namespace recoil
