#include "cutcell/moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "cutcell/leaving.hpp"
#include "cutcell/lost_fragment.hpp"
#include "cutcell/moves_view.hpp"
#include "cutcell/taken_volume.hpp"
#include "cutcell/transfer.hpp"
#include "state/alone.hpp"
#include "state/places.hpp"

namespace recoil {

namespace {

// Parts of a cell (volumes), of a face (areas).
constexpr double open_bound = 0.1;  // how far V may be below 0 or above the cell where it is not thin
constexpr double rounding = 1e-13;  // a smaller excess over a whole cell is none
constexpr double counted_excess = open_bound;  // nearer to its cell a volume is moved but not counted
constexpr double ample_fill = 0.3;   // a neighbour with less does not lend to a cell that lacks volume ...
constexpr double ample_times = 4;    // ... nor one with less than so many times what is lacking
constexpr double most_lent = 0.5;    // of what a neighbour has, it gives in its own state
constexpr double fullest_times = 2;  // what takes a negative volume in has more than so many times as much
constexpr double like_speed = 50;    // [m/s] moving otherwise by so much halves the rank of what takes it in
constexpr double least_mismatch_area = 0.3;  // a smaller surface counts as so large in V - V_phi over A_I
constexpr double little_room = 0.02;         // a difference in room of less is none
constexpr double least_taker = 0.1;  // a cell with less of the body does not take what another body displaces
constexpr double most_mismatch = 0.5;  // [dx] by which phi is asked to follow V at most

/// Sends what cell i holds to the fullest cell around that has much more: one that shares a face, else a
/// diagonal one. Where it is a negative volume, one that moves otherwise counts as less full: matter m taken
/// off at another velocity takes the heat m |du|^2/2 with it, which the rest has not. A cell that is mostly
/// void, with less mass than is missing, does not take it.
template <int Dim>
void send_to_fullest(const MovesView<Dim>& p, const Index<Dim>& i, Transfer<Dim>& t) {
  const double volume = p.volume[p.window.at(i)], have = std::abs(volume);
  const Contents<Dim> q = p.contents(i);
  const Vec<Dim> u = velocity<Dim>(q);
  const auto likeness = [&](const Index<Dim>& j) {
    if (volume >= 0) return 1.0;
    const Vec<Dim> du = velocity<Dim>(p.contents(j)) - u;
    return 1 / (1 + dot(du, du) / (like_speed * like_speed));
  };
  Box<Dim> box{i, i};
  for (int d = 0; d < Dim; ++d) --box.lo[d], box.hi[d] += 2;
  for (const bool diagonal : {false, true}) {
    double best = 0;
    for_each(box, [&](const Index<Dim>& j) {
      int apart = 0;
      for (int d = 0; d < Dim; ++d) apart += j[d] != i[d];
      if (apart == 0 || (apart > 1) != diagonal) return;
      const double v = p.volume[p.window.at(j)];
      if (v <= fullest_times * have || v <= least_state_fill * p.full(j)) return;
      if (q[0] < 0 && p.contents(j)[0] + q[0] <= 0) return;
      const double rank = v / p.full(j) * likeness(j);
      if (rank <= best) return;
      best = rank;
      t.to = j;
      t.any = true;
    });
    if (t.any) return;
  }
}

/// Sends to the cut cell with the most room that shares a face with cell i.
template <int Dim>
void send_to_roomiest(const MovesView<Dim>& p, const Index<Dim>& i, Transfer<Dim>& t) {
  double best = 0;
  for (int d = 0; d < Dim; ++d)
    for (int side = -1; side <= 1; side += 2) {
      Index<Dim> j = i;
      j[d] += side;
      if (p.kind[p.window.at(j)] != CellKind::cut || p.room(j) / p.full(j) <= best) continue;
      best = p.room(j) / p.full(j);
      t.to = j;
      t.any = true;
    }
}

/// Where what cell i holds goes: to its neighbour `inward`, but where another body leaves no room there, to
/// the cell around cell i with the most, of those farther inside that hold some of the body.
template <int Dim>
Index<Dim> with_room(const MovesView<Dim>& p, const Index<Dim>& i, const Index<Dim>& inward) {
  const double needed = p.volume[p.window.at(i)] - little_room * p.full(i);
  if (inward == i || !p.is_shared(inward) || p.room(inward) >= needed) return inward;
  Index<Dim> best = inward;
  Box<Dim> box{i, i};
  for (int d = 0; d < Dim; ++d) --box.lo[d], box.hi[d] += 2;
  for_each(box, [&](const Index<Dim>& j) {
    if (j == i || !p.exists(j) || !p.can_take(j)) return;
    const int k = p.window.at(j);
    const bool takes = p.kind[k] != CellKind::empty && p.phi[k] < p.phi[p.window.at(i)] &&
                       p.volume[k] >= least_taker * p.full(j);
    if (takes && p.room(j) / p.full(j) > p.room(best) / p.full(best) + little_room) best = j;
  });
  return best;
}

/// Least volume that a cut cell may have at a place: none where the body is thin, else a little below zero.
template <int Dim>
double least_volume(const MovesView<Dim>& p, const Index<Dim>& i) {
  return p.thin(i) ? 0.0 : -open_bound * p.full(i);
}

template <int Dim>
bool failed_at(const MovesView<Dim>& p, const Index<Dim>& i) {
  const Contents<Dim> q = p.contents(i);
  return q[Components<Dim>::damage] >= failed_damage * q[0];
}

/// All that cell i holds, a negative volume, for the fullest cell around to take in.
template <int Dim>
Transfer<Dim> taken_in(const MovesView<Dim>& p, const Index<Dim>& i) {
  Transfer<Dim> t;
  t.state_cell = i;
  send_to_fullest(p, i, t);
  t.volume = p.volume[p.window.at(i)];
  t.factor = 1;
  t.everything = true;
  return t;
}

/// What a cut cell sends away because its volume is out of bounds.
template <int Dim>
Transfer<Dim> back_into_bounds(const MovesView<Dim>& p, const Index<Dim>& i) {
  Transfer<Dim> t;
  const double v = p.volume[p.window.at(i)], whole = p.full(i), least = least_volume(p, i);
  if (v < least) return taken_in(p, i);
  t.state_cell = i;
  if (v > whole - least && v - whole > rounding * whole) {
    send_to_roomiest(p, i, t);
    t.volume = v - whole;
    t.factor = t.volume / v;
  }
  return t;
}

/// What a full cell passes on to its neighbour inwards, or takes from there: in its own state, so that its
/// density stays, else in that of the neighbour.
template <int Dim>
Transfer<Dim> made_full(const MovesView<Dim>& p, const Index<Dim>& i, double excess, bool may_fail,
                        double slack) {
  Transfer<Dim> t;
  t.to = p.neighbour(i, 1);
  if (t.to == i || !p.takes_part(i)) return t;
  const double own = p.volume[p.window.at(i)], there = p.volume[p.window.at(t.to)];
  const bool passes_on = excess > 0;
  const bool ample = there >= std::max(ample_times * std::abs(excess), ample_fill * p.full(t.to));
  bool in_own_state = passes_on || !ample;
  if (in_own_state) {
    // A cell that the geometry gives to the body before anything of it is there has no state to go by.
    bool neighbours_state = !(own > least_state_fill * p.full(i));
    if (!passes_on && !neighbours_state) {
      const double most = may_fail ? most_by_density(p, i, t.to) : infinite;
      neighbours_state = -excess > most && failed_at(p, i);
      if (!neighbours_state) excess = std::max(excess, -most);  // void would put it under tension
      neighbours_state = neighbours_state || -excess > most_by_heat(p, i, t.to, slack);
    }
    if (neighbours_state) {
      if (!(there > least_state_fill * p.full(t.to))) return t;
      in_own_state = false;
      excess = std::max(excess, -most_lent * there);
    }
  }
  if (!passes_on && in_own_state && there + excess < least_volume(p, i)) return t;
  if (!passes_on && slack < infinite) excess = -share_of(p, i, t.to, -excess);
  t.any = true;
  t.volume = excess;
  t.state_cell = in_own_state ? i : t.to;
  t.factor = excess / p.volume[p.window.at(t.state_cell)];
  return t;
}

/// What a full cell at an open edge, beyond which the body goes on, gives there or takes from there.
template <int Dim>
Transfer<Dim> across_edge(const MovesView<Dim>& p, const Index<Dim>& i, double excess,
                          ExactEdgeAccount<Dim>& edges) {
  Transfer<Dim> t;
  const double v = p.volume[p.window.at(i)];
  if (!(v > least_state_fill * p.full(i))) return t;
  t.to = t.state_cell = i;
  t.any = t.outside = true;
  t.volume = excess;
  t.factor = excess / v;
  Contents<Dim> passes{};
  add_scaled<Dim>(passes, p.contents(i), t.factor);
  if (p.window.inner().contains(i)) book<Dim>(passes, p.grid.centre(i), edges);
  return t;
}

}  // namespace

template <int Dim>
void measure_mismatch(const State<Dim>& state, Body<Dim>& body, int slot) {
  BodyBlock<Dim>& b = body.at(slot);
  const Grid<Dim>& grid = state.grid();
  const Box<Dim> layout = grid.layout();
  const double face = grid.dx_power(Dim - 1);
  for (CutCell<Dim>& cut : b.end_geometry.cuts) {
    const Index<Dim> i = state.mesh.block(slot).cells.lo + layout.index(cut.cell);
    const double area = std::max(norm(cut.surface), least_mismatch_area * face * grid.weight(i[0]));
    const auto k = static_cast<std::size_t>(cut.cell);
    cut.failed = can_fail(body.material.damage) && b.contents[k] > 0 && has_failed(b, k);
    cut.mismatch = std::clamp((b.volume[cut.cell] - cut.volume) / area, -most_mismatch * grid.dx,
                              most_mismatch * grid.dx);
  }
}

template <int Dim>
void empty_outside(const State<Dim>& state, Body<Dim>& body, int slot, double dt,
                   ExactEdgeAccount<Dim>& edges, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (!b.near_surface || b.reach.size() == 0) return;
  MovesView<Dim> p(state, body, slot, 3, scratch);  // what is lost around the place where a fragment may go
  int listed = 0;
  const bool may_fail = can_fail(body.material.damage);
  int* senders = list_senders(p, listed, scratch, [may_fail](CellKind kind, double volume, double /*full*/) {
    return ((kind != CellKind::full) & (volume != 0)) | (may_fail & (volume < 0) & (kind == CellKind::full));
  });
  const auto stays = [&](int k) {
    return p.kind[k] == CellKind::cut && !is_last_at_edge(p, p.window.box().index(k));
  };
  const auto count = static_cast<int>(std::remove_if(senders, senders + listed, stays) - senders);
  if (count == 0) return;
  p.gather_phi();
  p.gather_others();
  transfer<Dim>(p, b, senders, count, scratch, [&](const Index<Dim>& i) {
    Transfer<Dim> t;
    if (p.kind[p.window.at(i)] == CellKind::full) return p.takes_part(i) ? taken_in(p, i) : t;
    const bool leaves = leaves_domain(p, i);
    if (!leaves && p.kind[p.window.at(i)] == CellKind::cut) return t;
    t.to = leaves ? i : with_room(p, i, p.neighbour(i, -1));
    t.any = leaves || (!(t.to == i) && p.can_take(t.to));
    if (leaves && p.window.inner().contains(i)) book<Dim>(p.contents(i), p.grid.centre(i), edges);
    t.volume = p.volume[p.window.at(i)];
    t.state_cell = i;
    t.factor = 1;
    t.everything = true;
    if (!leaves && may_fail) {
      const auto from = p.window.source_inside(i);
      const bool failed = has_failed(body.at(from.slot), static_cast<std::size_t>(from.cell));
      if (t.any && is_alone(state, body, from.slot, from.cell)) keep_without_room(p, i, failed, t);
      t = move_lost(p, i, t, state.time, dt, edges);
    }
    return t;
  });
}

template <int Dim>
void fill_inside(const State<Dim>& state, Body<Dim>& body, int slot, ExactEdgeAccount<Dim>& edges,
                 Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (!b.near_surface || b.reach.size() == 0) return;
  MovesView<Dim> p(state, body, slot, 3, scratch);
  int count = 0;
  const int* senders = list_senders(p, count, scratch, [](CellKind kind, double volume, double full) {
    return (kind == CellKind::full) & (std::abs(volume - full) > rounding * full);
  });
  if (count == 0) return;
  p.gather_phi();
  const bool may_fail = can_fail(body.material.damage);
  const double slack = slack_of_heat(body.material);
  transfer<Dim>(p, b, senders, count, scratch, [&](const Index<Dim>& i) {
    const double excess = p.volume[p.window.at(i)] - p.full(i);
    if (open_edge_along(p, i, 1).axis >= 0) return across_edge(p, i, excess, edges);
    return made_full(p, i, excess, may_fail, slack);
  });
}

template <int Dim>
void bound_volumes(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (!b.near_surface || b.reach.size() == 0) return;
  MovesView<Dim> p(state, body, slot, 3, scratch);
  int count = 0;
  const int* senders = list_senders(p, count, scratch, [](CellKind kind, double volume, double full) {
    return (kind == CellKind::cut) & ((volume < 0) | (volume > full));
  });
  if (count == 0) return;
  p.gather_others();
  const auto decide = [&](const Index<Dim>& i) { return back_into_bounds(p, i); };
  for (int s = 0; s < count; ++s) {
    const Index<Dim> i = p.window.box().index(senders[s]);
    if (!p.window.inner().contains(i)) continue;
    const Transfer<Dim> t = decide(i);
    if (std::abs(t.volume) > counted_excess * p.full(i))
      ++(t.any ? counters.volume_bounds : counters.volume_bounds_left);
  }
  transfer<Dim>(p, b, senders, count, scratch, decide);
}

#define RECOIL_INSTANTIATE(Dim)                                                                         \
  template void measure_mismatch<Dim>(const State<Dim>&, Body<Dim>&, int);                              \
  template void empty_outside<Dim>(const State<Dim>&, Body<Dim>&, int, double, ExactEdgeAccount<Dim>&,  \
                                   Scratch&);                                                           \
  template void fill_inside<Dim>(const State<Dim>&, Body<Dim>&, int, ExactEdgeAccount<Dim>&, Scratch&); \
  template void bound_volumes<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
