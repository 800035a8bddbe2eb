#include "timestep/step_run.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

#include "state/levels.hpp"

namespace recoil {

namespace {

constexpr std::size_t least_in_chain = 4;  // blocks; to wake threads costs more than fewer of them

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
  list_blocks();
}

template <int Dim>
void StepRun<Dim>::list_blocks() {
  std::vector<std::pair<std::size_t, int>> present;
  for (int slot = 0; slot < state_.mesh.local(); ++slot)
    for (const Body<Dim>& body : state_.bodies)
      if (!body.rigid && body.present(slot)) {
        present.emplace_back(cost_of(state_, slot), slot);
        break;
      }
  std::size_t work = 0;
  for (const auto& [own_cost, slot] : present) work += own_cost;
  const int threads = engine_.team.threads();
  shared_ = threads > 1 && work >= engine_.least_work * static_cast<std::size_t>(threads);
  // Beside other levels values go by way of stand-ins, of which a chain knows nothing.
  const bool chained = shared_ && state_.mesh.levels() == 1 && present.size() >= least_in_chain;
  if (shared_ && !chained)  // the largest first: threads then end at about the same time
    std::stable_sort(present.begin(), present.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::size_t> cost;
  for (const auto& [own_cost, slot] : present) {
    blocks_.push_back(slot);
    by_level_[state_.mesh.block(slot).level].push_back(slot);
    cost.push_back(own_cost);
  }
  if (chained) make_chain(cost);
}

template <int Dim>
void StepRun<Dim>::make_chain(const std::vector<std::size_t>& cost) {
  std::vector<int> item_of(static_cast<std::size_t>(state_.mesh.slots()), -1);
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    item_of[static_cast<std::size_t>(blocks_[i])] = static_cast<int>(i);
  std::vector<std::vector<int>> beside(blocks_.size());
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    for (const int slot : state_.mesh.block(blocks_[i]).neighbour) {
      const int item = slot < 0 ? -1 : item_of[static_cast<std::size_t>(slot)];
      if (item >= 0 && item != static_cast<int>(i)) beside[i].push_back(item);
    }
  chain_.emplace(engine_.team, beside, cost);
}

template <int Dim>
void StepRun<Dim>::run_queued() {
  if (queued_.empty()) return;
  const std::vector<Queued> phases = std::exchange(queued_, {});
  // Each thread notes its own time; what is left of the wall time it has waited.
  constexpr auto parts = static_cast<std::size_t>(StepPhase::count);
  struct alignas(64) Tally {
    std::array<double, parts> seconds{};
  };
  const auto threads = static_cast<std::size_t>(engine_.team.threads());
  std::vector<Tally> tallies(threads);
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto seconds = [](auto since, auto until) {
    return std::chrono::duration<double>(until - since).count();
  };
  const auto begun = now();
  chain_->run(static_cast<int>(phases.size()), [&](int item, int phase, int worker) {
    const auto start = now();
    const Queued& q = phases[static_cast<std::size_t>(phase)];
    Scratch& scratch = engine_.team.scratch(worker);
    const Scratch::Frame frame(scratch);
    const int slot = blocks_[static_cast<std::size_t>(item)];
    const FieldGuard<Dim> guard(state_, slot, *q.fields);
    q.work(slot, scratch);
    tallies[static_cast<std::size_t>(worker)].seconds[static_cast<std::size_t>(q.part)] +=
        seconds(start, now());
  });
  double waited = seconds(begun, now());
  for (const Tally& tally : tallies)
    for (std::size_t part = 0; part < parts; ++part) {
      const double share = tally.seconds[part] / static_cast<double>(threads);
      engine_.timers.add(static_cast<StepPhase>(part), share);
      waited -= share;
    }
  engine_.timers.add(StepPhase::waiting, waited);
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
  run_queued();
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::exchange);
  recoil::fill_stand_ins(state_, fields, engine_.team);
}

template <int Dim>
void StepRun<Dim>::exchange(FieldSet fields, int reach) {
  if (!state_.mesh.peers().empty()) run_queued();  // alone, nothing is sent
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
