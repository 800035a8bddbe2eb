#include "timestep/step_run.hpp"

namespace recoil {

template <int Dim>
StepRun<Dim>::StepRun(State<Dim>& state, Engine& engine) : state_(state), engine_(engine) {
  for (int slot = 0; slot < state.mesh.local(); ++slot)
    for (const Body<Dim>& body : state.bodies)
      if (!body.rigid && body.present(slot)) {
        blocks_.push_back(slot);
        break;
      }
}

template <int Dim>
void StepRun<Dim>::update_copies(FieldSet fields) {
  const FieldSet needed = fields & state_.stale;
  if (!needed.empty()) exchange(needed);
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
