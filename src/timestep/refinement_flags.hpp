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

/// The same, and how far around the blocks that touch it must be the finest as well.
template <int Dim>
struct Need {
  Asks level = Asks::nothing;
  Box<Dim> finest{};  // cells, by index of the finest level; may be empty
};

/// @param slot an own block.
template <int Dim>
Need<Dim> need_of(const State<Dim>& state, int slot, const Refinement<Dim>& rules);

/// Whether two boxes of finest cells have a cell in common, periods of the domain counted.
template <int Dim>
bool have_common_cells(const Grid<Dim>& grid, const Box<Dim>& a, const Box<Dim>& b);

/// The cells of a block by index of the finest level.
template <int Dim>
Box<Dim> finest_cells(const Mesh<Dim>& mesh, int slot);

/// Whether an own block must be cut at once, or one beside it: a surface is in it, and it or one that
/// irregular kernels of it may reach is not of the finest level.
template <int Dim>
bool lacks_finest(const State<Dim>& state, int slot);

}  // namespace recoil
