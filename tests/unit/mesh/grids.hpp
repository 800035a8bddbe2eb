#pragma once

#include <initializer_list>

#include "../parallel/session.hpp"
#include "core/index.hpp"
#include "mesh/mesh.hpp"
#include "parallel/world.hpp"

namespace recoil {

/// A grid with the same edges on all axes. The domain has cells, cells + 1, ... cells along its axes unless
/// `even`, so that mistaken axes show.
template <int Dim>
Grid<Dim> make_test_grid(int cells, int block, Edge edge, bool even = false) {
  Grid<Dim> g;
  g.dx = 0.25;
  for (int d = 0; d < Dim; ++d) {
    g.origin[d] = -1 + 0.5 * d;
    g.cells[d] = cells + (even ? 0 : d);
    g.block[d] = block;
    g.edge[d] = {edge, edge};
  }
  return g;
}

/// Cells along an axis, at least `cells`, so that every process of mpirun gets two blocks or more.
template <int Dim>
int enough_cells(int cells, int block) {
  start_parallel();
  int along = (cells + block - 1) / block;
  while (power<Dim>(along) < 2 * parallel::World{}.size()) ++along;
  return along * block;
}

/// r from 0 (the axis) to `columns` cells, z over `rows` cells.
inline Grid<2> make_axisymmetric_grid(int columns, int rows, int block) {
  Grid<2> g;
  g.dx = 0.125;
  g.origin[1] = -2;
  g.cells = {{columns, rows}};
  g.block = {{block, block}};
  g.edge = {{{Edge::reflect, Edge::outflow}, {Edge::outflow, Edge::outflow}}};
  g.radial_power = 1;
  return g;
}

template <int Dim>
Mesh<Dim> make_test_mesh(const Grid<Dim>& grid) {
  start_parallel();
  return Mesh<Dim>(grid, parallel::World{}, [](const Box<Dim>& cells) { return cells.size(); });
}

}  // namespace recoil
