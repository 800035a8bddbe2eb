#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "core/index.hpp"

namespace recoil {

/// Where a block stands: its level, 0 for the finest, and its place in the lattice of blocks of that level.
/// A block of level k has the size of 2^Dim blocks of level k - 1.
template <int Dim>
struct Place {
  int level = 0;
  Index<Dim> at{};

  Place coarser() const {
    Place p{level + 1, at};
    for (int d = 0; d < Dim; ++d) p.at[d] >>= 1;
    return p;
  }
  /// One of the 2^Dim blocks that it is cut into; bit d of `child`: the higher one along axis d.
  Place finer(unsigned child) const {
    Place p{level - 1, at};
    for (int d = 0; d < Dim; ++d) p.at[d] = 2 * at[d] + static_cast<int>(child >> d & 1U);
    return p;
  }
  friend bool operator==(const Place&, const Place&) = default;
};

/// The forest of p4est: a tree for each block of the coarsest level, whose leaves are the blocks. Some leaves
/// may lie outside of the domain, where it does not hold whole trees; a 1-d mesh has a row of trees of the
/// 2-d library, and leaves beside that row.
template <int Dim>
class Forest {
 public:
  /// @param trees blocks of the coarsest level along each axis. Collective.
  Forest(const Index<Dim>& trees, const std::array<bool, Dim>& periodic, int levels);
  Forest(const Forest& other);
  Forest(Forest&&) noexcept;
  Forest& operator=(Forest&&) noexcept;
  ~Forest();

  using Chooses = std::function<bool(const Place<Dim>&)>;
  /// Cuts leaves in 2^Dim as long as they are `wanted`, level by level where `recursive`.
  void refine(const Chooses& wanted, bool recursive);
  /// Joins 2^Dim leaves that are all `wanted`.
  void coarsen(const Chooses& wanted);
  /// Refines until leaves that touch, also at edges and corners, differ by one level at most.
  void balance();
  /// Shares the leaves between the processes: equal sums of weights, 2^Dim leaves of one parent together.
  void partition(const std::function<int(const Place<Dim>&)>& weight);

  /// This process's leaves along the space-filling curve; those beside the row of a 1-d mesh have no place.
  struct Leaf {
    Place<Dim> place;
    bool beside = false;
  };
  std::vector<Leaf> leaves() const;
  /// Leaves that processes know of each other because they touch, in the order of the curve.
  struct Shared {
    int rank = 0;
    std::vector<int> own;      // numbers of own leaves that the other process has copies of
    std::vector<Leaf> copies;  // leaves of the other process
  };
  std::vector<Shared> shared() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace recoil
