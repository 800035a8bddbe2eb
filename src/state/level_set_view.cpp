#include "state/level_set_view.hpp"

#include <algorithm>

namespace recoil {

namespace {

/// @param edge the last cell of the domain along axis d. @param beyond the cells of the window beyond it.
/// @param outward 1 or -1.
template <int Dim>
void go_on_straight(const Box<Dim>& window, const Box<Dim>& beyond, int d, int edge, int outward, double dx,
                    double* phi) {
  const int step = outward * window.stride(d);
  const auto go_on = [&](double* p, int cells) {
    const double last = p[-cells * step], before = p[-(cells + 1) * step];
    *p = last + cells * std::clamp(last - before, -dx, dx);
  };
  if (d == 0) {
    for_each(beyond, [&](const Index<Dim>& i) { go_on(phi + window.at(i), outward * (i[0] - edge)); });
    return;
  }
  Box<Dim> rows = beyond;
  rows.hi[0] = rows.lo[0] + 1;
  const int width = beyond.extent(0);
  for_each(rows, [&](const Index<Dim>& i) {
    double* const row = phi + window.at(i);
    const int cells = outward * (i[d] - edge);
#pragma GCC ivdep
    for (int c = 0; c < width; ++c) go_on(row + c, cells);
  });
}

template <int Dim>
void continue_beyond_edges(const Grid<Dim>& grid, const Box<Dim>& window, double* phi) {
  for (int d = 0; d < Dim; ++d) {
    const int last = grid.cells[d] - 1;
    if (last == 0) continue;
    Box<Dim> low = window, high = window;
    low.hi[d] = 0, high.lo[d] = last + 1;
    if (grid.edge[d][0] == Edge::outflow && low.lo[d] < 0)
      go_on_straight(window, low, d, 0, -1, grid.dx, phi);
    if (grid.edge[d][1] == Edge::outflow && high.hi[d] > last + 1)
      go_on_straight(window, high, d, last, 1, grid.dx, phi);
  }
}

}  // namespace

template <int Dim>
void view_level_set(const Grid<Dim>& grid, const Body<Dim>& body, const Window<Dim>& window,
                    FieldArray<double> BodyBlock<Dim>::*field, double* out) {
  window.gather([&](int s) { return body.present(s) ? (body.at(s).*field).data() : nullptr; },
                far_cells * grid.dx, Beyond::extend, out);
  continue_beyond_edges(grid, window.box(), out);
}

template void view_level_set<1>(const Grid<1>&, const Body<1>&, const Window<1>&,
                                FieldArray<double> BodyBlock<1>::*, double*);
template void view_level_set<2>(const Grid<2>&, const Body<2>&, const Window<2>&,
                                FieldArray<double> BodyBlock<2>::*, double*);
template void view_level_set<3>(const Grid<3>&, const Body<3>&, const Window<3>&,
                                FieldArray<double> BodyBlock<3>::*, double*);

}  // namespace recoil
