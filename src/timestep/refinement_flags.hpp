#pragma once

#include <cstdint>

#include "timestep/regrid.hpp"

namespace recoil {

/// What the state in a block asks of its level.
enum class Asks : std::uint8_t {
  nothing,  // may be coarser
  keep,     // not coarser: hysteresis
  finest
};

/// @param slot an own block.
template <int Dim>
Asks asks_of(const State<Dim>& state, int slot, const Refinement<Dim>& rules);

/// Whether an own block must be cut at once, or one beside it: a surface is in it, and it or one that touches
/// it is not of the finest level.
template <int Dim>
bool lacks_finest(const State<Dim>& state, int slot);

}  // namespace recoil
