#include "cutcell/moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "cutcell/leaving.hpp"
#include "cutcell/moves_view.hpp"

namespace recoil {

namespace {

// Parts of a cell (volumes), of a face (areas).
constexpr double least_state_fill = 0.02;  // below it a fragment's state carries no volume
constexpr double open_bound = 0.1;         // how far V may be below 0 or above the cell where it is not thin
constexpr double rounding = 1e-13;         // a smaller excess over a whole cell is none
constexpr double ample_fill = 0.3;   // a neighbour with less does not lend to a cell that lacks volume ...
constexpr double ample_times = 4;    // ... nor one with less than so many times what is lacking
constexpr double most_lent = 0.5;    // of what a neighbour has, it gives to a cell without a state
constexpr double fullest_times = 2;  // what takes a negative volume in has more than so many times as much
constexpr double like_speed = 50;    // [m/s] moving otherwise by so much halves the rank of what takes it in
constexpr double least_surface = 0.02;       // area that a surface counts with in the exchange along it
constexpr double closed_face = 1e-9;         // a common face open by less is closed; closed by less, open
constexpr double least_mismatch_area = 0.3;  // a smaller surface counts as so large in V - V_phi over A_I
constexpr double most_mismatch = 0.5;        // [dx] by which phi is asked to follow V at most

/// Something that leaves a cell for another.
template <int Dim>
struct Transfer {
  Index<Dim> to{};
  bool any = false;
  double volume = 0;
  Index<Dim> state_cell{};       // whose state the volume takes along ...
  double factor = 0;             // ... this much of its contents
  bool everything = false;       // the cell is left with nothing
  bool outside = false;          // through an open edge of the domain, `to` is the cell itself
  std::array<double, 3> kept{};  // of `bounded`: what `to` keeps that the volume should have taken along
};

/// Components that cannot fall below zero.
template <int Dim>
inline constexpr std::array<std::size_t, 3> bounded{Components<Dim>::ep, Components<Dim>::temperature_rise,
                                                    Components<Dim>::damage};

/// A neighbour that gives volume at the state of the cell that takes it gives no more plastic strain and heat
/// than it has.
template <int Dim>
void keep_positive(const MovesView<Dim>& p, Transfer<Dim>& t) {
  if (t.everything || t.outside || t.volume >= 0 || p.volume[p.window.at(t.to)] + t.volume <= 0) return;
  const Contents<Dim> state = p.contents(t.state_cell), there = p.contents(t.to);
  for (std::size_t n = 0; n < bounded<Dim>.size(); ++n) {
    const std::size_t c = bounded<Dim>[n];
    const double missing = -(std::max(there[c], 0.0) + t.factor * state[c]);
    if (t.factor * state[c] < 0 && missing > 0) t.kept[n] = missing;
  }
}

template <int Dim>
void add_kept(Contents<Dim>& to, const Transfer<Dim>& t, double sign) {
  for (std::size_t n = 0; n < bounded<Dim>.size(); ++n) to[bounded<Dim>[n]] += sign * t.kept[n];
}

/// The cells that may send something: own ones and those around them. `may(i)` is cheap.
template <int Dim, class May>
int* list_senders(const MovesView<Dim>& p, int& count, Scratch& scratch, May&& may) {
  const Box<Dim> box = p.window.inner().grown(1);
  int* cells = scratch.take<int>(box.size());
  count = 0;
  for_each(box, [&](const Index<Dim>& i) {
    if (may(i)) cells[count++] = p.window.at(i);
  });
  return cells;
}

/// Applies transfers between cells at most one apart: every own cell loses what it sends and gains what its
/// neighbours send it, in the order of their cells. `decide(i)` must depend on the old state only; only cells
/// of the list are asked.
template <int Dim, class Decide>
void transfer(const MovesView<Dim>& p, BodyBlock<Dim>& b, const int* senders, int count, Scratch& scratch,
              Decide&& decide) {
  const std::size_t n = p.window.size();
  int* sent = scratch.take_filled<int>(n, -1);
  auto* touched = scratch.take_filled<std::uint8_t>(n, 0);
  auto* transfers = scratch.take<Transfer<Dim>>(count);
  for (int s = 0; s < count; ++s) {
    const int k = senders[s];
    transfers[s] = decide(p.window.box().index(k));
    if (!transfers[s].any) continue;
    keep_positive(p, transfers[s]);
    sent[k] = s;
    touched[k] = 1;
    touched[p.window.at(transfers[s].to)] = 1;
  }
  for_each(p.window.inner(), [&](const Index<Dim>& i) {
    const int k = p.window.at(i);
    if (!touched[k]) return;
    Update<Dim> u{p.window.cell(i), p.volume[k], p.contents(i)};
    if (sent[k] >= 0) {
      const Transfer<Dim>& own = transfers[sent[k]];
      u.volume -= own.volume;
      if (own.everything) {
        u.volume = 0;
        u.contents = {};
      } else {
        add_scaled<Dim>(u.contents, p.contents(own.state_cell), -own.factor);
        add_kept(u.contents, own, -1);
      }
    }
    Box<Dim> box{i, i};
    for (int d = 0; d < Dim; ++d) --box.lo[d], box.hi[d] += 2;
    for_each(box, [&](const Index<Dim>& j) {
      const int from = sent[p.window.at(j)];
      if (from < 0 || j == i || !(transfers[from].to == i)) return;
      u.volume += transfers[from].volume;
      add_scaled<Dim>(u.contents, p.contents(transfers[from].state_cell), transfers[from].factor);
      add_kept(u.contents, transfers[from], 1);
    });
    b.updates.push_back(u);
  });
}

/// |A_I| of a cut cell, at least least_surface.
template <int Dim>
double surface_area(const Grid<Dim>& grid, const CutCell<Dim>& c, const Index<Dim>& i) {
  return std::max(norm(c.surface), least_surface * grid.dx_power(Dim - 1) * grid.radius(i[0]));
}

/// Volume that flows from cell i to its upper neighbour along axis d in the tangential exchange.
template <int Dim>
double surface_flow(const MovesView<Dim>& p, const Index<Dim>& i, int d, Index<Dim>& source) {
  Index<Dim> j = i;
  ++j[d];
  const CutCell<Dim>*a = p.cut(i), *b = p.cut(j);
  if (!a || !b) return 0;
  const double face = b->open[d][0] / (p.grid.dx_power(Dim - 1) * p.grid.radius(j[0]));
  if (face <= closed_face || (Dim > 1 && face >= 1 - closed_face)) return 0;
  const double area_a = surface_area(p.grid, *a, i), area_b = surface_area(p.grid, *b, j);
  const double va = p.volume[p.window.at(i)], vb = p.volume[p.window.at(j)];
  source = va / p.full(i) > vb / p.full(j) ? i : j;
  if (!(p.volume[p.window.at(source)] > least_state_fill * p.full(source))) return 0;
  return exchange_rate * ((va - a->volume) / area_a - (vb - b->volume) / area_b) * area_a * area_b /
         (area_a + area_b);
}

/// Velocity of what a cell holds [m/s]; 0 without mass.
template <int Dim>
Vec<Dim> velocity(const Contents<Dim>& q) {
  Vec<Dim> u{};
  if (q[Components<Dim>::rho] != 0)
    for (int d = 0; d < Dim; ++d) u[d] = q[Components<Dim>::u + d] / q[Components<Dim>::rho];
  return u;
}

/// Sends what cell i holds to the fullest cell around that has much more: one that shares a face, else a
/// diagonal one. Where it is a negative volume, one that moves otherwise counts as less full: matter m taken
/// off at another velocity takes the heat m |du|^2/2 with it, which the rest has not.
template <int Dim>
void send_to_fullest(const MovesView<Dim>& p, const Index<Dim>& i, Transfer<Dim>& t) {
  const double volume = p.volume[p.window.at(i)], have = std::abs(volume);
  const Vec<Dim> u = velocity<Dim>(p.contents(i));
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
      const double rank = v / p.full(j) * likeness(j);
      if (rank <= best) return;
      best = rank;
      t.to = j;
      t.any = true;
    });
    if (t.any) return;
  }
}

/// Sends to the emptiest cut cell that shares a face with cell i.
template <int Dim>
void send_to_emptiest(const MovesView<Dim>& p, const Index<Dim>& i, Transfer<Dim>& t) {
  double best = 1;
  for (int d = 0; d < Dim; ++d)
    for (int side = -1; side <= 1; side += 2) {
      Index<Dim> j = i;
      j[d] += side;
      const int k = p.window.at(j);
      if (p.kind[k] != CellKind::cut || p.volume[k] / p.full(j) >= best) continue;
      best = p.volume[k] / p.full(j);
      t.to = j;
      t.any = true;
    }
}

/// What a cut cell sends away because its volume is out of bounds.
template <int Dim>
Transfer<Dim> back_into_bounds(const MovesView<Dim>& p, const Index<Dim>& i) {
  Transfer<Dim> t;
  const double v = p.volume[p.window.at(i)], whole = p.full(i), limit = p.thin(i) ? 0.0 : -open_bound;
  t.state_cell = i;
  if (v < limit * whole) {
    send_to_fullest(p, i, t);
    t.volume = v;
    t.factor = 1;
    t.everything = true;
  } else if (v > (1 - limit) * whole && v - whole > rounding * whole) {
    send_to_emptiest(p, i, t);
    t.volume = v - whole;
    t.factor = t.volume / v;
  }
  return t;
}

/// As add_scaled(), but of what cannot fall below zero a cell gives at most an equal share of what it has
/// across each of its faces: volume may leave it in the state of the cell that takes it.
template <int Dim>
void add_given(const MovesView<Dim>& p, const Index<Dim>& giver, const Contents<Dim>& q, double factor,
               Contents<Dim>& to) {
  add_scaled<Dim>(to, q, factor);
  const Contents<Dim> has = p.contents(giver);
  for (const std::size_t c : bounded<Dim>) {
    const double most = std::max(has[c], 0.0) / (2 * Dim), moved = factor * q[c];
    if (std::abs(moved) > most) to[c] += std::copysign(most, factor) - moved;
  }
}

/// What a full cell at an open edge, beyond which the body goes on, gives there or takes from there.
template <int Dim>
Transfer<Dim> across_edge(const MovesView<Dim>& p, const Index<Dim>& i, double excess,
                          ExactAccount<Dim>& edges) {
  Transfer<Dim> t;
  const double v = p.volume[p.window.at(i)];
  if (!(v > least_state_fill * p.full(i))) return t;
  t.to = t.state_cell = i;
  t.any = t.outside = true;
  t.volume = excess;
  t.factor = excess / v;
  Contents<Dim> passes{};
  add_scaled<Dim>(passes, p.contents(i), t.factor);
  if (p.window.inner().contains(i)) book<Dim>(passes, edges);
  return t;
}

}  // namespace

template <int Dim>
void exchange_along_surface(const State<Dim>& state, Body<Dim>& body, int slot, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (Dim == 1 || b.end_geometry.cuts.empty()) return;  // a point has no tangent
  const MovesView<Dim> p(state, body, slot, 1, scratch);
  for (const CutCell<Dim>& cut : b.end_geometry.cuts) {
    const Index<Dim> i = p.window.index_of(cut.cell);
    Update<Dim> u{cut.cell, p.volume[p.window.at(i)], p.contents(i)};
    bool changed = false;
    for (int d = 0; d < Dim; ++d)
      for (int side = -1; side <= 0; ++side) {
        Index<Dim> low = i, source;
        low[d] += side;
        if (!p.exists(low)) continue;
        const double flow = surface_flow(p, low, d, source) * (side == -1 ? 1 : -1);
        if (flow == 0) continue;
        changed = true;
        u.volume += flow;
        Index<Dim> giver = low;
        if ((flow > 0) == (side == 0)) ++giver[d];
        add_given(p, giver, p.contents(source), flow / p.volume[p.window.at(source)], u.contents);
      }
    if (changed) b.updates.push_back(u);
  }
}

template <int Dim>
void measure_mismatch(const State<Dim>& state, Body<Dim>& body, int slot) {
  BodyBlock<Dim>& b = body.at(slot);
  const Grid<Dim>& grid = state.grid();
  const Box<Dim> layout = grid.layout();
  const double face = grid.dx_power(Dim - 1);
  for (CutCell<Dim>& cut : b.end_geometry.cuts) {
    const Index<Dim> i = state.mesh.block(slot).cells.lo + layout.index(cut.cell);
    const double area = std::max(norm(cut.surface), least_mismatch_area * face * grid.radius(i[0]));
    cut.mismatch = std::clamp((b.volume[cut.cell] - cut.volume) / area, -most_mismatch * grid.dx,
                              most_mismatch * grid.dx);
  }
}

template <int Dim>
void empty_outside(const State<Dim>& state, Body<Dim>& body, int slot, ExactAccount<Dim>& edges,
                   Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (!b.near_surface || b.reach.size() == 0) return;
  MovesView<Dim> p(state, body, slot, 2, scratch);
  const auto gives = [&](const Index<Dim>& i) {
    const int k = p.window.at(i);
    return (p.kind[k] == CellKind::empty && p.volume[k] != 0) || is_last_at_edge(p, i);
  };
  int count = 0;
  const int* senders = list_senders(p, count, scratch, gives);
  if (count == 0) return;
  p.gather_phi();
  transfer<Dim>(p, b, senders, count, scratch, [&](const Index<Dim>& i) {
    Transfer<Dim> t;
    const bool leaves = leaves_domain(p, i);
    if (!leaves && p.kind[p.window.at(i)] == CellKind::cut) return t;
    t.to = leaves ? i : p.neighbour(i, -1);
    t.any = leaves || (!(t.to == i) && p.can_take(t.to));
    if (leaves && p.window.inner().contains(i)) book<Dim>(p.contents(i), edges);
    t.volume = p.volume[p.window.at(i)];
    t.state_cell = i;
    t.factor = 1;
    t.everything = true;
    return t;
  });
}

template <int Dim>
void fill_inside(const State<Dim>& state, Body<Dim>& body, int slot, ExactAccount<Dim>& edges,
                 Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (!b.near_surface || b.reach.size() == 0) return;
  MovesView<Dim> p(state, body, slot, 3, scratch);
  const auto excess = [&](const Index<Dim>& i) {
    const int k = p.window.at(i);
    const double e = p.volume[k] - p.full(i);
    return p.kind[k] == CellKind::full && std::abs(e) > rounding * p.full(i) ? e : 0.0;
  };
  int count = 0;
  const int* senders = list_senders(p, count, scratch, [&](const Index<Dim>& i) { return excess(i) != 0; });
  if (count == 0) return;
  p.gather_phi();
  transfer<Dim>(p, b, senders, count, scratch, [&](const Index<Dim>& i) {
    Transfer<Dim> t;
    double e = excess(i);
    if (open_edge_along(p, i, 1).axis >= 0) return across_edge(p, i, e, edges);
    t.to = p.neighbour(i, 1);
    if (t.to == i || !p.takes_part(i)) return t;
    const double there = p.volume[p.window.at(t.to)];
    bool from_own = e > 0 || there < std::max(ample_times * std::abs(e), ample_fill * p.full(t.to));
    if (from_own && !(p.volume[p.window.at(i)] > least_state_fill * p.full(i))) {
      // A cell that the geometry gives to the body before anything of it is there has no state to go by.
      if (!(there > least_state_fill * p.full(t.to))) return t;
      from_own = false;
      e = std::max(e, -most_lent * there);
    }
    if (e < 0 && from_own && there < -e && p.thin(i)) return t;
    t.any = true;
    t.volume = e;
    t.state_cell = from_own ? i : t.to;
    t.factor = e / p.volume[p.window.at(t.state_cell)];
    return t;
  });
}

template <int Dim>
void bound_volumes(const State<Dim>& state, Body<Dim>& body, int slot, Counters& counters, Scratch& scratch) {
  BodyBlock<Dim>& b = body.at(slot);
  b.updates.clear();
  if (!b.near_surface || b.reach.size() == 0) return;
  const MovesView<Dim> p(state, body, slot, 3, scratch);
  const auto beyond = [&](const Index<Dim>& i) {
    const int k = p.window.at(i);
    return p.kind[k] == CellKind::cut && (p.volume[k] < 0 || p.volume[k] > p.full(i));
  };
  int count = 0;
  const int* senders = list_senders(p, count, scratch, beyond);
  if (count == 0) return;
  const auto decide = [&](const Index<Dim>& i) { return back_into_bounds(p, i); };
  for (int s = 0; s < count; ++s) {
    const Index<Dim> i = p.window.box().index(senders[s]);
    if (!p.window.inner().contains(i)) continue;
    const Transfer<Dim> t = decide(i);
    if (t.volume != 0) ++(t.any ? counters.volume_bounds : counters.volume_bounds_left);
  }
  transfer<Dim>(p, b, senders, count, scratch, decide);
}

#define RECOIL_INSTANTIATE(Dim)                                                                       \
  template void exchange_along_surface<Dim>(const State<Dim>&, Body<Dim>&, int, Scratch&);            \
  template void measure_mismatch<Dim>(const State<Dim>&, Body<Dim>&, int);                            \
  template void empty_outside<Dim>(const State<Dim>&, Body<Dim>&, int, ExactAccount<Dim>&, Scratch&); \
  template void fill_inside<Dim>(const State<Dim>&, Body<Dim>&, int, ExactAccount<Dim>&, Scratch&);   \
  template void bound_volumes<Dim>(const State<Dim>&, Body<Dim>&, int, Counters&, Scratch&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
