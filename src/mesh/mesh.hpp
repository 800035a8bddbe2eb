#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "mesh/forest.hpp"
#include "mesh/grid.hpp"
#include "parallel/world.hpp"

namespace recoil {

/// One leaf of the forest: a block of cells. Or a stand-in for such a block (StandIn).
template <int Dim>
struct Block {
  Index<Dim> at{};                             // place in the lattice of blocks of its level
  Box<Dim> cells{};                            // indices of its level
  long order = -1;                             // place along the curve, over all ranks; -1: a stand-in
  std::array<int, power<Dim>(3)> neighbour{};  // slots, numbered as the box {-1..1}^Dim; -1: none
  int level = 0;                               // 0: the finest

  Place<Dim> place() const { return {level, at}; }
};

/// Beside a block the forest may have blocks of the next level. A kernel does not know: it reads a stand-in,
/// a block of its own level whose values follow from theirs.
template <int Dim>
struct StandIn {
  bool from_coarser = false;              // from one coarser block; else from up to 2^Dim finer ones
  std::array<int, power<Dim>(2)> from{};  // slots: the first alone, or by child (Place::finer); -1: unknown
  Box<Dim> cells{};                       // those that have values: near enough to blocks of their level
};

/// As far from a block its stand-ins have values [cells].
inline constexpr int stand_in_reach = 4;

/// What one process sees of the forest: its own blocks in slots [0, local), copies of the other processes'
/// blocks that touch them (faces, edges and corners) in slots [local, leaves), stand-ins in [leaves, slots).
template <int Dim>
class Mesh {
 public:
  /// Blocks of one size, shared between the processes.
  /// @param weight work of a block, in any unit; blocks are shared so that sums of it are equal.
  /// Collective. @throws InputError where a periodic direction does not hold whole blocks.
  Mesh(const Grid<Dim>& grid, const parallel::World& world,
       const std::function<int(const Box<Dim>&)>& weight);
  /// Blocks of several levels: cut in 2^Dim from the coarsest on as long as `refined`, and where a neighbour
  /// would be finer by two levels. `grid`: of the finest.
  using Choose = std::function<bool(const Place<Dim>&)>;
  using Weigh = std::function<int(const Place<Dim>&)>;
  Mesh(const Grid<Dim>& grid, int levels, const parallel::World& world, const Choose& refined,
       const Weigh& weight);

  /// Of the finest level, of a level, of the level of a block.
  const Grid<Dim>& grid() const { return grids_.front(); }
  const Grid<Dim>& level_grid(int level) const { return grids_[level]; }
  const Grid<Dim>& grid(int slot) const { return grids_[blocks_[slot].level]; }
  int levels() const { return static_cast<int>(grids_.size()); }
  int local() const { return local_; }
  int leaves() const { return leaves_; }
  int slots() const { return static_cast<int>(blocks_.size()); }
  const Block<Dim>& block(int slot) const { return blocks_[slot]; }
  /// Whether any of a place lies in the domain.
  bool inside(const Place<Dim>& place) const;
  /// Slot of the block at a place, or -1 where there is none or this process does not hold it.
  int find(const Place<Dim>& place) const;
  /// Slot of the own block or copy that holds the point, or -1.
  int find(const Vec<Dim>& x) const;

  bool is_stand_in(int slot) const { return slot >= leaves_; }
  const StandIn<Dim>& stand_in(int slot) const { return stand_ins_[slot - leaves_]; }
  /// The slots of all stand-ins in the order in which their values can be found.
  const std::vector<int>& stand_ins_in_order() const { return order_of_stand_ins_; }
  /// The coarser leaf across a side (0 low, 1 high) of a leaf, or -1.
  int coarser_across(int slot, int axis, int side) const;
  /// The finer leaves across a side; all -1 where there are none. By child of the place there, without
  /// `axis`.
  std::array<int, power<Dim>(2)> finer_across(int slot, int axis, int side) const;
  /// Whether all that touches a leaf is of its level.
  bool is_among_equals(int slot) const;
  /// f(slot) for every leaf that touches an own one, some more than once.
  template <class F>
  void for_each_adjacent(int slot, F&& f) const;

  /// One other process: the own slots that it holds copies of, and the slots here that copy its blocks.
  /// Both lists are in the order of the curve, so that sender and receiver agree.
  struct Peer {
    int rank = 0;
    std::vector<int> send, receive;
  };
  const std::vector<Peer>& peers() const { return peers_; }

  /// The mesh with own blocks finer or coarser by one level where so wanted (the level, by own slot), on the
  /// same processes; balanced. 2^Dim blocks are joined where all want it. Collective.
  Mesh adapted(const parallel::World& world, const std::vector<int>& wanted) const;
  /// The same blocks, shared anew. @param weight by own slot. Collective.
  Mesh shared_out(const parallel::World& world, const std::vector<int>& weight) const;
  /// The cell of the finest level in the middle of a block's cell, on its high side.
  Index<Dim> finest_index(int slot, Index<Dim> i) const {
    const int width = 1 << blocks_[slot].level;
    for (int d = 0; d < Dim; ++d) i[d] = i[d] * width + width / 2;
    return i;
  }
  /// The process that owns the block at a place of the curve.
  int owner(long order) const;

 private:
  Mesh(const std::vector<Grid<Dim>>& grids, Forest<Dim> forest, const parallel::World& world);
  void add_block(const Place<Dim>& place);
  void take_leaves(const parallel::World& world);
  void number_copies(const parallel::World& world);
  void add_stand_ins();
  void add_stand_in(const Block<Dim>& beside, const Index<Dim>& offset);
  void number_neighbours();
  Place<Dim> beside(const Place<Dim>& place, const Index<Dim>& offset) const;

  std::vector<Grid<Dim>> grids_;
  Forest<Dim> forest_;
  std::vector<Block<Dim>> blocks_;
  std::unordered_map<std::uint64_t, int> slot_at_;
  std::vector<StandIn<Dim>> stand_ins_;
  std::vector<int> order_of_stand_ins_;
  std::vector<Peer> peers_;
  std::vector<long> first_of_rank_;  // and behind them the number of all blocks
  int local_ = 0, leaves_ = 0;
};

/// Cells of a block along each axis: `wanted` (0: chosen), or a divisor of the domain where it is periodic.
/// @throws InputError where no divisor fits.
template <int Dim>
Index<Dim> choose_block(const Index<Dim>& cells, const std::array<std::array<Edge, 2>, Dim>& edge, int wanted,
                        int levels = 1);

/// The widest window that kernels read around a block; a block is at least that wide, or alone on its axis.
inline constexpr int widest_halo = 9;

/// Whether the child of a place touches the block which sees that place at `offset`.
template <int Dim>
constexpr bool child_touches(unsigned child, const Index<Dim>& offset) {
  for (int d = 0; d < Dim; ++d) {
    const bool high = (child >> d & 1U) != 0;
    if ((offset[d] > 0 && high) || (offset[d] < 0 && !high)) return false;
  }
  return true;
}

template <int Dim>
template <class F>
void Mesh<Dim>::for_each_adjacent(int slot, F&& f) const {
  Box<Dim> around;
  for (int d = 0; d < Dim; ++d) around.lo[d] = -1, around.hi[d] = 2;
  for_each(around, [&](const Index<Dim>& o) {
    const int s = blocks_[slot].neighbour[around.at(o)];
    if (s < 0) return;
    if (!is_stand_in(s)) return f(s);
    const StandIn<Dim>& by = stand_in(s);
    if (by.from_coarser) return f(by.from[0]);
    for (unsigned c = 0; c < by.from.size(); ++c)
      if (by.from[c] >= 0 && child_touches(c, o)) f(by.from[c]);
  });
}

}  // namespace recoil
