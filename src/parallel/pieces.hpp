#pragma once

#include <algorithm>
#include <cstdint>

namespace recoil::parallel {

/// MPI counts in int: a longer message goes in pieces, each at most so long [bytes]. Tests make it smaller.
inline std::uint64_t& longest_piece() {
  static std::uint64_t bytes = std::uint64_t{1} << 30U;
  return bytes;
}

/// Calls f(first, count) for the pieces of n bytes, in order; for none where n is 0. Sender and receiver know
/// n, so that both see the same pieces.
template <class F>
void for_each_piece(std::uint64_t n, F&& f) {
  const std::uint64_t longest = longest_piece();
  for (std::uint64_t first = 0; first < n; first += longest)
    f(first, static_cast<int>(std::min(longest, n - first)));
}

}  // namespace recoil::parallel
