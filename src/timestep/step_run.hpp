#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "state/exchange_fields.hpp"
#include "timestep/field_guard.hpp"
#include "timestep/step.hpp"

namespace recoil {

/// What a phase does to fields, and how far around its blocks it reads those that it reads there [cells].
struct PhaseAccess {
  const FieldAccess& fields;
  int reach = widest_halo;

  PhaseAccess(const FieldAccess& access) : fields(access) {}  // NOLINT: as far as any does
  PhaseAccess(const FieldAccess& access, int cells) : fields(access), reach(cells) {}
};

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
  void for_each_slot(StepPhase part, const PhaseAccess& access, F&& f);
  /// The same for those of one level.
  template <class F>
  void for_each_slot_of(int level, StepPhase part, const PhaseAccess& access, F&& f);
  /// f(body, slot, scratch) for every deformable body in every block that it is in.
  template <class F>
  void for_each_body(StepPhase part, const PhaseAccess& access, F&& f);
  /// Gives the stand-ins of blocks of other levels their values, after their copies were brought up to date.
  void fill_stand_ins(FieldSet fields);
  /// Brings copies of other processes' blocks up to date, so many cells around own ones, as far as they are
  /// not. Collective.
  void update_copies(FieldSet fields, int reach = widest_halo);
  /// The same for all of these, and for which blocks the bodies are in. Collective.
  void exchange(FieldSet fields, int reach = widest_halo);
  /// Says that a field has changed other than in a phase.
  void has_changed(FieldSet fields);

 private:
  template <class F>
  void run(const std::vector<int>& slots, StepPhase part, const PhaseAccess& access, F&& f);

  State<Dim>& state_;
  Engine& engine_;
  std::vector<int> blocks_;
  std::vector<std::vector<int>> by_level_;  // the same
  // Cells around own blocks in which copies of a stale field are up to date all the same.
  std::array<int, static_cast<std::size_t>(Field::count)> fresh_within_{};
};

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_slot(StepPhase part, const PhaseAccess& access, F&& f) {
  run(blocks_, part, access, f);
}

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_slot_of(int level, StepPhase part, const PhaseAccess& access, F&& f) {
  run(by_level_[level], part, access, f);
}

template <int Dim>
template <class F>
void StepRun<Dim>::run(const std::vector<int>& slots, StepPhase part, const PhaseAccess& access, F&& f) {
  update_copies(access.fields.around, access.reach);
  const Timers<StepPhase>::Span span(engine_.timers, part);
  parallel::for_each_block(engine_.team, slots, [&](int slot, Scratch& scratch) {
    const FieldGuard<Dim> guard(state_, slot, access.fields);
    f(slot, scratch);
  });
  has_changed(access.fields.writes);
}

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_body(StepPhase part, const PhaseAccess& access, F&& f) {
  for_each_slot(part, access, [&](int slot, Scratch& scratch) {
    for (Body<Dim>& body : state_.bodies) {
      if (body.rigid || !body.present(slot)) continue;
      const Scratch::Frame frame(scratch);
      f(body, slot, scratch);
    }
  });
}

}  // namespace recoil
