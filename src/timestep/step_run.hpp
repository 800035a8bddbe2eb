#pragma once

#include <string>
#include <utility>
#include <vector>

#include "state/exchange_fields.hpp"
#include "timestep/field_guard.hpp"
#include "timestep/step.hpp"

namespace recoil {

/// Runs the phases of a step. A phase is one loop over blocks in which a block writes only its own data and
/// reads only data that the phase does not write, so that blocks may run in any order and on any thread. It
/// says which fields it touches (FieldAccess); what it reads around its block is brought up to date first.
/// In debug builds a phase that touches or writes what it has not declared stops with an InternalError.
template <int Dim>
class StepRun {
 public:
  StepRun(State<Dim>& state, Engine& engine);

  State<Dim>& state() { return state_; }
  Engine& engine() { return engine_; }
  const Grid<Dim>& grid() const { return state_.grid(); }
  /// Slots of this process's blocks that hold a deformable body.
  const std::vector<int>& blocks() const { return blocks_; }
  Counters& counters(int slot) { return state_.ledger[slot].counters; }

  /// f(slot, scratch) for every block that holds a deformable body.
  template <class F>
  void for_each_slot(StepPhase part, const FieldAccess& access, F&& f);
  /// The same for those of one level.
  template <class F>
  void for_each_slot_of(int level, StepPhase part, const FieldAccess& access, F&& f);
  /// f(body, slot, scratch) for every deformable body in every block that it is in.
  template <class F>
  void for_each_body(StepPhase part, const FieldAccess& access, F&& f);
  /// Gives the stand-ins of blocks of other levels their values, after their copies were brought up to date.
  void fill_stand_ins(FieldSet fields);
  /// Brings copies of other processes' blocks up to date, as far as they are not. Collective.
  void update_copies(FieldSet fields);
  /// The same for all of these, and for which blocks the bodies are in. Collective.
  void exchange(FieldSet fields);
  /// Says that a field has changed other than in a phase.
  void has_changed(FieldSet fields) { state_.stale = state_.stale | fields; }

 private:
  template <class F>
  void run(const std::vector<int>& slots, StepPhase part, const FieldAccess& access, F&& f);

  State<Dim>& state_;
  Engine& engine_;
  std::vector<int> blocks_;
  std::vector<std::vector<int>> by_level_;  // the same
};

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_slot(StepPhase part, const FieldAccess& access, F&& f) {
  run(blocks_, part, access, f);
}

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_slot_of(int level, StepPhase part, const FieldAccess& access, F&& f) {
  run(by_level_[level], part, access, f);
}

template <int Dim>
template <class F>
void StepRun<Dim>::run(const std::vector<int>& slots, StepPhase part, const FieldAccess& access, F&& f) {
  update_copies(access.around);
  const Timers<StepPhase>::Span span(engine_.timers, part);
  parallel::for_each_block(engine_.team, slots, [&](int slot, Scratch& scratch) {
    const FieldGuard<Dim> guard(state_, slot, access);
    f(slot, scratch);
  });
  has_changed(access.writes);
}

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_body(StepPhase part, const FieldAccess& access, F&& f) {
  for_each_slot(part, access, [&](int slot, Scratch& scratch) {
    for (Body<Dim>& body : state_.bodies) {
      if (body.rigid || !body.present(slot)) continue;
      const Scratch::Frame frame(scratch);
      f(body, slot, scratch);
    }
  });
}

}  // namespace recoil
