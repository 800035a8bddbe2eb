#pragma once

#include "mesh/grid.hpp"

namespace recoil {

/// Whether a cell lies within so many cells of an edge that matter leaves by. The last of a body there is
/// thinner than a stencil.
template <int Dim>
bool near_open_edge(const Grid<Dim>& grid, const Index<Dim>& i, int cells) {
  bool near = false;
  for (int d = 0; d < Dim; ++d)
    near = near || (i[d] < cells && grid.edge[d][0] == Edge::outflow) ||
           (i[d] >= grid.cells[d] - cells && grid.edge[d][1] == Edge::outflow);
  return near;
}

}  // namespace recoil
