#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "cutcell/leaving.hpp"
#include "cutcell/transfer.hpp"
#include "state/alone.hpp"
#include "state/places.hpp"

/// Fragments of matter that can fail in cells that the geometry, linear between nodes, shows empty: a disc of
/// less than two cells has all nodes outside.
namespace recoil {

/// How many cells around one the geometry shows empty although they hold matter.
template <int Dim>
int lost_around(const MovesView<Dim>& p, const Index<Dim>& i) {
  Box<Dim> box{i, i};
  for (int d = 0; d < Dim; ++d) --box.lo[d], box.hi[d] += 2;
  int count = 0;
  for_each(box, [&](const Index<Dim>& j) {
    if (j == i || !p.window.box().contains(j)) return;
    const int k = p.window.at(j);
    if (p.kind[k] == CellKind::empty && p.volume[k] > 0) ++count;
  });
  return count;
}

/// Of matter that has no room where it is sent, what is too much stays: fragments whose level set has fallen
/// behind their matter get it back (restore_level_set()), instead of being pressed into one cell.
/// @param failed whether it is a fragment of failed matter. Then all that may send to a cell share its room,
/// and where the geometry has lost that cell too, only a fuller one takes: else two would change places in
/// each step.
template <int Dim>
void keep_without_room(const MovesView<Dim>& p, const Index<Dim>& from, bool failed, Transfer<Dim>& t) {
  const int to = p.window.at(t.to);
  if (failed && p.kind[to] == CellKind::empty && !(p.volume[to] > p.volume[p.window.at(from)])) {
    t = {};
    return;
  }
  const double room = (p.full(t.to) - p.volume[to]) / (failed ? std::max(lost_around(p, t.to), 1) : 1);
  if (!(t.volume > room)) return;
  t.everything = false;
  t.any = room > 0;
  t.factor = room / t.volume;
  t.volume = room;
}

inline constexpr double most_beside = 0.02;  // of a cell, that others may hold where a lost fragment goes
inline constexpr double least_space = 0.5;   // of a cell, that must be free where one spreads
inline constexpr double surely_reached = 3;  // [dx] from the surface

/// Whether a lost fragment may go to a cell at all. Cells that the bands of the last step left out (phi >=
/// reach_cells dx) take no part in moves; two redistancings before the moves bring them 2 and 0.4 dx nearer
/// at most (redistance_band()).
template <int Dim>
bool can_go(const MovesView<Dim>& p, const Index<Dim>& to) {
  if (!p.exists(to) || p.is_beside_rigid(to)) return false;
  const int k = p.window.at(to);
  return p.phi[k] < surely_reached * p.grid.dx || p.volume[k] != 0;
}

/// What a lost fragment of more than a cell has beyond it goes to the cell that shares a face with the most
/// room.
template <int Dim>
Transfer<Dim> spread(const MovesView<Dim>& p, const Index<Dim>& i) {
  Transfer<Dim> t;
  const double v = p.volume[p.window.at(i)], whole = p.full(i);
  if (!(v > crowded * whole)) return t;
  double best = least_space;
  for (int d = 0; d < Dim; ++d)
    for (int side = -1; side <= 1; side += 2) {
      Index<Dim> j = i;
      j[d] += side;
      if (!can_go(p, j) || p.room(j) <= best * p.full(j)) continue;
      best = p.room(j) / p.full(j);
      t.to = j;
      t.any = true;
    }
  if (!t.any) return t;
  t.state_cell = i;
  t.volume = std::min(v - whole, best * p.full(t.to));
  t.factor = t.volume / v;
  return t;
}

/// How many borders between cells x = u t [m] crosses in a step, one at most either way: so matter that moves
/// by whole cells is as fast as u on average.
inline int borders_crossed(double u, double time, double dt, double dx) {
  const double borders = std::floor(u * (time + dt) / dx) - std::floor(u * time / dx);
  return static_cast<int>(std::clamp(borders, -1.0, 1.0));
}

/// The cell to which what cell i holds moves in a step by its velocity; i itself: it stays.
template <int Dim>
Index<Dim> next_place(const MovesView<Dim>& p, const Index<Dim>& i, const Contents<Dim>& q, double time,
                      double dt) {
  Index<Dim> to = i;
  const Vec<Dim> u = velocity<Dim>(q);
  for (int d = 0; d < Dim; ++d) to[d] += borders_crossed(u[d], time, dt, p.grid.dx);
  return to;
}

/// Whether a cell holds a lost fragment.
template <int Dim>
bool holds_lost(const MovesView<Dim>& p, const Index<Dim>& i, const Contents<Dim>& q) {
  const int k = p.window.at(i);
  return p.kind[k] == CellKind::empty && p.volume[k] > 0 && q[0] > 0;
}

/// Room [m^Dim] in a cell once lost fragments of the body that go on in this step have left it.
template <int Dim>
double room_after(const MovesView<Dim>& p, const Index<Dim>& i, double time, double dt) {
  if (p.kind[p.window.at(i)] != CellKind::empty || p.volume[p.window.at(i)] == 0) return p.room(i);
  const Contents<Dim> q = p.contents(i);
  const bool leaves = holds_lost(p, i, q) && !(next_place(p, i, q, time, dt) == i);
  return p.room(i) + (leaves ? p.volume[p.window.at(i)] : 0);
}

/// Whether a place lies beyond an open edge of the domain.
template <int Dim>
bool is_outside(const MovesView<Dim>& p, const Index<Dim>& to) {
  for (int d = 0; d < Dim; ++d)
    if ((to[d] < 0 && p.grid.edge[d][0] == Edge::outflow) ||
        (to[d] >= p.grid.cells[d] && p.grid.edge[d][1] == Edge::outflow))
      return true;
  return false;
}

/// Whether a lost fragment of volume v [m^Dim] has room at a place, whose whole cell may be smaller than its
/// own (beside the axis of symmetry).
template <int Dim>
bool has_room_at(const MovesView<Dim>& p, const Index<Dim>& from, const Index<Dim>& to, double v, double time,
                 double dt) {
  return can_go(p, to) && room_after(p, to, time, dt) >= std::min(v, (1 - most_beside) * p.full(from));
}

/// A lost fragment has no faces through which it could flow: it goes as a whole, by a cell along each axis
/// whose borders it crosses in the step, or along one of them, where there is room; and out of the domain
/// through open edges, which is booked in `edges`.
template <int Dim>
Transfer<Dim> drift(const MovesView<Dim>& p, const Index<Dim>& i, double time, double dt,
                    ExactEdgeAccount<Dim>& edges) {
  Transfer<Dim> t;
  const Contents<Dim> q = p.contents(i);
  if (!holds_lost(p, i, q)) return t;
  const Index<Dim> next = next_place(p, i, q, time, dt);
  if (next == i) return t;
  t.state_cell = t.to = i;
  t.volume = p.volume[p.window.at(i)];
  t.factor = 1;
  t.everything = true;
  if (is_outside(p, next)) {
    t.any = true;
    if (p.window.inner().contains(i)) book<Dim>(q, p.grid.centre(i), edges);
    return t;
  }
  std::array<Index<Dim>, Dim + 1> places;
  places.fill(i);
  places[0] = next;
  for (int d = 0; d < Dim; ++d) places[static_cast<std::size_t>(d) + 1][d] = next[d];
  for (const Index<Dim>& to : places) {
    if (to == i || !has_room_at(p, i, to, t.volume, time, dt)) continue;
    t.to = to;
    t.any = true;
    break;
  }
  return t;
}

/// What becomes of a lost fragment, `inwards` being what its body takes of it: if not all, it goes on with
/// its velocity or spreads.
template <int Dim>
Transfer<Dim> move_lost(const MovesView<Dim>& p, const Index<Dim>& i, const Transfer<Dim>& inwards,
                        double time, double dt, ExactEdgeAccount<Dim>& edges) {
  if (inwards.any && inwards.everything) return inwards;
  const Transfer<Dim> on = drift(p, i, time, dt, edges);
  if (on.any || inwards.any) return on.any ? on : inwards;
  return spread(p, i);
}

}  // namespace recoil
