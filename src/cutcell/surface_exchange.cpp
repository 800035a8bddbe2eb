#include "cutcell/surface_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "cutcell/moves_view.hpp"
#include "cutcell/taken_volume.hpp"
#include "cutcell/transfer.hpp"

namespace recoil {

namespace {

constexpr double least_surface = 0.02;  // part of a face that a surface counts with at least
constexpr double closed_face = 1e-9;    // a common face open by less is closed; closed by less, open

/// Volume that leaves one cell for another, and the cell whose state it has.
template <int Dim>
struct SurfaceFlow {
  double volume = 0;  // [m^Dim]; 0: nothing flows
  Index<Dim> giver{}, taker{}, state_cell{};
};

/// |A_I| of a cut cell, at least least_surface.
template <int Dim>
double surface_area(const Grid<Dim>& grid, const CutCell<Dim>& c, const Index<Dim>& i) {
  return std::max(norm(c.surface), least_surface * grid.dx_power(Dim - 1) * grid.weight(i[0]));
}

/// Volume [m^Dim] that flows from cell i to its upper neighbour along axis d. Into a cell that another body
/// has a part of goes no more than there is room for: beside a corner, whose linear cut shows less than
/// there is, bodies would overlap.
template <int Dim>
double volume_to_upper(const MovesView<Dim>& p, const Index<Dim>& i, const Index<Dim>& j, int d) {
  const CutCell<Dim>*a = p.cut(i), *b = p.cut(j);
  if (!a || !b) return 0;
  const double face = b->open[d][0] / (p.grid.dx_power(Dim - 1) * p.grid.weight(j[0]));
  if (face <= closed_face || (Dim > 1 && face >= 1 - closed_face)) return 0;
  const double area_a = surface_area(p.grid, *a, i), area_b = surface_area(p.grid, *b, j);
  const double flow =
      exchange_rate *
      ((p.volume[p.window.at(i)] - a->volume) / area_a - (p.volume[p.window.at(j)] - b->volume) / area_b) *
      area_a * area_b / (area_a + area_b);
  const Index<Dim>& to = flow > 0 ? j : i;
  if (!p.is_shared(to)) return flow;
  const double room = std::max(0.0, p.room(to));
  return std::clamp(flow, -room, room);
}

/// What flows between cell i and its upper neighbour along axis d: in the state of the fuller one. Across
/// each of its 2 Dim faces a cell gives, in the state of another, at most so much that all faces together
/// leave it half of its mass and no colder than by `slack` [J/kg]; where it would be more, it gives in its
/// own state.
template <int Dim>
SurfaceFlow<Dim> flow_along_surface(const MovesView<Dim>& p, const Index<Dim>& i, int d, double slack) {
  Index<Dim> j = i;
  ++j[d];
  const double flow = volume_to_upper(p, i, j, d);
  if (flow == 0) return {};
  SurfaceFlow<Dim> s{std::abs(flow), flow > 0 ? i : j, flow > 0 ? j : i, {}};
  const auto has = [&](const Index<Dim>& cell) { return p.volume[p.window.at(cell)]; };
  s.state_cell = has(i) / p.full(i) > has(j) / p.full(j) ? i : j;
  if (!(has(s.state_cell) > least_state_fill * p.full(s.state_cell))) return {};
  if (s.state_cell == s.giver || slack == infinite) return s;
  constexpr int faces = 2 * Dim;
  const double most =
      std::min(most_by_mass(p, s.taker, s.giver) / faces, most_by_heat(p, s.taker, s.giver, slack / faces));
  if (s.volume <= most) return s;
  if (has(s.giver) > least_state_fill * p.full(s.giver)) {
    s.state_cell = s.giver;
    s.volume = std::min(s.volume, has(s.giver) / faces);
  } else {
    s.volume = most;
  }
  return s;
}

/// As add_scaled(), but of what cannot fall below zero a cell gives at most an equal share of what it has
/// across each of its faces: volume may leave it in the state of the cell that takes it. The mass that it
/// gives has its own damage.
template <int Dim>
void add_given(const MovesView<Dim>& p, const Index<Dim>& giver, const Contents<Dim>& q, double factor,
               Contents<Dim>& to) {
  add_scaled<Dim>(to, q, factor);
  const Contents<Dim> has = p.contents(giver);
  for (const std::size_t c : bounded<Dim>) {
    if (c == Components<Dim>::damage && has[0] > 0) {
      to[c] += factor * (q[0] * (has[c] / has[0]) - q[c]);
      continue;
    }
    const double most = std::max(has[c], 0.0) / (2 * Dim), moved = factor * q[c];
    if (std::abs(moved) > most) to[c] += std::copysign(most, factor) - moved;
  }
}

}  // namespace

template <int Dim>
void exchange_along_surface(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (Dim == 1 || b.end_geometry.cuts.empty()) return;  // a point has no tangent
  MovesView<Dim> p(state, body, slot, 1, scratch);
  p.gather_others();
  const double slack = slack_of_heat(body.material);
  for (const CutCell<Dim>& cut : b.end_geometry.cuts) {
    const Index<Dim> i = p.window.index_of(cut.cell);
    Update<Dim> u{cut.cell, p.volume[p.window.at(i)], p.contents(i)};
    bool changed = false;
    for (int d = 0; d < Dim; ++d)
      for (int side = -1; side <= 0; ++side) {
        Index<Dim> low = i;
        low[d] += side;
        if (!p.exists(low)) continue;
        const SurfaceFlow<Dim> s = flow_along_surface(p, low, d, slack);
        if (s.volume == 0) continue;
        changed = true;
        const double flow = s.taker == i ? s.volume : -s.volume;
        u.volume += flow;
        add_given(p, s.giver, p.contents(s.state_cell), flow / p.volume[p.window.at(s.state_cell)],
                  u.contents);
      }
    if (changed) b.updates.push_back(u);
  }
}

#define RECOIL_INSTANTIATE(Dim) \
  template void exchange_along_surface<Dim>(const State<Dim>&, Body<Dim>&, int, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
