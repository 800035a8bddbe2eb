#pragma once

#include <algorithm>
#include <cstddef>

#include "core/scratch.hpp"
#include "field/window.hpp"

namespace recoil {

/// The box of cells within `reach` of a cell, cut to a window.
template <int Dim>
Box<Dim> around_cell(const Index<Dim>& centre, int reach, const Box<Dim>& window) {
  Box<Dim> b;
  for (int d = 0; d < Dim; ++d) {
    b.lo[d] = std::max(centre[d] - reach, window.lo[d]);
    b.hi[d] = std::min(centre[d] + reach + 1, window.hi[d]);
  }
  return b;
}

/// The cut cells that a window shows, numbered in the order of its cells: those of a row of cells follow each
/// other.
struct CutsInView {
  int* before = nullptr;  // of every cell of the window, and of its end: how many cut cells come before it
  int* cell = nullptr;    // of every cut cell: its place in the window
  int count = 0;
};

/// @param index_of(slot) places of the cut cells of a block, -1 elsewhere; null where it has none.
template <int Dim, class IndexOf>
CutsInView cuts_in_view(const Window<Dim>& w, const IndexOf& index_of, Scratch& scratch) {
  const auto n = static_cast<std::size_t>(w.size());
  CutsInView cuts{scratch.take<int>(n + 1), scratch.take<int>(n)};
  w.gather(index_of, -1, Beyond::mirror, cuts.before);
  const int width = w.box().extent(0), size = w.size();
  int *const before = cuts.before, *const cell = cuts.cell;
  int count = 0;
  for (int row = 0; row < size; row += width) {
    int all = -1;
    for (int k = row; k < row + width; ++k) all &= before[k];
    if (all < 0) {  // no cut cell: all are -1
      std::fill(before + row, before + row + width, count);
      continue;
    }
    for (int k = row; k < row + width; ++k) {
      const bool is_cut = before[k] >= 0;
      before[k] = count;
      cell[count] = k;  // of the next one, if this is none
      count += is_cut ? 1 : 0;
    }
  }
  before[n] = count;
  cuts.count = count;
  return cuts;
}

/// Calls f(first cell, its place in the window, first number, number beyond the last) for every row of a box
/// that holds cut cells.
template <int Dim, class F>
void for_each_row_of_cuts(const CutsInView& cuts, const Box<Dim>& window, const Box<Dim>& box, F&& f) {
  Box<Dim> rows = box;
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  const int width = box.extent(0);
  const int* const before = cuts.before;
  for_each(rows, [&](const Index<Dim>& j) {
    const int at = window.at(j), first = before[at], end = before[at + width];
    if (end > first) f(j, at, first, end);
  });
}

}  // namespace recoil
