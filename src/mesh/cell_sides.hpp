#pragma once

#include "mesh/mesh.hpp"

namespace recoil {

namespace detail {

/// call(slot, index) for the cells at index j of the level of a leaf, which lies beyond its side.
template <int Dim, class Call>
void across_block(const Mesh<Dim>& mesh, int slot, const Index<Dim>& j, int axis, int side, Call&& call) {
  if (const int coarser = mesh.coarser_across(slot, axis, side); coarser >= 0) {
    Index<Dim> wide = j;
    for (int d = 0; d < Dim; ++d) wide[d] >>= 1;
    return call(coarser, wide);
  }
  bool finer = false;
  for (const int s : mesh.finer_across(slot, axis, side)) {
    if (s < 0) continue;
    finer = true;
    Box<Dim> narrow;
    for (int d = 0; d < Dim; ++d) {
      narrow.lo[d] = 2 * j[d] + (d == axis && side == 0 ? 1 : 0);
      narrow.hi[d] = 2 * j[d] + (d == axis && side == 1 ? 1 : 2);
    }
    for_each(narrow, [&](const Index<Dim>& k) {
      if (mesh.block(s).cells.contains(k)) call(s, k);
    });
  }
  if (finer) return;
  Box<Dim> around;
  Index<Dim> offset{};
  for (int d = 0; d < Dim; ++d) around.lo[d] = -1, around.hi[d] = 2;
  offset[axis] = side == 0 ? -1 : 1;
  const int same = mesh.block(slot).neighbour[around.at(offset)];
  if (same >= 0) call(same, j);
}

}  // namespace detail

/// Calls f(slot, cell in the layout) for each cell across a side of cell i of a leaf: of the same level, the
/// one that is wider, or the 2^(Dim-1) that are narrower; across periodic edges as well, nothing beyond
/// others. The leaf must be an own one.
template <int Dim, class F>
void for_each_across(const Mesh<Dim>& mesh, int slot, const Index<Dim>& i, F&& f) {
  const Grid<Dim>& grid = mesh.grid(slot);
  const Box<Dim> layout = grid.layout();
  const auto call = [&](int s, const Index<Dim>& j) { f(s, layout.at(j - mesh.block(s).cells.lo)); };
  for (int d = 0; d < Dim; ++d)
    for (const int side : {0, 1}) {
      Index<Dim> j = i;
      j[d] += side == 0 ? -1 : 1;
      if (mesh.block(slot).cells.contains(j)) {
        call(slot, j);
        continue;
      }
      if ((j[d] < 0 || j[d] >= grid.cells[d]) && !grid.periodic(d)) continue;
      j[d] = (j[d] + grid.cells[d]) % grid.cells[d];
      detail::across_block(mesh, slot, j, d, side, call);
    }
}

}  // namespace recoil
