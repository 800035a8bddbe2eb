#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "parallel/chain.hpp"
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
///
/// With several threads a phase may be put off (`queue_...`) and then runs in one chain with those that
/// follow it, in which a block waits for the blocks beside it alone. What it refers to must live until
/// run_queued(). Code that reads a result of such a phase, or changes what it reads, calls run_queued()
/// first; phases that are not put off and exchanges between processes do so themselves.
template <int Dim>
class StepRun {
 public:
  StepRun(State<Dim>& state, Engine& engine);
  StepRun(const StepRun&) = delete;
  StepRun& operator=(const StepRun&) = delete;

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
  /// The same later: f is copied, and may refer to what lives as long as the step.
  template <class F>
  void queue_each_slot(StepPhase part, const PhaseAccess& access, F&& f);
  template <class F>
  void queue_each_body(StepPhase part, const PhaseAccess& access, F&& f);
  /// f(slot, scratch) for every own block, with or without a body; not a phase, so nothing is declared.
  template <class F>
  void for_each_own(F&& f);
  /// Runs the phases that were put off.
  void run_queued();
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
  struct Queued {
    StepPhase part;
    const FieldAccess* fields;
    std::function<void(int slot, Scratch& scratch)> work;
  };

  template <class F>
  void run(const std::vector<int>& slots, StepPhase part, const PhaseAccess& access, F&& f);
  template <class F>
  void run_on(const std::vector<int>& slots, F&& f);
  void list_blocks();
  void make_chain(const std::vector<std::size_t>& cost);

  State<Dim>& state_;
  Engine& engine_;
  std::vector<int> blocks_;
  std::vector<std::vector<int>> by_level_;  // the same
  bool shared_ = false;                     // by threads
  std::optional<parallel::Chain> chain_;    // of blocks_, where phases are put off
  std::vector<Queued> queued_;
  // Cells around own blocks in which copies of a stale field are up to date all the same.
  std::array<int, static_cast<std::size_t>(Field::count)> fresh_within_{};
};

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_slot(StepPhase part, const PhaseAccess& access, F&& f) {
  if (!chain_) return run(blocks_, part, access, f);
  queue_each_slot(part, access, [&f](int slot, Scratch& scratch) { f(slot, scratch); });
  run_queued();
}

template <int Dim>
template <class F>
void StepRun<Dim>::queue_each_slot(StepPhase part, const PhaseAccess& access, F&& f) {
  if (!chain_) return run(blocks_, part, access, f);
  update_copies(access.fields.around, access.reach);
  queued_.push_back({part, &access.fields, std::forward<F>(f)});
  has_changed(access.fields.writes);
}

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_slot_of(int level, StepPhase part, const PhaseAccess& access, F&& f) {
  run(by_level_[level], part, access, f);
}

template <int Dim>
template <class F>
void StepRun<Dim>::run(const std::vector<int>& slots, StepPhase part, const PhaseAccess& access, F&& f) {
  run_queued();
  update_copies(access.fields.around, access.reach);
  const Timers<StepPhase>::Span span(engine_.timers, part);
  run_on(slots, [&](int slot, Scratch& scratch) {
    const FieldGuard<Dim> guard(state_, slot, access.fields);
    f(slot, scratch);
  });
  has_changed(access.fields.writes);
}

template <int Dim>
template <class F>
void StepRun<Dim>::run_on(const std::vector<int>& slots, F&& f) {
  if (shared_) return parallel::for_each_block(engine_.team, slots, f);
  Scratch& scratch = engine_.team.scratch(0);
  for (const int slot : slots) {
    const Scratch::Frame frame(scratch);
    f(slot, scratch);
  }
}

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_own(F&& f) {
  run_queued();
  std::vector<int> all(static_cast<std::size_t>(state_.mesh.local()));
  std::iota(all.begin(), all.end(), 0);
  run_on(all, f);
}

/// f(body, slot, scratch) for the deformable bodies in one block.
template <int Dim, class F>
void for_bodies_in(State<Dim>& state, int slot, Scratch& scratch, const F& f) {
  for (Body<Dim>& body : state.bodies) {
    if (body.rigid || !body.present(slot)) continue;
    const Scratch::Frame frame(scratch);
    f(body, slot, scratch);
  }
}

template <int Dim>
template <class F>
void StepRun<Dim>::for_each_body(StepPhase part, const PhaseAccess& access, F&& f) {
  for_each_slot(part, access, [&](int slot, Scratch& scratch) { for_bodies_in(state_, slot, scratch, f); });
}

template <int Dim>
template <class F>
void StepRun<Dim>::queue_each_body(StepPhase part, const PhaseAccess& access, F&& f) {
  queue_each_slot(part, access,
                  [this, f](int slot, Scratch& scratch) { for_bodies_in(state_, slot, scratch, f); });
}

}  // namespace recoil
