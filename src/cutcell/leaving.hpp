#pragma once

#include <cstddef>

#include "cutcell/fill.hpp"
#include "cutcell/moves_view.hpp"

/// What leaves the domain through its open edges by moves of volume.
namespace recoil {

/// An open edge of the domain, as seen from a cell at that edge.
struct OpenEdge {
  int axis = -1;  // -1: none
  bool low = false;
};

/// The open edge through which sign * grad phi leaves the domain from a cell: with -1 the body lies beyond
/// it, with 1 the body's surface does. Axis -1: none.
template <int Dim>
OpenEdge open_edge_along(const MovesView<Dim>& p, const Index<Dim>& i, int sign) {
  const Vec<Dim> g = phi_normal(p.window.box(), p.phi, i, p.grid.dx);
  const int axis = main_axis(g);
  const bool low = sign * g[axis] < 0;
  const bool at_edge = g[axis] != 0 && i[axis] == (low ? 0 : p.grid.cells[axis] - 1) &&
                       p.grid.edge[axis][low ? 0 : 1] == Edge::outflow;
  return at_edge ? OpenEdge{axis, low} : OpenEdge{};
}

/// Whether a cut cell at an open edge has so little, or a negative volume, with so little around, that no
/// stencil reaches it any more.
template <int Dim>
bool is_last_at_edge(const MovesView<Dim>& p, const Index<Dim>& i) {
  const int k = p.window.at(i);
  if (p.kind[k] != CellKind::cut || p.volume[k] == 0 || p.volume[k] >= regular_fill * p.full(i)) return false;
  bool at_edge = false;
  for (int d = 0; d < Dim; ++d)
    at_edge = at_edge || (i[d] == 0 && p.grid.edge[d][0] == Edge::outflow) ||
              (i[d] == p.grid.cells[d] - 1 && p.grid.edge[d][1] == Edge::outflow);
  if (!at_edge) return false;
  Box<Dim> around{i, i};
  for (int d = 0; d < Dim; ++d) --around.lo[d], around.hi[d] += 2;
  bool last = true;
  for_each(around,
           [&](const Index<Dim>& j) { last = last && p.volume[p.window.at(j)] < regular_fill * p.full(j); });
  return last;
}

/// Whether what a cell holds leaves through an open edge: it is beyond the surface of a body beyond that
/// edge, or the last of one that moves out.
template <int Dim>
bool leaves_domain(const MovesView<Dim>& p, const Index<Dim>& i) {
  const OpenEdge edge = open_edge_along(p, i, -1);
  if (edge.axis < 0) return false;
  if (p.kind[p.window.at(i)] == CellKind::empty) return true;
  const Contents<Dim> q = p.contents(i);
  const double momentum = q[Components<Dim>::u + static_cast<std::size_t>(edge.axis)];
  const bool upwards = q[Components<Dim>::rho] > 0 ? momentum > 0 : momentum < 0;
  return momentum != 0 && upwards != edge.low;
}

/// Adds what leaves from a place [m] to the account of the edges.
template <int Dim>
void book(const Contents<Dim>& contents, const Vec<Dim>& place, ExactEdgeAccount<Dim>& edges) {
  using C = Components<Dim>;
  edges.leave(contents[C::rho], place);
  edges.energy += contents[C::energy];
  for (std::size_t d = 0; d < Dim; ++d) edges.momentum.c[d] += contents[C::u + d];
}

}  // namespace recoil
