#include "gauge/totals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "gauge/totals/body_sums.hpp"
#include "gauge/totals/cell_terms.hpp"
#include "gauge/totals/extent.hpp"
#include "parallel/exact_sums.hpp"

namespace recoil {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double judged_fill = 0.3;  // part of a cell from which on a fragment's strain counts

template <int Dim>
void find_strain(const Grid<Dim>& grid, const BodyBlock<Dim>& b, const Box<Dim>& cells, const SumRow& out) {
  using C = Components<Dim>;
  const Box<Dim> layout = grid.layout();
  const std::size_t n = b.volume.size();
  for_each(cells, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    if (b.volume[k] >= judged_fill * grid.full_volume(i) && b.contents[k] > 0)
      out.raise(BodySums<Dim>::strain, b.contents[C::ep * n + k] / b.contents[k]);
  });
}

template <int Dim>
void sum_block(const State<Dim>& state, const Body<Dim>& body, int slot, CellTerms<Dim>& terms,
               const SumRow& out) {
  const Grid<Dim>& grid = state.grid(slot);
  const BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = grid.layout();
  find_extent(grid, state.grid().dx, b, cells, out);
  find_strain(grid, b, cells, out);
  Box<Dim> starts = cells;  // of the rows
  starts.hi[0] = cells.lo[0] + 1;
  for_each(starts, [&](const Index<Dim>& i) {
    terms.add_row(b, static_cast<std::size_t>(layout.at(i - cells.lo)),
                  static_cast<std::size_t>(cells.hi[0] - cells.lo[0]), grid, i, out.sums);
  });
  terms.flush(out.sums);
}

template <int Dim>
void add(const ExactAccount<Dim>& account, std::span<ExactSum> row) {
  row[0] += account.mass;
  row[1] += account.energy;
  for (std::size_t d = 0; d < Dim; ++d) row[2 + d] += account.momentum.c[d];
}

template <int Dim>
Account<Dim> take_account(std::span<const double> row) {
  Account<Dim> account{row[0], row[1], {}};
  for (std::size_t d = 0; d < Dim; ++d) account.momentum[static_cast<int>(d)] = row[2 + d];
  return account;
}

/// Places of the sums of what a body has exchanged with the outside: behind its account at the edges.
template <int Dim>
struct OutsideSums {
  static constexpr std::size_t released = 2 + Dim, place = released + 1, load = place + Dim,
                               load_moment = load + 2 + Dim, sums = load_moment + 3;
};

template <int Dim>
EdgeAccount<Dim> take_edges(std::span<const double> row) {
  EdgeAccount<Dim> account{take_account<Dim>(row), {}};
  for (std::size_t d = 0; d < Dim; ++d) account.place[static_cast<int>(d)] = row[OutsideSums<Dim>::place + d];
  return account;
}

template <int Dim>
BodyTotals<Dim> take_body(std::span<const double> row) {
  using A = BodySums<Dim>;
  BodyTotals<Dim> t;
  t.mass = row[A::mass], t.kinetic = row[A::kinetic], t.energy = row[A::energy], t.volume = row[A::volume];
  t.speed = row[A::speed], t.cells = std::llround(row[A::cells]);
  t.failed = row[A::failed];
  t.plastic_strain = std::max(row[A::strain], 0.0);
  for (int d = 0; d < 3; ++d) t.angular_momentum[d] = row[A::angular + static_cast<std::size_t>(d)];
  for (int d = 0; d < Dim; ++d) {
    const auto e = static_cast<std::size_t>(d);
    t.momentum[d] = row[A::momentum + e];
    t.place[d] = row[A::place + e];
    const bool somewhere = std::isfinite(row[A::highest + e]);
    t.highest[d] = somewhere ? row[A::highest + e] : no_number;
    t.lowest[d] = somewhere ? -row[A::minus_lowest + e] : no_number;
  }
  return t;
}

/// Where a surface runs into an edge of the domain, balls near it reach beyond; the body ends there, or is
/// mirrored.
template <int Dim>
void end_at_edges(const Grid<Dim>& grid, BodyTotals<Dim>& t) {
  for (int d = 0; d < Dim; ++d) {
    if (grid.periodic(d) || std::isnan(t.lowest[d])) continue;
    const double low = grid.origin[d], high = grid.origin[d] + grid.cells[d] * grid.dx;
    t.lowest[d] = std::clamp(t.lowest[d], low, high);
    t.highest[d] = std::clamp(t.highest[d], low, high);
  }
}

/// Along a periodic axis a body has no one place: it lies on both ends of the domain while it crosses the
/// edge, and its coordinates would jump by the length of the domain.
template <int Dim>
void forget_periodic_places(const Grid<Dim>& grid, BodyTotals<Dim>& t) {
  for (int d = 0; d < Dim; ++d)
    if (grid.periodic(d)) t.place[d] = t.lowest[d] = t.highest[d] = no_number;
}

/// Nor has x cross m u a meaning in a plane with such an axis.
template <int Dim>
void forget_periodic_moments(const Grid<Dim>& grid, Vec<3>& moment) {
  for (int d = 0; d < Dim; ++d)
    for (int about = 0; about < 3; ++about)
      if (grid.periodic(d) && about != d && (Dim == 3 || about == 2)) moment[about] = no_number;
}

/// A free rigid body holds what it has been given; one that moves as prescribed holds nothing.
template <int Dim>
void take_rigid(const RigidMotion<Dim>& m, BodyTotals<Dim>& t) {
  if (!m.mass) return;
  t.mass = m.mass->mass;
  t.momentum = t.mass * m.velocity;
  t.kinetic = kinetic_energy(m);
  t.energy = m.mass->energy;
  t.speed = norm(t.momentum);
  t.place = t.mass * middle_at(m, {m.centre, m.turn});
  t.angular_momentum = m.mass->start_moment;  // to which comes what it has received
}

/// The sums over this rank's blocks of all bodies, found by all threads: each has sums of its own.
template <int Dim>
void add_bodies(const State<Dim>& state, parallel::Team* team, ExactSums& sums) {
  using A = BodySums<Dim>;
  const auto bodies = static_cast<std::size_t>(state.count());
  const std::size_t threads = team != nullptr ? static_cast<std::size_t>(team->threads()) : 1;
  constexpr std::size_t maxima = A::all - A::sums;
  std::vector<ExactSum> own(threads * bodies * A::sums);
  std::vector<double> most(threads * bodies * maxima, -std::numeric_limits<double>::infinity());
  std::vector<CellTerms<Dim>> terms(threads);
  const auto row = [&](std::size_t thread, std::size_t m) {
    const std::size_t at = thread * bodies + m;
    return SumRow{{own.data() + at * A::sums, A::sums}, {most.data() + at * maxima, maxima}};
  };
  const auto work = [&](int slot, int thread) {
    const Block<Dim>& block = state.mesh.block(slot);
    for (std::size_t m = 0; m < bodies; ++m) {
      const Body<Dim>& body = state.bodies[m];
      const SumRow to = row(static_cast<std::size_t>(thread), m);
      if (body.rigid && state.mesh.levels() > 1)  // of which coarse blocks hold nothing
        find_rigid_extent(state, *body.rigid, slot, to);
      else if (body.present(slot) && body.rigid)
        find_extent(state.grid(slot), state.grid().dx, body.at(slot), block.cells, to);
      else if (body.present(slot))
        sum_block(state, body, slot, terms[thread], to);
    }
  };
  if (threads > 1)
    team->run(state.mesh.local(), work);
  else
    for (int slot = 0; slot < state.mesh.local(); ++slot) work(slot, 0);
  for (std::size_t m = 0; m < bodies; ++m) {
    const SumRow to = sums.add(static_cast<int>(m));
    for (std::size_t thread = 0; thread < threads; ++thread) {
      const SumRow from = row(thread, m);
      for (std::size_t k = 0; k < A::sums; ++k) to[k] += from[k];
      for (std::size_t k = 0; k < maxima; ++k) to.raise(A::sums + k, from.maxima[k]);
    }
  }
}

/// What bodies have exchanged with the outside and with each other.
template <int Dim>
void add_ledgers(const State<Dim>& state, ExactSums& sums) {
  using Outside = OutsideSums<Dim>;
  const int bodies = state.count();
  for (const BlockLedger<Dim>& ledger : state.ledger) {
    for (int m = 0; m < bodies; ++m) {
      const auto e = static_cast<std::size_t>(m);
      const SumRow row = sums.add(bodies + m);
      if (e < ledger.edges.size()) {
        add(ledger.edges[e], row.sums);
        for (std::size_t d = 0; d < Dim; ++d) row[Outside::place + d] += ledger.edges[e].place.c[d];
      }
      if (e < ledger.released.size()) row[Outside::released] += ledger.released[e];
      if (e < ledger.loads.size()) {
        add(ledger.loads[e].received, row.sums.subspan(Outside::load));
        for (std::size_t d = 0; d < 3; ++d) row[Outside::load_moment + d] += ledger.loads[e].moment.c[d];
      }
    }
    for (std::size_t p = 0; p < ledger.pairs.size(); ++p) {
      const SumRow row = sums.add(2 * bodies + static_cast<int>(p));
      add(ledger.pairs[p].exchanged, row.sums);
      for (std::size_t d = 0; d < 3; ++d) row[2 + Dim + d] += ledger.pairs[p].moment.c[d];
    }
  }
}

}  // namespace

template <int Dim>
BodyTotals<Dim>& BodyTotals<Dim>::operator+=(const BodyTotals& b) {
  mass += b.mass, kinetic += b.kinetic, energy += b.energy, volume += b.volume;
  momentum += b.momentum, place += b.place, angular_momentum += b.angular_momentum;
  speed += b.speed, failed += b.failed, cells += b.cells;
  plastic_strain = std::max(plastic_strain, b.plastic_strain);
  for (int d = 0; d < Dim; ++d) {  // NaN where a body is nowhere
    lowest[d] = std::fmin(lowest[d], b.lowest[d]);
    highest[d] = std::fmax(highest[d], b.highest[d]);
  }
  return *this;
}

template <int Dim>
Totals<Dim> find_totals(const State<Dim>& state, const parallel::World& world, parallel::Team* team) {
  using A = BodySums<Dim>;
  using Outside = OutsideSums<Dim>;
  const int bodies = state.count(), pairs = bodies * (bodies - 1) / 2;
  ExactSums sums;  // items: all bodies, what they exchange with the outside, all pairs
  for (int m = 0; m < bodies; ++m) sums.item(A::sums, A::all - A::sums);
  for (int m = 0; m < bodies; ++m) sums.item(Outside::sums);
  for (int p = 0; p < pairs; ++p) sums.item(2 + Dim + 3);
  add_bodies(state, team, sums);
  add_ledgers(state, sums);
  sums.reduce(world);
  Totals<Dim> t;
  if (world.rank() != 0) return t;
  t.time = state.time;
  for (int m = 0; m < bodies; ++m) {
    BodyTotals<Dim>& body = t.bodies.emplace_back(take_body<Dim>(sums.total(m)));
    if (state.bodies[m].rigid) take_rigid(*state.bodies[m].rigid, body);
    end_at_edges(state.grid(), body);
    forget_periodic_places(state.grid(), body);
    const std::span<const double> outside = sums.total(bodies + m);
    t.edges.push_back(take_edges<Dim>(outside));
    t.released.push_back(outside[Outside::released]);
    t.loads.push_back(take_account<Dim>(outside.subspan(Outside::load)));
    const auto moment = outside.subspan(Outside::load_moment);
    t.load_moments.push_back({{moment[0], moment[1], moment[2]}});
  }
  for (int p = 0; p < pairs; ++p) {
    const std::span<const double> row = sums.total(2 * bodies + p);
    t.pairs.push_back(take_account<Dim>(row));
    t.moments.push_back({{row[2 + Dim], row[3 + Dim], row[4 + Dim]}});
  }
  for (int m = 0; m < bodies; ++m)
    if (state.bodies[m].rigid && state.bodies[m].rigid->mass)
      t.bodies[m].angular_momentum += received_moment(t, m);
  for (BodyTotals<Dim>& body : t.bodies) forget_periodic_moments(state.grid(), body.angular_momentum);
  for (Vec<3>& moment : t.moments) forget_periodic_moments(state.grid(), moment);
  for (Vec<3>& moment : t.load_moments) forget_periodic_moments(state.grid(), moment);
  return t;
}

template <int Dim>
Account<Dim> received(const Totals<Dim>& totals, int m) {
  Account<Dim> all;
  const int n = static_cast<int>(totals.bodies.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      const double sign = a == m ? 1 : b == m ? -1 : 0;
      if (sign == 0) continue;
      const Account<Dim>& pair = totals.pairs[pair_number(a, b, n)];
      all.mass += sign * pair.mass;
      all.energy += sign * pair.energy;
      all.momentum += sign * pair.momentum;
    }
  return all;
}

template <int Dim>
Vec<3> received_moment(const Totals<Dim>& totals, int m) {
  Vec<3> all;
  const int n = static_cast<int>(totals.bodies.size());
  for (int other = 0; other < n; ++other) {
    if (other == m) continue;
    const Vec<3>& moment = totals.moments[pair_number(std::min(m, other), std::max(m, other), n)];
    all += (m < other ? 1.0 : -1.0) * moment;
  }
  return all;
}

#define RECOIL_INSTANTIATE(Dim)                                                                      \
  template BodyTotals<Dim>& BodyTotals<Dim>::operator+=(const BodyTotals<Dim>&);                     \
  template Totals<Dim> find_totals<Dim>(const State<Dim>&, const parallel::World&, parallel::Team*); \
  template Account<Dim> received<Dim>(const Totals<Dim>&, int);                                      \
  template Vec<3> received_moment<Dim>(const Totals<Dim>&, int);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
