#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/exact_sum.hpp"
#include "parallel/world.hpp"

namespace recoil {

/// Where terms are added to an item of ExactSums.
struct SumRow {
  std::span<ExactSum> sums;
  std::span<double> maxima;

  ExactSum& operator[](std::size_t k) const { return sums[k]; }
  /// @param k place of the maximum behind the sums.
  void raise(std::size_t k, double value) const {
    double& most = maxima[k - sums.size()];
    most = std::max(most, value);
  }
};

/// Sums and maxima over cells or contacts that have the same bits for any number of processes and threads and
/// any size of block: sums are exact until they are rounded once (ExactSum).
class ExactSums {
 public:
  /// Declares something to sum, before the first add(): so many sums, followed by so many maxima. The same on
  /// all ranks.
  /// @returns its number.
  int item(std::size_t sums, std::size_t maxima = 0);
  /// Forgets all that was added.
  void clear();
  /// To add terms to an item: at first the sums are zero, the maxima -inf. The item counts as added to.
  SumRow add(int item);
  /// Collective. Afterwards total() and any() hold, on all ranks.
  void reduce(const parallel::World& world);
  /// Sums, then maxima. Zeros and -inf where nothing was added.
  std::span<const double> total(int item) const;
  /// Whether anything was added to the item.
  bool any(int item) const;

 private:
  struct Kind {
    std::size_t sums = 0, maxima = 0, first_sum = 0, first_maximum = 0, begin = 0;  // begin: in total_
  };
  void add_up(const parallel::World& world);

  std::vector<Kind> kinds_;
  std::vector<ExactSum> sums_;
  std::vector<double> maxima_, total_;
  std::vector<std::int64_t> any_;      // by item
  std::vector<std::int64_t> numbers_;  // as they are sent
};

}  // namespace recoil
