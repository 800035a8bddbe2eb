#include "timestep/step_run.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "parallel/post.hpp"
#include "parallel/traffic.hpp"
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
  if (state.mesh.peers().empty()) return;
  around_small_.bodies = state.bodies.size();
  around_small_.lists.resize(static_cast<std::size_t>(state.mesh.local()) * around_small_.bodies);
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
  const bool threads_chained = shared_ && present.size() >= least_in_chain;
  const bool chained = state_.mesh.levels() == 1 && (threads_chained || !state_.mesh.peers().empty());
  if (shared_ && !chained)  // the largest first: threads then end at about the same time
    std::stable_sort(present.begin(), present.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::size_t> cost;
  for (const auto& [own_cost, slot] : present) {
    blocks_.push_back(slot);
    by_level_[state_.mesh.block(slot).level].push_back(slot);
    cost.push_back(own_cost);
  }
  if (chained) make_chain(cost, threads_chained);
}

template <int Dim>
void StepRun<Dim>::make_chain(const std::vector<std::size_t>& cost, bool shared) {
  const auto& peers = state_.mesh.peers();
  arrived_.resize(peers.size());
  std::vector<int> item_of(static_cast<std::size_t>(state_.mesh.slots()), -1);
  for (std::size_t p = 0; p < peers.size(); ++p)
    for (const int slot : peers[p].receive) item_of[static_cast<std::size_t>(slot)] = static_cast<int>(p);
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    item_of[static_cast<std::size_t>(blocks_[i])] = static_cast<int>(peers.size() + i);
  std::vector<std::set<int>> touching(peers.size() + blocks_.size());
  std::vector<std::uint8_t> urgent(touching.size(), 0);
  std::fill_n(urgent.begin(), peers.size(), std::uint8_t{1});
  for (std::size_t i = peers.size(); i < touching.size(); ++i)
    for (const int slot : state_.mesh.block(blocks_[i - peers.size()]).neighbour) {
      const int item = slot < 0 ? -1 : item_of[static_cast<std::size_t>(slot)];
      if (item < 0 || item == static_cast<int>(i)) continue;
      touching[i].insert(item);
      touching[static_cast<std::size_t>(item)].insert(static_cast<int>(i));
      if (item < static_cast<int>(peers.size())) urgent[i] = 1;  // what it sends others wait for
    }
  std::vector<std::vector<int>> beside;
  for (const std::set<int>& items : touching) beside.emplace_back(items.begin(), items.end());
  std::vector<std::size_t> costs(peers.size(), 0);
  costs.insert(costs.end(), cost.begin(), cost.end());
  chain_.emplace(engine_.team, beside, costs, std::move(urgent), shared);
}

template <int Dim>
void StepRun<Dim>::talk_to_all(const Talk& talk) {
  const auto& peers = state_.mesh.peers();
  if (peers.empty()) return;
  ++parallel::counted_traffic().exchanges;
  if (chain_) {
    for (const auto kind : {Queued::Kind::send, Queued::Kind::receive})
      queued_.push_back({kind, StepPhase::exchange, nullptr, {}, talk});
    return;
  }
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::exchange);
  for (std::size_t p = 0; p < peers.size(); ++p) parallel::post(peers[p].rank, talk.say(p));
  for (std::size_t p = 0; p < peers.size(); ++p) talk.hear(p, parallel::wait_for_posted(peers[p].rank));
}

template <int Dim>
bool StepRun<Dim>::has_arrived(std::size_t peer, const Queued& phase) {
  if (phase.kind != Queued::Kind::receive) return true;
  auto& bytes = arrived_[peer];
  if (!bytes) bytes = parallel::take_posted(state_.mesh.peers()[peer].rank);
  return bytes.has_value();
}

template <int Dim>
void StepRun<Dim>::work_on_peer(std::size_t peer, const Queued& phase) {
  if (phase.kind == Queued::Kind::send) parallel::post(state_.mesh.peers()[peer].rank, phase.talk.say(peer));
  if (phase.kind == Queued::Kind::receive) {
    phase.talk.hear(peer, *arrived_[peer]);
    arrived_[peer].reset();
  }
}

template <int Dim>
void StepRun<Dim>::run_queued() {
  if (queued_.empty()) return;
  const std::vector<Queued> phases = std::exchange(queued_, {});
  struct alignas(64) Tally {
    PartTimes seconds{};
  };
  std::vector<Tally> tallies(static_cast<std::size_t>(chain_->threads()));
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto seconds = [&](auto since) { return std::chrono::duration<double>(now() - since).count(); };
  const auto begun = now();
  const int peers = static_cast<int>(arrived_.size());
  const auto phase_of = [&](int phase) -> const Queued& { return phases[static_cast<std::size_t>(phase)]; };
  const auto work = [&](int item, int phase, int worker) {
    const Queued& q = phase_of(phase);
    if (item >= peers && q.kind != Queued::Kind::work) return;
    const auto start = now();
    if (item < peers) {
      work_on_peer(static_cast<std::size_t>(item), q);
    } else {
      Scratch& scratch = engine_.team.scratch(worker);
      const Scratch::Frame frame(scratch);
      const int slot = blocks_[static_cast<std::size_t>(item - peers)];
      const FieldGuard<Dim> guard(state_, slot, *q.fields);
      q.work(slot, scratch);
    }
    tallies[static_cast<std::size_t>(worker)].seconds[static_cast<std::size_t>(q.part)] += seconds(start);
  };
  // Messages are the first thread's, which alone may call MPI.
  const auto ready = [&](int item, int phase, int worker) {
    return item >= peers || (worker == 0 && has_arrived(static_cast<std::size_t>(item), phase_of(phase)));
  };
  chain_->run(static_cast<int>(phases.size()), work, peers > 0 ? parallel::Chain::Ready(ready) : nullptr);
  PartTimes all{};
  for (const Tally& tally : tallies)
    for (std::size_t part = 0; part < all.size(); ++part) all[part] += tally.seconds[part];
  note_times(all, seconds(begun));
}

/// Each thread notes its own time; what is left of the wall time it has waited.
template <int Dim>
void StepRun<Dim>::note_times(const PartTimes& all, double wall) {
  double waited = wall;
  for (std::size_t part = 0; part < all.size(); ++part) {
    const double share = all[part] / chain_->threads();
    engine_.timers.add(static_cast<StepPhase>(part), share);
    waited -= share;
  }
  engine_.timers.add(StepPhase::waiting, waited);
}

template <int Dim>
void StepRun<Dim>::update_copies(FieldSet fields, ReadAround read) {
  FieldSet needed;
  for_each_field<Dim>([&](const auto& d) {
    if (!fields.has(d.id) || !state_.stale.has(d.id)) return;
    if (fresh_within_[static_cast<std::size_t>(d.id)] < std::min(read.cells, reach_of(d.id)))
      needed = needed | d.id;
  });
  if (!needed.empty()) exchange(needed, read);
}

template <int Dim>
void StepRun<Dim>::fill_stand_ins(FieldSet fields) {
  if (state_.mesh.levels() == 1) return;
  update_copies(fields,
                {reach_of(Field::stencil)});  // beside other levels stand-ins get what they need in any case
  run_queued();
  const Timers<StepPhase>::Span span(engine_.timers, StepPhase::exchange);
  recoil::fill_stand_ins(state_, fields, engine_.team);
}

template <int Dim>
void StepRun<Dim>::exchange(FieldSet fields, ReadAround read) {
  read.around_small = &around_small_;
  talk_to_all({[this, fields, read](std::size_t p) {
                 ReadAround sent = read;
                 sent.asked = asked_.empty() ? nullptr : &asked_[p];
                 return pack_fields(state_, state_.mesh.peers()[p], fields, sent);
               },
               [this, fields, read](std::size_t p, const parallel::Bytes& bytes) {
                 unpack_fields(state_, state_.mesh.peers()[p], engine_.world.rank(), fields, read, bytes);
               }});
  for_each_field<Dim>([&](const auto& d) {
    if (!fields.has(d.id)) return;
    if (d.id == Field::contents && read.contents != ContentsSent::all) return;  // not all of them
    if (d.id == Field::average && read.averages != AveragesSent::all) return;
    if (d.id == Field::walls && (read.walls == WallsSent::donors || read.walls == WallsSent::motion)) return;
    fresh_within_[static_cast<std::size_t>(d.id)] = read.cells;
    if (read.cells >= reach_of(d.id)) state_.stale = state_.stale - d.id;
  });
}

template <int Dim>
void StepRun<Dim>::ask_for_cells() {
  asked_.resize(state_.mesh.peers().size());
  talk_to_all({[this](std::size_t p) { return recoil::ask_for_cells(state_, state_.mesh.peers()[p]); },
               [this](std::size_t p, const parallel::Bytes& bytes) {
                 asked_[p] = take_asked_cells(state_, state_.mesh.peers()[p], bytes);
               }});
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
