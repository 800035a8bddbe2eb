#include "timestep/step_run.hpp"

#include <cstddef>

#include "state/levels.hpp"

namespace recoil {

template <int Dim>
StepRun<Dim>::StepRun(State<Dim>& state, Engine& engine)
    : state_(state), engine_(engine), by_level_(static_cast<std::size_t>(state.mesh.levels())) {
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    for (const Body<Dim>& body : state.bodies)
      if (!body.rigid && body.present(slot)) {
        blocks_.push_back(slot);
        by_level_[state.mesh.block(slot).level].push_back(slot);
        break;
      }
}

template <int Dim>
void StepRun<Dim>::update_copies(FieldSet fields) {
  const FieldSet needed = fields & state_.stale;
  if (!needed.empty()) exchange(needed);
}

template <int Dim>
void StepRun<Dim>::fill_stand_ins(FieldSet fields) {
  if (state_.mesh.levels() == 1) return;
  update_copies(fields);
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::exchange);
  recoil::fill_stand_ins(state_, fields, engine_.team);
}

template <int Dim>
void StepRun<Dim>::exchange(FieldSet fields) {
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::exchange);
  exchange_fields(state_, engine_.world, fields);
  state_.stale = state_.stale - fields;
}

template class StepRun<1>;
template class StepRun<2>;
template class StepRun<3>;

}  // namespace recoil
