#pragma once

#include <cstddef>
#include <span>

#include "core/exact_sum.hpp"

namespace recoil {

/// Adds many terms to a sum, with the same result as one by one, several times as fast: the leading parts of
/// all terms are cut off at one place, so that they add up in a double without rounding, then the next ones,
/// until nothing is left (S. M. Rump, T. Ogita, S. Oishi, SIAM J. Sci. Comput. 31 (2008) 189, algorithm 3.2).
/// @param terms at most most_terms; overwritten.
void add_all(std::span<double> terms, ExactSum& to);

inline constexpr std::size_t most_terms = 1024;

}  // namespace recoil
