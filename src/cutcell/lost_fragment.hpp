#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "cutcell/leaving.hpp"
#include "cutcell/transfer.hpp"

/// Fragments of failed matter in cells that the geometry, linear between nodes, shows empty: a disc of less
/// than two cells has all nodes outside.
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

constexpr double most_beside = 0.02;  // of a cell, that others may hold where a lost fragment goes
constexpr double least_space = 0.5;   // of a cell, that must be free where one spreads
constexpr double crowded_cell = 1.1;  // cells of matter in one from which on it spreads

/// Whether a lost fragment may go to a cell at all.
template <int Dim>
bool can_go(const MovesView<Dim>& p, const Index<Dim>& to) {
  return p.exists(to) && p.can_take(to) && !p.is_beside_rigid(to);
}

/// What a lost fragment of more than a cell has beyond it goes to the cell that shares a face with the most
/// room.
template <int Dim>
Transfer<Dim> spread(const MovesView<Dim>& p, const Index<Dim>& i) {
  Transfer<Dim> t;
  const double v = p.volume[p.window.at(i)], whole = p.full(i);
  if (!(v > crowded_cell * whole)) return t;
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

/// How many lines of the mesh what moves with speed u [m/s] crosses in a step: -1, 0 or 1. It is where x = u
/// t says, whole cells only, so that it moves as fast as u on average.
inline int lines_crossed(double u, double time, double dt, double dx) {
  const double lines = std::floor(u * (time + dt) / dx) - std::floor(u * time / dx);
  return static_cast<int>(std::clamp(lines, -1.0, 1.0));
}

/// A lost fragment has no faces through which it could flow: it goes as a whole, by a cell along each axis
/// whose lines it crosses in the step, where there is room, and out of the domain through open edges, which
/// is booked in `edges`.
template <int Dim>
Transfer<Dim> drift(const MovesView<Dim>& p, const Index<Dim>& i, double time, double dt,
                    ExactAccount<Dim>& edges) {
  Transfer<Dim> t;
  const Contents<Dim> q = p.contents(i);
  const double v = p.volume[p.window.at(i)];
  if (!(q[0] > 0) || !(v > 0)) return t;
  const Vec<Dim> u = velocity<Dim>(q);
  t.to = t.state_cell = i;
  bool leaves = false;
  for (int d = 0; d < Dim; ++d) {
    const int lines = lines_crossed(u[d], time, dt, p.grid.dx);
    t.to[d] += lines;
    const bool beyond = t.to[d] < 0 || t.to[d] >= p.grid.cells[d];
    leaves = leaves || (beyond && p.grid.edge[d][lines < 0 ? 0 : 1] == Edge::outflow);
  }
  if (leaves)
    t.to = i;
  else if (t.to == i || !can_go(p, t.to) || p.room(t.to) < std::min(v, (1 - most_beside) * p.full(t.to)))
    return {};
  t.any = t.everything = true;
  t.volume = v;
  t.factor = 1;
  if (leaves && p.window.inner().contains(i)) book<Dim>(q, edges);
  return t;
}

}  // namespace recoil
