#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "dynamics/block_work.hpp"
#include "dynamics/flux.hpp"
#include "dynamics/partly_open.hpp"
#include "state/body.hpp"

namespace recoil::detail {

/// All faces of a block's cells across one axis: their open areas, and where their fluxes go.
template <int Dim>
struct Faces {
  Box<Dim> box;
  const double* area = nullptr;
  FaceFlux<Dim> flux;
  PartlyOpen<Dim> partly;

  FaceFlux<Dim> flux_at(int face) const { return {flux.flux, flux.velocity, flux.faces, face}; }
};

/// Places of the first open face of a row of `width` faces, and behind the last. Empty: both 0.
struct Span {
  int lo = 0, hi = 0;
  bool empty() const { return hi <= lo; }
};

inline Span open_span(const double* area, int width) {
  int lo = 0, hi = width;
  while (lo < hi && area[lo] == 0) ++lo;
  while (hi > lo && area[hi - 1] == 0) --hi;
  return hi > lo ? Span{lo, hi} : Span{};
}

inline Span both(const Span& a, const Span& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

/// Faces across axis 0: a row of cells holds both sides of its row of faces.
template <int Dim, bool Shear>
void solve_along_rows(const AnyEos& eos, const Work<Dim>& w, const Faces<Dim>& out, Counters& counters) {
  FaceValues<Dim> low, high;
  Box<Dim> rows = out.box;
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](const Index<Dim>& r) {
    const int at_face = out.box.at(r), at_cell = w.window.at(r);
    const Span open = open_span(out.area + at_face, out.box.extent(0));
    for (int from = open.lo; from < open.hi; from += longest_row - 1) {
      const int count = std::min(open.hi - from, longest_row - 1);
      Row<Dim> row = w.row(at_cell + from - 1, 1, whole_vectors(count + 1));
      reconstruct<Dim, 0, Shear>(eos, row, 0, low, high);
      ++row.first;
      row.count = count;
      move_to_open_parts(w, out.partly, count, at_face + from, at_cell + from, 1, high, 0, low, 1);
      counters.first_order_faces +=
          solve_faces<Dim, 0, Shear>(eos, row, high, 0, low, 1, out.flux_at(at_face + from));
    }
  });
}

/// Faces across another axis: row by row along it; what a row of cells has at its high faces waits for the
/// next.
template <int Dim, int Axis, bool Shear>
void solve_across_rows(const AnyEos& eos, const Work<Dim>& w, const Faces<Dim>& out, Counters& counters) {
  FaceValues<Dim> low, high_a, high_b;
  FaceValues<Dim>*high = &high_a, *behind = &high_b;
  const std::ptrdiff_t step = w.window.stride(Axis);
  const int next = out.box.stride(Axis), width = out.box.extent(0), layers = out.box.extent(Axis);
  Box<Dim> columns = out.box;
  columns.hi[0] = columns.lo[0] + 1;
  columns.hi[Axis] = columns.lo[Axis] + 1;
  for_each(columns, [&](const Index<Dim>& r) {
    for (int from = 0; from < width; from += longest_row) {
      const int count = std::min(width - from, longest_row);
      const int at_face = out.box.at(r) + from, at_cell = w.window.at(r) + from;
      Span open;
      for (int layer = -1; layer < layers; ++layer) {  // of cells; its high faces are faces layer + 1
        const std::ptrdiff_t first = at_cell + layer * step;
        const Span ahead =
            layer + 1 < layers ? open_span(out.area + at_face + (layer + 1) * next, count) : Span{};
        const Span all = both(open, ahead);
        if (!all.empty())
          reconstruct<Dim, Axis, Shear>(eos, w.row(first + all.lo, step, whole_vectors(all.hi - all.lo)),
                                        all.lo, low, *high);
        if (!open.empty()) {
          const int n = open.hi - open.lo, face = at_face + layer * next + open.lo;
          move_to_open_parts(w, out.partly, n, face, first + open.lo, step, *behind, open.lo, low, open.lo);
          counters.first_order_faces += solve_faces<Dim, Axis, Shear>(
              eos, w.row(first + open.lo, step, n), *behind, open.lo, low, open.lo, out.flux_at(face));
        }
        std::swap(high, behind);
        open = ahead;
      }
    }
  });
}

/// Faces of a scheme that knows rows of faces only.
template <int Dim, int Axis, bool Shear, class Scheme>
void solve_row_by_row(const AnyEos& eos, const Work<Dim>& w, const Faces<Dim>& out, Counters& counters) {
  const std::ptrdiff_t step = w.window.stride(Axis);
  Box<Dim> rows = out.box;
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](const Index<Dim>& r) {
    const int at_face = out.box.at(r), at_cell = w.window.at(r);
    const Span open = open_span(out.area + at_face, out.box.extent(0));
    for (int from = open.lo; from < open.hi; from += longest_row) {
      const Row<Dim> row = w.row(at_cell + from, step, std::min(open.hi - from, longest_row));
      counters.first_order_faces +=
          Scheme::template fluxes<Dim, Axis, Shear>(eos, row, out.flux_at(at_face + from));
    }
  });
}

}  // namespace recoil::detail
