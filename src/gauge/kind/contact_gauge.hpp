#pragma once

#include <cstddef>

#include "parallel/exact_sums.hpp"
#include "state/body.hpp"

namespace recoil {

/// Places of the sums over the cells in contact, then of the maxima.
template <int Dim>
struct ContactSums {
  static constexpr std::size_t area = 0, traction = 1, velocity = 2, gap = 3, power = 4, square = 5,
                               force = 6, shear = force + Dim, sums = shear + Dim, widest = sums,
                               deepest = sums + 1;
};

/// Adds the contact cells of a pair (pair_number()) in this rank's blocks to an item of ContactSums. Forces
/// act on the lower-numbered body. @param radius [m] only what lies so near to `at` counts; 0: all.
template <int Dim>
void probe_contact(const State<Dim>& state, int pair, const Vec<Dim>& at, double radius, int item,
                   ExactSums& sums);

}  // namespace recoil
