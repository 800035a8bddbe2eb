#pragma once

#include <vector>

#include "gauge/pair_sample.hpp"
#include "parallel/exact_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// Sums the records of the contacts over all blocks, and finds the smallest gaps between the surfaces, within
/// 5 cells, from the level sets: one item of ExactSums per pair.
template <int Dim>
class PairSampler {
 public:
  PairSampler(int bodies, ExactSums& sums);
  /// Adds the blocks of this rank.
  void collect(const State<Dim>& state, ExactSums& sums) const;
  /// All pairs, by pair_number(); on rank 0 after ExactSums::reduce.
  std::vector<PairSample> read(const ExactSums& sums) const;

 private:
  void collect_gaps(const State<Dim>& state, ExactSums& sums) const;

  int first_ = 0, pairs_ = 0;
};

}  // namespace recoil
