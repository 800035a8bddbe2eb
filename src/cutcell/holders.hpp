#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/scratch.hpp"

namespace recoil {

/// Bit sets of axes (numbered by steepness): single axes, then pairs, then all three.
template <int Dim>
constexpr std::array<unsigned, (1U << Dim) - 1> axes_by_count() {
  if constexpr (Dim == 1) return {1};
  if constexpr (Dim == 2) return {1, 2, 3};
  if constexpr (Dim == 3) return {1, 2, 4, 3, 5, 6, 7};
}

/// One small fragment with the cells that it shares with. Members are places in the window, the fragment
/// itself first.
struct Neighbourhood {
  int cell = 0;
  int first = 0, members = 0;
  int axis = -1, direction = 0;  // of a pair that keeps a slope
  bool alone = false;
};

/// For every cell of a window the neighbourhoods that hold it, in the order of their cells.
struct Holders {
  int *held = nullptr, *first = nullptr, *list = nullptr;
  std::uint8_t* is_small = nullptr;

  bool any(int k) const { return held[k] > 0; }
  std::span<const int> of(int k) const {
    return any(k) ? std::span<const int>(list + first[k], static_cast<std::size_t>(held[k]))
                  : std::span<const int>();
  }
  /// N_j of a cell: a fragment that is not small is a neighbourhood of its own.
  int shares(int k) const { return held[k] + (is_small[k] != 0 ? 0 : 1); }
};

/// @param cells of the window.
inline Holders list_holders_of(const Neighbourhood* small, int smalls, const int* members, std::size_t cells,
                               Scratch& scratch) {
  Holders h{scratch.take_filled<int>(cells, 0), scratch.take<int>(cells), nullptr,
            scratch.take_filled<std::uint8_t>(cells, 0)};
  int* fill = scratch.take<int>(cells);  // set where a cell is held; -1: not listed yet
  int total = 0;
  for (int s = 0; s < smalls; ++s) {
    h.is_small[small[s].cell] = 1;
    for (int m = 0; m < small[s].members; ++m) {
      const int k = members[small[s].first + m];
      ++h.held[k];
      fill[k] = -1;
    }
    total += small[s].members;
  }
  h.list = scratch.take<int>(static_cast<std::size_t>(total));
  int used = 0;
  for (int s = 0; s < smalls; ++s)
    for (int m = 0; m < small[s].members; ++m) {
      const int k = members[small[s].first + m];
      if (fill[k] < 0) {
        fill[k] = h.first[k] = used;
        used += h.held[k];
      }
      h.list[fill[k]++] = s;
    }
  return h;
}

}  // namespace recoil
