#pragma once

#include <cstddef>

namespace recoil {

/// Places of the sums and maxima of one body in a row of ExactSums.
template <int Dim>
struct BodySums {
  static constexpr std::size_t mass = 0, momentum = 1, kinetic = momentum + Dim, energy = kinetic + 1,
                               volume = energy + 1, speed = volume + 1, cells = speed + 1, place = cells + 1,
                               angular = place + Dim, failed = angular + 3, sums = failed + 1;
  static constexpr std::size_t strain = sums, highest = strain + 1, minus_lowest = highest + Dim,
                               all = minus_lowest + Dim;
};

}  // namespace recoil
