#include "mesh/mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace recoil {

namespace {

template <int Dim>
std::vector<Grid<Dim>> grids_of(const Grid<Dim>& finest, int levels) {
  std::vector<Grid<Dim>> grids;
  for (int level = 0; level < levels; ++level) {
    for (int d = 0; d < Dim; ++d)
      require(finest.cells[d] % (1 << level) == 0, "a domain of whole cells of all levels");
    grids.push_back(finest.at_level(level));
  }
  return grids;
}

template <int Dim>
Forest<Dim> forest_of(const Grid<Dim>& coarsest, int levels) {
  std::array<bool, Dim> periodic{};
  for (int d = 0; d < Dim; ++d) periodic[static_cast<std::size_t>(d)] = coarsest.periodic(d);
  return Forest<Dim>(coarsest.blocks(), periodic, levels);
}

template <int Dim>
std::uint64_t key_of(const Place<Dim>& p) {
  constexpr int bits = 19;  // p4est has no deeper levels in 3-d
  auto key = static_cast<std::uint64_t>(p.level);
  for (int d = 0; d < Dim; ++d) key = key << bits | static_cast<std::uint64_t>(p.at[d]);
  return key;
}

/// The sums of a number over the lower ranks, for every rank, and behind them the sum over all.
std::vector<long> first_numbers(const parallel::World& world, long own) {
  parallel::Bytes bytes;
  parallel::pack(bytes, own);
  const auto all = world.gather(bytes);
  parallel::Bytes sums;
  long sum = 0;
  parallel::pack(sums, sum);
  for (const parallel::Bytes& one : all) parallel::pack(sums, sum += parallel::Unpacker(one).read<long>());
  world.broadcast(sums);
  std::vector<long> first(static_cast<std::size_t>(world.size()) + 1);
  parallel::Unpacker(sums).read(first.data(), first.size());
  return first;
}

template <int Dim>
constexpr Box<Dim> around_block() {
  Box<Dim> around;
  for (int d = 0; d < Dim; ++d) around.lo[d] = -1, around.hi[d] = 2;
  return around;
}

}  // namespace

template <int Dim>
Mesh<Dim>::Mesh(const std::vector<Grid<Dim>>& grids, Forest<Dim> forest, const parallel::World& world)
    : grids_(grids), forest_(std::move(forest)) {
  take_leaves(world);
  add_stand_ins();
  number_neighbours();
}

template <int Dim>
Mesh<Dim>::Mesh(const Grid<Dim>& grid, int levels, const parallel::World& world, const Choose& refined,
                const Weigh& weight)
    : grids_(grids_of(grid, levels)), forest_(forest_of(grids_.back(), levels)) {
  if (levels > 1) {
    for (int d = 0; d < Dim; ++d)
      require(grid.block[d] % 2 == 0 || grid.block[d] >= grid.cells[d], "blocks of whole coarser cells");
    forest_.refine([&](const Place<Dim>& p) { return inside(p) && refined(p); }, true);
    forest_.balance();
  }
  forest_.partition([&](const Place<Dim>& p) { return inside(p) ? std::max(1, weight(p)) : 0; });
  take_leaves(world);
  add_stand_ins();
  number_neighbours();
}

template <int Dim>
Mesh<Dim>::Mesh(const Grid<Dim>& grid, const parallel::World& world,
                const std::function<int(const Box<Dim>&)>& weight)
    : Mesh(
          grid, 1, world, [](const Place<Dim>&) { return false; },
          [&](const Place<Dim>& p) { return weight(grid.cells_of(p.at)); }) {}

template <int Dim>
bool Mesh<Dim>::inside(const Place<Dim>& p) const {
  return Box<Dim>{{}, grids_[p.level].blocks()}.contains(p.at);
}

template <int Dim>
void Mesh<Dim>::add_block(const Place<Dim>& place) {
  slot_at_[key_of(place)] = slots();
  Block<Dim> block{place.at, grids_[place.level].cells_of(place.at), -1, {}, place.level};
  block.neighbour.fill(-1);
  blocks_.push_back(block);
}

template <int Dim>
void Mesh<Dim>::take_leaves(const parallel::World& world) {
  const auto leaves = forest_.leaves();
  const auto exists = [&](const auto& leaf) { return !leaf.beside && inside(leaf.place); };
  std::vector<int> slot_of_leaf;
  for (const auto& leaf : leaves) {
    slot_of_leaf.push_back(exists(leaf) ? slots() : -1);
    if (exists(leaf)) add_block(leaf.place);
  }
  local_ = slots();
  first_of_rank_ = first_numbers(world, local_);
  for (int s = 0; s < local_; ++s) blocks_[s].order = first_of_rank_[world.rank()] + s;
  for (const auto& shared : forest_.shared()) {
    Peer peer{shared.rank, {}, {}};
    for (const auto& leaf : shared.copies) {
      if (!exists(leaf)) continue;
      peer.receive.push_back(slots());
      add_block(leaf.place);
    }
    for (const int leaf : shared.own)
      if (slot_of_leaf[leaf] >= 0) peer.send.push_back(slot_of_leaf[leaf]);
    if (!peer.send.empty() || !peer.receive.empty()) peers_.push_back(std::move(peer));
  }
  leaves_ = slots();
  number_copies(world);
}

/// Asks the owners of copies for their places along the curve.
template <int Dim>
void Mesh<Dim>::number_copies(const parallel::World& world) {
  std::vector<parallel::Message> out;
  std::vector<int> from;
  for (const Peer& peer : peers_) {
    out.push_back({peer.rank, {}});
    for (const int s : peer.send) parallel::pack(out.back().bytes, blocks_[s].order);
    from.push_back(peer.rank);
  }
  const auto in = world.exchange(out, from);
  for (std::size_t p = 0; p < in.size(); ++p) {
    parallel::Unpacker reader(in[p].bytes);
    for (const int s : peers_[p].receive) blocks_[s].order = reader.read<long>();
  }
}

template <int Dim>
Place<Dim> Mesh<Dim>::beside(const Place<Dim>& place, const Index<Dim>& offset) const {
  Place<Dim> p{place.level, place.at + offset};
  const Index<Dim> lattice = grids_[p.level].blocks();
  for (int d = 0; d < Dim; ++d)
    if (grids_[p.level].periodic(d)) p.at[d] = (p.at[d] + lattice[d]) % lattice[d];
  return p;
}

/// The block at an offset from another one, where leaves of another level stand in its place.
template <int Dim>
void Mesh<Dim>::add_stand_in(const Block<Dim>& beside, const Index<Dim>& offset) {
  const Place<Dim> p = this->beside(beside.place(), offset);
  if (!inside(p)) return;
  int slot = find(p);
  if (slot >= 0 && slot < leaves_) return;
  if (slot < 0) {
    StandIn<Dim> by;
    by.from.fill(-1);
    const auto leaf_at = [&](const Place<Dim>& q) {
      const int s = find(q);
      return s < leaves_ ? s : -1;
    };
    by.from[0] = p.level + 1 < levels() ? leaf_at(p.coarser()) : -1;
    by.from_coarser = by.from[0] >= 0;
    for (unsigned c = 0; !by.from_coarser && p.level > 0 && c < by.from.size(); ++c)
      by.from[c] = leaf_at(p.finer(c));
    if (std::all_of(by.from.begin(), by.from.end(), [](int s) { return s < 0; })) return;
    slot = slots();
    add_block(p);
    stand_ins_.push_back(by);
  }
  Box<Dim>& filled = stand_ins_[slot - leaves_].cells;
  Box<Dim> near = blocks_[slot].cells;
  for (int d = 0; d < Dim; ++d) {
    if (offset[d] > 0) near.hi[d] = std::min(near.hi[d], near.lo[d] + stand_in_reach);
    if (offset[d] < 0) near.lo[d] = std::max(near.lo[d], near.hi[d] - stand_in_reach);
    if (filled.size() > 0) {
      near.lo[d] = std::min(near.lo[d], filled.lo[d]);
      near.hi[d] = std::max(near.hi[d], filled.hi[d]);
    }
  }
  filled = near;
}

template <int Dim>
void Mesh<Dim>::add_stand_ins() {
  if (levels() == 1) return;
  for (int s = 0; s < leaves_; ++s) {
    const Block<Dim> block = blocks_[s];
    for_each(around_block<Dim>(), [&](const Index<Dim>& o) { add_stand_in(block, o); });
  }
  for (int s = leaves_; s < slots(); ++s) order_of_stand_ins_.push_back(s);
  const auto rank = [&](int s) { return stand_in(s).from_coarser ? levels() - blocks_[s].level : 0; };
  std::stable_sort(order_of_stand_ins_.begin(), order_of_stand_ins_.end(),
                   [&](int a, int b) { return rank(a) < rank(b); });
}

template <int Dim>
int Mesh<Dim>::find(const Place<Dim>& place) const {
  if (!inside(place)) return -1;
  const auto found = slot_at_.find(key_of(place));
  return found == slot_at_.end() ? -1 : found->second;
}

template <int Dim>
int Mesh<Dim>::find(const Vec<Dim>& x) const {
  for (int level = 0; level < levels(); ++level) {
    const Index<Dim> i = grids_[level].cell_of(x);
    if (!grids_[level].domain().contains(i)) return -1;
    Place<Dim> p{level, i};
    for (int d = 0; d < Dim; ++d) p.at[d] /= grids_[level].block[d];
    if (const int slot = find(p); slot >= 0 && slot < leaves_) return slot;
  }
  return -1;
}

template <int Dim>
void Mesh<Dim>::number_neighbours() {
  constexpr Box<Dim> around = around_block<Dim>();
  for (int s = 0; s < leaves_; ++s)
    for_each(around, [&](const Index<Dim>& o) {
      blocks_[s].neighbour[around.at(o)] = find(beside(blocks_[s].place(), o));
    });
}

template <int Dim>
int Mesh<Dim>::coarser_across(int slot, int axis, int side) const {
  Index<Dim> o{};
  o[axis] = side == 0 ? -1 : 1;
  const int s = blocks_[slot].neighbour[around_block<Dim>().at(o)];
  return s >= leaves_ && stand_in(s).from_coarser ? stand_in(s).from[0] : -1;
}

template <int Dim>
std::array<int, power<Dim>(2)> Mesh<Dim>::finer_across(int slot, int axis, int side) const {
  std::array<int, power<Dim>(2)> finer;
  finer.fill(-1);
  Index<Dim> o{};
  o[axis] = side == 0 ? -1 : 1;
  const int s = blocks_[slot].neighbour[around_block<Dim>().at(o)];
  if (s < leaves_ || stand_in(s).from_coarser) return finer;
  for (unsigned c = 0; c < finer.size(); ++c)
    if (child_touches(c, o)) finer[c] = stand_in(s).from[c];
  return finer;
}

template <int Dim>
bool Mesh<Dim>::is_among_equals(int slot) const {
  const auto& all = blocks_[slot].neighbour;
  return std::none_of(all.begin(), all.end(), [&](int s) { return is_stand_in(s); });
}

template <int Dim>
Mesh<Dim> Mesh<Dim>::adapted(const parallel::World& world, const std::vector<int>& wanted) const {
  Forest<Dim> forest = forest_;
  const auto wants = [&](const Place<Dim>& p) {
    const int slot = find(p);
    return slot >= 0 && slot < local_ ? wanted[slot] : p.level;
  };
  forest.coarsen([&](const Place<Dim>& p) { return !inside(p) || wants(p) > p.level; });
  forest.refine([&](const Place<Dim>& p) { return inside(p) && wants(p) < p.level; }, false);
  forest.balance();
  return Mesh(grids_, std::move(forest), world);
}

template <int Dim>
Mesh<Dim> Mesh<Dim>::shared_out(const parallel::World& world, const std::vector<int>& weight) const {
  Forest<Dim> forest = forest_;
  forest.partition([&](const Place<Dim>& p) {
    const int slot = find(p);
    return slot < 0 ? 0 : std::max(1, weight[slot]);
  });
  return Mesh(grids_, std::move(forest), world);
}

template <int Dim>
int Mesh<Dim>::owner(long order) const {
  const auto after = std::upper_bound(first_of_rank_.begin(), first_of_rank_.end(), order);
  return static_cast<int>(after - first_of_rank_.begin()) - 1;
}

template <int Dim>
Index<Dim> choose_block(const Index<Dim>& cells, const std::array<std::array<Edge, 2>, Dim>& edge, int wanted,
                        int levels) {
  // Blocks of a mesh of several levels are smaller: about nine cells on each side of a surface are the
  // finest, in whole blocks.
  const int chosen = levels > 1 ? (Dim == 3 ? 12 : 16) : Dim == 1 ? 64 : Dim == 2 ? 32 : 16;
  const int usual = wanted > 0 ? wanted : chosen, coarsest = 1 << (levels - 1);
  Index<Dim> block;
  for (int d = 0; d < Dim; ++d) {
    block[d] = cells[d] <= usual ? cells[d] : usual;
    if (edge[d][0] != Edge::periodic || cells[d] % (block[d] * coarsest) == 0) continue;
    int best = 0;
    for (int n = widest_halo + 1; n <= 2 * usual + widest_halo && n <= cells[d]; ++n)
      if ((levels == 1 || n % 2 == 0) && cells[d] % (n * coarsest) == 0 &&
          (best == 0 || std::abs(n - usual) < std::abs(best - usual)))
        best = n;
    if (best == 0)
      throw InputError(
          "error: the periodic axis " + std::to_string(d) + " has " + std::to_string(cells[d]) +
          " cells, which whole blocks cannot fill\n   = help: change the domain so that the number of "
          "cells along it is a multiple of " +
          std::to_string(usual * coarsest));
    block[d] = best;
  }
  return block;
}

template class Mesh<1>;
template class Mesh<2>;
template class Mesh<3>;
template Index<1> choose_block<1>(const Index<1>&, const std::array<std::array<Edge, 2>, 1>&, int, int);
template Index<2> choose_block<2>(const Index<2>&, const std::array<std::array<Edge, 2>, 2>&, int, int);
template Index<3> choose_block<3>(const Index<3>&, const std::array<std::array<Edge, 2>, 3>&, int, int);

}  // namespace recoil
