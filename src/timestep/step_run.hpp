#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "parallel/chain.hpp"
#include "parallel/world.hpp"
#include "state/exchange_fields.hpp"
#include "timestep/field_guard.hpp"
#include "timestep/step.hpp"

namespace recoil {

/// What a phase does to fields, and what of those that it reads around its blocks it reads there.
struct PhaseAccess {
  const FieldAccess& fields;
  ReadAround around{};

  PhaseAccess(const FieldAccess& access) : fields(access) {}  // NOLINT: as far as any does
  PhaseAccess(const FieldAccess& access, const ReadAround& read) : fields(access), around(read) {}
};

/// Runs the phases of a step. A phase is one loop over blocks in which a block writes only its own data and
/// reads only data that the phase does not write, so that blocks may run in any order and on any thread. It
/// says which fields it touches (FieldAccess); what it reads around its block is brought up to date first.
/// In debug builds a phase that touches or writes what it has not declared stops with an InternalError.
///
/// With several threads or processes a phase may be put off (`queue_...`) and then runs in one chain with
/// those that follow it, in which a block waits for the blocks beside it alone. Exchanges are part of it:
/// another process is like a block beside those that touch its own, with two phases for each exchange, so
/// blocks farther inside go on while messages travel. What a phase refers to must live until run_queued().
/// Code that reads a result of such a phase, or changes what it reads, calls run_queued() first; phases that
/// are not put off do so themselves.
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
  /// Where redistribution reads contents in this step; kept where there are other processes.
  MarkedCells& around_small() { return around_small_; }
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
  void update_copies(FieldSet fields, ReadAround read = {});
  /// The same for all of these, and for which blocks the bodies are in. Collective.
  void exchange(FieldSet fields, ReadAround read = {});
  /// Asks other processes for what the fits and ghosts of own blocks read of theirs (AveragesSent::asked,
  /// WallsSent::asked) in the rest of the step. Collective.
  void ask_for_cells();
  /// Says that a field has changed other than in a phase.
  void has_changed(FieldSet fields);

 private:
  /// What is said to another process, and what is done with what it says: by number among Mesh::peers().
  struct Talk {
    std::function<parallel::Bytes(std::size_t peer)> say;
    std::function<void(std::size_t peer, const parallel::Bytes& bytes)> hear;
  };
  /// A phase that is put off: of the blocks, or half of an exchange, which has two phases of the other
  /// processes.
  struct Queued {
    enum class Kind : std::uint8_t { work, send, receive };
    Kind kind;
    StepPhase part;
    const FieldAccess* fields;                             // of work
    std::function<void(int slot, Scratch& scratch)> work;  // of work
    Talk talk{};                                           // of an exchange
  };

  template <class F>
  void run(const std::vector<int>& slots, StepPhase part, const PhaseAccess& access, F&& f);
  template <class F>
  void run_on(const std::vector<int>& slots, F&& f);
  void list_blocks();
  void make_chain(const std::vector<std::size_t>& cost, bool shared);
  void talk_to_all(const Talk& talk);
  bool has_arrived(std::size_t peer, const Queued& phase);
  void work_on_peer(std::size_t peer, const Queued& phase);
  using PartTimes = std::array<double, static_cast<std::size_t>(StepPhase::count)>;  // s
  void note_times(const PartTimes& all, double wall);

  State<Dim>& state_;
  Engine& engine_;
  std::vector<int> blocks_;
  std::vector<std::vector<int>> by_level_;  // the same
  bool shared_ = false;                     // by threads
  std::optional<parallel::Chain> chain_;    // of other processes, then blocks_, where phases are put off
  std::vector<std::optional<parallel::Bytes>> arrived_;  // by peer: what an exchange has brought
  std::vector<Queued> queued_;
  MarkedCells around_small_;
  std::vector<AskedCells> asked_;  // by peer
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
  update_copies(access.fields.around, access.around);
  queued_.push_back({Queued::Kind::work, part, &access.fields, std::forward<F>(f)});
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
  update_copies(access.fields.around, access.around);
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
