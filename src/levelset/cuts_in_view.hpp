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
  for (int k = 0; k < w.size(); ++k) {
    const bool is_cut = cuts.before[k] >= 0;
    cuts.before[k] = cuts.count;
    cuts.cell[cuts.count] = k;  // of the next one, if this is none
    cuts.count += is_cut ? 1 : 0;
  }
  cuts.before[n] = cuts.count;
  return cuts;
}

/// Calls f(first cell, its place in the window, first number, number beyond the last) for every row of a box
/// that holds cut cells.
template <int Dim, class F>
void for_each_row_of_cuts(const CutsInView& cuts, const Box<Dim>& window, const Box<Dim>& box, F&& f) {
  Box<Dim> rows = box;
  rows.hi[0] = std::min(rows.hi[0], rows.lo[0] + 1);
  const int width = box.extent(0);
  for_each(rows, [&](const Index<Dim>& j) {
    const int at = window.at(j), first = cuts.before[at], end = cuts.before[at + width];
    if (end > first) f(j, at, first, end);
  });
}

}  // namespace recoil
