#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "parallel/world.hpp"

namespace recoil {

/// Sums and maxima over blocks that have the same bits for any number of processes and threads: every block
/// adds its own partial sums, and rank 0 adds them in the order of the blocks (compensated: A. Neumaier, ZAMM
/// 54 (1974) 39).
class OrderedSums {
 public:
  /// Declares something to sum, before the first add(): so many sums, followed by so many maxima. The same on
  /// all ranks.
  /// @returns its number.
  int item(std::size_t sums, std::size_t maxima = 0);
  /// Forgets all that was added.
  void clear();
  /// One block's share of an item: zeros for the sums, -inf for the maxima. Valid until the next add().
  /// @param order the block's place along the space-filling curve (Block::order).
  std::span<double> add(int item, long order);
  /// Collective. Afterwards total() holds on rank 0.
  void reduce(const parallel::World& world);
  /// Sums, then maxima; on rank 0. Zeros and -inf where no block added anything.
  std::span<const double> total(int item) const;
  /// Whether any block added to the item; on rank 0.
  bool any(int item) const;

 private:
  struct Kind {
    std::size_t sums = 0, maxima = 0, begin = 0;  // place in total_
  };
  struct Row {
    long order = 0;
    int item = 0;
    std::size_t begin = 0;  // place in values_
  };
  void take_in(const parallel::Bytes& bytes);
  void add_up();

  std::vector<Kind> kinds_;
  std::vector<Row> rows_;
  std::vector<double> values_, total_, rest_;
  std::vector<char> any_;
};

}  // namespace recoil
