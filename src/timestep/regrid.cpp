#include "timestep/regrid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "dynamics/inadmissible.hpp"
#include "field/exchange.hpp"
#include "levelset/band.hpp"
#include "state/levels.hpp"
#include "state/pack_state.hpp"
#include "timestep/phases.hpp"
#include "timestep/refinement_flags.hpp"

namespace recoil {

namespace {

/// What each block asks, of own blocks and of those that touch them.
template <int Dim>
std::vector<Need<Dim>> all_needs(const State<Dim>& state, Engine& engine, const Refinement<Dim>& rules) {
  std::vector<Need<Dim>> needs(static_cast<std::size_t>(state.mesh.leaves()));
  engine.team.run(state.mesh.local(), [&](int slot, int) { needs[slot] = need_of(state, slot, rules); });
  exchange(
      state.mesh, engine.world,
      [&](int slot, int, parallel::Bytes& bytes) {
        parallel::pack(bytes, needs[slot].level);
        parallel::pack(bytes, needs[slot].finest);
      },
      [&](int slot, parallel::Unpacker& from) {
        needs[slot].level = from.read<Asks>();
        needs[slot].finest = from.read<Box<Dim>>();
      });
  return needs;
}

/// The level that each own block wants, one step from its own.
template <int Dim>
std::vector<int> wanted_levels(const State<Dim>& state, const std::vector<Need<Dim>>& needs) {
  const Mesh<Dim>& mesh = state.mesh;
  std::vector<int> wanted(static_cast<std::size_t>(mesh.local()));
  for (int slot = 0; slot < mesh.local(); ++slot) {
    Asks most = needs[slot].level;
    const Box<Dim> cells = finest_cells(mesh, slot);
    mesh.for_each_adjacent(slot, [&](int s) {
      if (have_common_cells(mesh.grid(), needs[s].finest, cells)) most = Asks::finest;
    });
    const int level = mesh.block(slot).level;
    wanted[slot] = most == Asks::finest ? std::max(level - 1, 0)
                   : most == Asks::keep ? level
                                        : std::min(level + 1, mesh.levels() - 1);
  }
  return wanted;
}

/// Whether an own block is to be cut, or all blocks of a parent are to be joined.
template <int Dim>
bool changes(const Mesh<Dim>& mesh, const std::vector<int>& wanted) {
  const auto joins = [&](int slot) {
    const Place<Dim> parent = mesh.block(slot).place().coarser();
    for (unsigned c = 0; c < 1U << Dim; ++c) {
      const Place<Dim> p = parent.finer(c);
      if (!mesh.inside(p)) continue;
      const int s = mesh.find(p);
      if (s < 0 || s >= mesh.local() || wanted[s] <= p.level) return false;
    }
    return true;
  };
  for (int s = 0; s < mesh.local(); ++s)
    if (wanted[s] < mesh.block(s).level || (wanted[s] > mesh.block(s).level && joins(s))) return true;
  return false;
}

template <int Dim>
bool same_blocks(const Mesh<Dim>& a, const Mesh<Dim>& b) {
  if (a.local() != b.local()) return false;
  for (int s = 0; s < a.local(); ++s)
    if (!(a.block(s).place() == b.block(s).place())) return false;
  return true;
}

template <int Dim>
void add_ledger(BlockLedger<Dim>& to, const BlockLedger<Dim>& more) {
  for (std::size_t p = 0; p < to.pairs.size(); ++p) {
    to.pairs[p].exchanged += more.pairs[p].exchanged;
    to.pairs[p].moment += more.pairs[p].moment;
  }
  for (std::size_t m = 0; m < to.edges.size(); ++m) to.edges[m] += more.edges[m];
  for (std::size_t m = 0; m < to.failures.size(); ++m) to.failures[m].merge(more.failures[m]);
  for (std::size_t m = 0; m < to.released.size(); ++m) to.released[m] += more.released[m];
  for (std::size_t m = 0; m < to.loads.size(); ++m) to.loads[m] += more.loads[m];
  to.counters += more.counters;
}

void add_averaged(AveragedStates::Line& to, const AveragedStates::Line& more) {
  if (more.last > to.last) to.place = more.place;
  to.count += more.count, to.first = std::min(to.first, more.first), to.last = std::max(to.last, more.last);
}

/// Makes the blocks of a new mesh from those of the old one; both hold the same part of the domain.
template <int Dim>
class Transfer {
 public:
  Transfer(State<Dim>& from, State<Dim>& to, AveragedStates& averaged, parallel::Team& team)
      : from_(from), to_(to), averaged_(averaged), team_(team) {
    make_room(fresh_, to);
  }

  void run() {
    // What is made anew reads the old blocks around; only then the others are moved.
    parallel::for_each_block(team_, own(), [&](int slot, Scratch& scratch) {
      if (same_in_old(slot) < 0) make(slot, scratch);
    });
    for (int slot = 0; slot < to_.mesh.local(); ++slot) {
      if (const int same = same_in_old(slot); same >= 0) move(slot, same);
      take_records(slot);
    }
    averaged_ = std::move(fresh_);
  }

 private:
  std::vector<int> own() const {
    std::vector<int> all(static_cast<std::size_t>(to_.mesh.local()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  /// Slots in the old mesh of the finer blocks of a place.
  std::array<int, power<Dim>(2)> children_of(const Place<Dim>& place) const {
    std::array<int, power<Dim>(2)> all;
    all.fill(-1);
    for (unsigned c = 0; place.level > 0 && c < all.size(); ++c) all[c] = from_.mesh.find(place.finer(c));
    return all;
  }

  /// Slot in the old mesh of the same block, or -1.
  int same_in_old(int slot) const {
    const int same = from_.mesh.find(to_.mesh.block(slot).place());
    return same < from_.mesh.local() ? same : -1;
  }

  void move(int slot, int same) {
    for (std::size_t m = 0; m < to_.bodies.size(); ++m)
      to_.bodies[m].blocks[slot] = std::move(from_.bodies[m].blocks[same]);
    to_.contacts[slot] = std::move(from_.contacts[same]);
  }

  void make(int slot, Scratch& scratch) {
    const Place<Dim> place = to_.mesh.block(slot).place();
    const int parent = place.level + 1 < from_.mesh.levels() ? from_.mesh.find(place.coarser()) : -1;
    const bool cut = parent >= 0 && parent < from_.mesh.local();
    const auto children = children_of(place);
    for (int m = 0; m < to_.count(); ++m) {
      Body<Dim>& body = to_.bodies[m];
      if (body.rigid) continue;  // update_bands() places them
      const auto& old = from_.bodies[m];
      const bool there = cut ? old.present(parent)
                             : std::any_of(children.begin(), children.end(),
                                           [&](int s) { return s >= 0 && old.present(s); });
      if (!there) continue;
      enter_block(body, slot, to_.grid());
      BodyBlock<Dim>& b = body.at(slot);
      const Box<Dim> cells = to_.mesh.block(slot).cells;
      if (cut)
        to_.ledger[slot].counters.flat_refinements += cut_block<Dim>(
            from_, parent, m, cells, b,
            [&](const Contents<Dim>& q, double v) { return !inadmissible<Dim>(body.material, q, v); },
            scratch);
      else
        join_blocks(from_, children, m, cells, b);
      b.phi_midstep.raw() = b.phi.raw();
      apply_band(to_, body, slot, {.present = true});
    }
  }

  void take_records(int slot) {
    const Place<Dim> place = to_.mesh.block(slot).place();
    if (const int same = same_in_old(slot); same >= 0) return take_records(slot, same);
    const int parent = place.level + 1 < from_.mesh.levels() ? from_.mesh.find(place.coarser()) : -1;
    if (parent >= 0 && parent < from_.mesh.local()) {  // the first of the finer blocks takes all
      if (place == place.coarser().finer(0)) take_records(slot, parent);
      return;
    }
    for (const int s : children_of(place))
      if (s >= 0) take_records(slot, s);
  }
  void take_records(int slot, int from) {
    add_ledger(to_.ledger[slot], from_.ledger[from]);
    if (from_.mesh.block(from).place() == to_.mesh.block(slot).place())
      to_.ledger[slot].pairs = std::move(from_.ledger[from].pairs);  // with what the last stage left
    for (std::size_t m = 0; m < to_.bodies.size() && !averaged_.lines.empty(); ++m)
      add_averaged(fresh_.at(slot, m), averaged_.at(from, m));
  }

  State<Dim>&from_, &to_;
  AveragedStates &averaged_, fresh_;
  parallel::Team& team_;
};

/// Hands blocks to the processes that own them in a new mesh of the same blocks.
template <int Dim>
void hand_over(State<Dim>& from, State<Dim>& to, AveragedStates& averaged, const parallel::World& world) {
  AveragedStates fresh;
  make_room(fresh, to);
  make_room(averaged, from);
  std::vector<parallel::Message> out;
  std::vector<int> all;
  for (int r = 0; r < world.size(); ++r)
    if (r != world.rank()) out.push_back({r, {}}), all.push_back(r);
  for (int s = 0; s < from.mesh.local(); ++s) {
    const long order = from.mesh.block(s).order;
    const int owner = to.mesh.owner(order);
    const auto bodies = from.bodies.size();
    if (owner == world.rank()) {
      const int slot = to.mesh.find(from.mesh.block(s).place());
      for (std::size_t m = 0; m < bodies; ++m) {
        to.bodies[m].blocks[slot] = std::move(from.bodies[m].blocks[s]);
        fresh.at(slot, m) = averaged.at(s, m);
      }
      to.contacts[slot] = std::move(from.contacts[s]);
      to.ledger[slot] = std::move(from.ledger[s]);
      continue;
    }
    parallel::Bytes& bytes = out[static_cast<std::size_t>(owner < world.rank() ? owner : owner - 1)].bytes;
    parallel::pack(bytes, order);
    pack_block(from, s, bytes);
    for (std::size_t m = 0; m < bodies; ++m) parallel::pack(bytes, averaged.at(s, m));
  }
  for (const parallel::Message& message : world.exchange(out, all)) {
    parallel::Unpacker reader(message.bytes);
    while (!reader.empty()) {
      const int slot = static_cast<int>(reader.read<long>() - to.mesh.block(0).order);
      const auto places = unpack_block(to, slot, reader);
      for (std::size_t m = 0; m < places.size(); ++m) {
        apply_band(to, to.bodies[m], slot, {places[m].present, places[m].near_surface, places[m].reach});
        fresh.at(slot, m) = reader.read<AveragedStates::Line>();
      }
    }
  }
  averaged = std::move(fresh);
}

/// Work of each own block: cells with matter, those near a surface ten times.
template <int Dim>
std::vector<int> work_of_blocks(const State<Dim>& state) {
  std::vector<int> work(static_cast<std::size_t>(state.mesh.local()), 1);
  for (int s = 0; s < state.mesh.local(); ++s)
    for (const Body<Dim>& body : state.bodies)
      if (!body.rigid && body.present(s)) work[s] += body.at(s).near_surface ? 100 : 10;
  return work;
}

}  // namespace

template <int Dim>
bool adapt(State<Dim>& state, Engine& engine, const std::vector<int>& wanted) {
  if (!engine.world.any(changes(state.mesh, wanted))) return false;
  Mesh<Dim> mesh = state.mesh.adapted(engine.world, wanted);
  if (!engine.world.any(!same_blocks(state.mesh, mesh))) return false;
  State<Dim> next = empty_on(std::move(mesh), state);
  Transfer<Dim>(state, next, engine.averaged, engine.team).run();
  if (engine.world.size() > 1) {
    State<Dim> shared = empty_on(next.mesh.shared_out(engine.world, work_of_blocks(next)), next);
    hand_over(next, shared, engine.averaged, engine.world);
    next = std::move(shared);
  }
  state = std::move(next);
  StepRun<Dim> step(state, engine);
  step.exchange(run_fields<Dim>());
  update_bands(step);
  return true;
}

template <int Dim>
bool regrid(State<Dim>& state, Engine& engine, const Refinement<Dim>& rules) {
  if (state.mesh.levels() == 1) return false;
  bool must = false;
  for (int slot = 0; slot < state.mesh.local(); ++slot) must = must || lacks_finest(state, slot);
  if (state.step % rules.every != 0 && !engine.world.any(must)) return false;
  bool changed = false;
  for (int pass = 0; pass < state.mesh.levels(); ++pass) {
    if (!adapt(state, engine, wanted_levels(state, all_needs(state, engine, rules)))) break;
    changed = true;
  }
  return changed;
}

#define RECOIL_INSTANTIATE(Dim)                                            \
  template bool adapt<Dim>(State<Dim>&, Engine&, const std::vector<int>&); \
  template bool regrid<Dim>(State<Dim>&, Engine&, const Refinement<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
