#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "mesh/grid.hpp"
#include "parallel/world.hpp"

namespace recoil {

/// One leaf of the forest: a block of cells.
template <int Dim>
struct Block {
  Index<Dim> at{};                             // place in the lattice of blocks
  Box<Dim> cells{};                            // global indices
  long order = 0;                              // place along the space-filling curve, over all ranks
  std::array<int, power<Dim>(3)> neighbour{};  // slots, numbered as the box {-1..1}^Dim; -1: none
};

/// What one process sees of the forest: its own blocks in slots [0, local), copies of the other processes'
/// blocks that touch them (faces, edges and corners) in slots [local, slots).
template <int Dim>
class Mesh {
 public:
  /// Cuts the domain into blocks and shares them between the processes.
  /// @param weight work of a block, in any unit; blocks are shared so that sums of it are equal.
  /// Collective. @throws InputError where a periodic direction does not hold whole blocks.
  Mesh(const Grid<Dim>& grid, const parallel::World& world,
       const std::function<int(const Box<Dim>&)>& weight);
  ~Mesh();
  Mesh(Mesh&&) noexcept;

  const Grid<Dim>& grid() const { return grid_; }
  int local() const { return local_; }
  int slots() const { return static_cast<int>(blocks_.size()); }
  const Block<Dim>& block(int slot) const { return blocks_[slot]; }
  /// Slot of the block at a place of the lattice, or -1 where this process does not hold it.
  int find(const Index<Dim>& at) const;

  /// One other process: the own slots that it holds copies of, and the slots here that copy its blocks.
  /// Both lists are in the order of the curve, so that sender and receiver agree.
  struct Peer {
    int rank = 0;
    std::vector<int> send, receive;
  };
  const std::vector<Peer>& peers() const { return peers_; }

 private:
  struct Forest;
  void number_neighbours();

  Grid<Dim> grid_;
  std::unique_ptr<Forest> forest_;
  std::vector<Block<Dim>> blocks_;
  std::vector<int> lattice_;
  std::vector<Peer> peers_;
  int local_ = 0;
};

/// Cells of a block along each axis: `wanted` (0: chosen), or a divisor of the domain where it is periodic.
/// @throws InputError where no divisor fits.
template <int Dim>
Index<Dim> choose_block(const Index<Dim>& cells, const std::array<std::array<Edge, 2>, Dim>& edge,
                        int wanted);

/// The widest window that kernels read around a block; a block is at least that wide, or alone on its axis.
inline constexpr int widest_halo = 9;

}  // namespace recoil
