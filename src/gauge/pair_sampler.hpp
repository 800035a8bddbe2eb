#pragma once

#include <vector>

#include "gauge/pair_sample.hpp"
#include "parallel/ordered_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// Sums the records of the contacts over all blocks, and finds the smallest gaps between the surfaces, within
/// 5 cells, from the level sets: one item of OrderedSums per pair.
template <int Dim>
class PairSampler {
 public:
  PairSampler(int bodies, OrderedSums& sums);
  /// Adds the blocks of this rank.
  void collect(const State<Dim>& state, OrderedSums& sums) const;
  /// All pairs, by pair_number(); on rank 0 after OrderedSums::reduce.
  std::vector<PairSample> read(const OrderedSums& sums) const;

 private:
  void collect_gaps(const State<Dim>& state, OrderedSums& sums) const;

  int first_ = 0, pairs_ = 0;
};

}  // namespace recoil
