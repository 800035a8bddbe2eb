#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace recoil {

/// Elements 0 to n - 1 in sets that can be joined; at first each is alone. (Halved paths, the larger set on
/// top: R. E. Tarjan, J. van Leeuwen, J. ACM 31 (1984) 245.)
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : above_(n), size_(n, 1) {
    std::iota(above_.begin(), above_.end(), std::size_t{0});
  }
  /// One element that stands for the whole set of this one.
  std::size_t top(std::size_t a) {
    while (above_[a] != a) a = above_[a] = above_[above_[a]];
    return a;
  }
  void join(std::size_t a, std::size_t b) {
    a = top(a), b = top(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    above_[b] = a;
    size_[a] += size_[b];
  }

 private:
  std::vector<std::size_t> above_, size_;
};

}  // namespace recoil
