#include "gauge/totals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "parallel/ordered_sums.hpp"

namespace recoil {

namespace {

constexpr double judged_fill = 0.3;  // part of a cell from which on a fragment's strain counts

/// Places of the sums and maxima of one body in a row of OrderedSums.
template <int Dim>
struct At {
  static constexpr std::size_t mass = 0, momentum = 1, kinetic = momentum + Dim, energy = kinetic + 1,
                               volume = energy + 1, speed = volume + 1, cells = speed + 1, place = cells + 1,
                               angular = place + Dim, failed = angular + 3, sums = failed + 1;
  static constexpr std::size_t strain = sums, highest = strain + 1, minus_lowest = highest + Dim,
                               all = minus_lowest + Dim;
};

/// One row of cells along the first axis. The loop without branches is the one that costs.
template <int Dim>
void sum_row(const BodyBlock<Dim>& b, std::size_t first, std::size_t count, const Vec<Dim>& start, double dx,
             double* out) {
  using C = Components<Dim>;
  using A = At<Dim>;
  const std::size_t n = b.volume.size();
  const double *q = b.contents.data() + first, *v = b.volume.data() + first;
  const double* const damage = q + C::damage * n;
  double mass = 0, kinetic = 0, energy = 0, volume = 0, speed = 0, moment = 0, cells = 0, failed = 0;
  std::array<double, Dim> momentum{};
#pragma omp simd reduction(+ : mass, kinetic, energy, volume, speed, moment, cells, failed)
  for (std::size_t k = 0; k < count; ++k) {
    const double m = q[k];
    double p2 = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double p = q[(C::u + d) * n + k];
      p2 += p * p;
    }
    mass += m;
    kinetic += m > 0 ? 0.5 * p2 / m : 0.0;
    energy += q[C::energy * n + k];
    volume += v[k];
    speed += std::sqrt(p2);
    moment += m * static_cast<double>(k);
    cells += v[k] != 0 ? 1.0 : 0.0;
    failed += damage[k] > 0 && damage[k] >= failed_damage * m ? m : 0.0;
  }
  Vec<3> sum, lever;  // of momentum, and of momentum times the distance from `start` in cells
  for (std::size_t d = 0; d < Dim; ++d) {
    double p = 0, kp = 0;
#pragma omp simd reduction(+ : p, kp)
    for (std::size_t k = 0; k < count; ++k) {
      const double m = q[(C::u + d) * n + k];
      p += m;
      kp += m * static_cast<double>(k);
    }
    momentum[d] = p;
    sum[static_cast<int>(d)] = p, lever[static_cast<int>(d)] = kp;
  }
  const Vec<3> about_start = cross(Vec<3>{{dx, 0, 0}}, lever);
  Vec<3> from;
  for (int d = 0; d < Dim; ++d) from[d] = start[d];
  const Vec<3> whole = cross(from, sum) + about_start;
  for (std::size_t d = 0; d < 3; ++d) out[A::angular + d] += whole[static_cast<int>(d)];
  out[A::mass] += mass, out[A::kinetic] += kinetic, out[A::energy] += energy, out[A::volume] += volume;
  out[A::speed] += speed, out[A::cells] += cells, out[A::failed] += failed;
  for (std::size_t d = 0; d < Dim; ++d) {
    out[A::momentum + d] += momentum[d];
    out[A::place + d] += mass * start[static_cast<int>(d)];
  }
  out[A::place] += moment * dx;
}

/// Largest strain, and the extent: a ball of radius |phi| about a place inside lies within the body, and
/// touches its surface, so the farthest such ball shows how far the body reaches.
template <int Dim>
void find_extremes(const Grid<Dim>& grid, double finest, const BodyBlock<Dim>& b, const Box<Dim>& cells,
                   double* out) {
  using C = Components<Dim>;
  using A = At<Dim>;
  const Box<Dim> layout = grid.layout();
  const std::size_t n = b.volume.size();
  for_each(cells, [&](const Index<Dim>& i) {
    const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
    if (b.volume[k] >= judged_fill * grid.full_volume(i) && b.contents[k] > 0)
      out[A::strain] = std::max(out[A::strain], b.contents[C::ep * n + k] / b.contents[k]);
    if (!(b.phi[k] < 0) || b.phi[k] < -2 * finest) return;  // deeper cells give the surface less accurately
    const Vec<Dim> x = grid.centre(i);
    for (std::size_t d = 0; d < Dim; ++d) {
      const double c = x[static_cast<int>(d)];
      out[A::highest + d] = std::max(out[A::highest + d], c - b.phi[k]);
      out[A::minus_lowest + d] = std::max(out[A::minus_lowest + d], -(c + b.phi[k]));
    }
  });
}

template <int Dim>
void sum_block(const State<Dim>& state, const Body<Dim>& body, int slot, double* out) {
  const Grid<Dim>& grid = state.grid(slot);
  const BodyBlock<Dim>& b = body.at(slot);
  const Box<Dim> cells = state.mesh.block(slot).cells, layout = grid.layout();
  Box<Dim> rows = cells;
  rows.hi[0] = rows.lo[0] + 1;
  for_each(rows, [&](const Index<Dim>& i) {
    sum_row(b, static_cast<std::size_t>(layout.at(i - cells.lo)), static_cast<std::size_t>(cells.extent(0)),
            grid.centre(i), grid.dx, out);
  });
  find_extremes(grid, state.grid().dx, b, cells, out);
}

template <int Dim>
void put(const Account<Dim>& account, std::span<double> row) {
  row[0] = account.mass;
  row[1] = account.energy;
  for (std::size_t d = 0; d < Dim; ++d) row[2 + d] = account.momentum[static_cast<int>(d)];
}

template <int Dim>
Account<Dim> take_account(std::span<const double> row) {
  Account<Dim> account{row[0], row[1], {}};
  for (std::size_t d = 0; d < Dim; ++d) account.momentum[static_cast<int>(d)] = row[2 + d];
  return account;
}

template <int Dim>
bool empty(const Account<Dim>& a) {
  return a.mass == 0 && a.energy == 0 && a.momentum == Vec<Dim>{};
}

template <int Dim>
BodyTotals<Dim> take_body(std::span<const double> row) {
  using A = At<Dim>;
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
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
    t.highest[d] = somewhere ? row[A::highest + e] : nowhere;
    t.lowest[d] = somewhere ? -row[A::minus_lowest + e] : nowhere;
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

/// A free rigid body holds what it has been given; one that moves as prescribed counts as nothing.
template <int Dim>
BodyTotals<Dim> rigid_totals(const RigidMotion<Dim>& m) {
  BodyTotals<Dim> t;
  for (int d = 0; d < Dim; ++d) t.lowest[d] = t.highest[d] = std::numeric_limits<double>::quiet_NaN();
  if (!m.mass) return t;
  t.mass = m.mass->mass;
  t.momentum = t.mass * m.velocity;
  t.kinetic = kinetic_energy(m);
  t.energy = m.mass->energy;
  t.speed = norm(t.momentum);
  t.place = t.mass * m.centre;
  t.angular_momentum = m.mass->start_moment;  // to which comes what it has received
  return t;
}

/// One row of sums for each body in each block of this rank, computed by all threads.
template <int Dim>
std::vector<double> sum_blocks(const State<Dim>& state, parallel::Team* team) {
  using A = At<Dim>;
  const auto bodies = static_cast<std::size_t>(state.count());
  const int local = state.mesh.local();
  std::vector<double> rows(static_cast<std::size_t>(local) * bodies * A::all, 0.0);
  const auto work = [&](int slot, int) {
    for (std::size_t m = 0; m < bodies; ++m) {
      const Body<Dim>& body = state.bodies[m];
      if (body.rigid || !body.present(slot)) continue;
      double* row = rows.data() + (static_cast<std::size_t>(slot) * bodies + m) * A::all;
      std::fill(row + A::sums, row + A::all, -std::numeric_limits<double>::infinity());
      sum_block(state, body, slot, row);
    }
  };
  if (team != nullptr && team->threads() > 1)
    team->run(local, work);
  else
    for (int slot = 0; slot < local; ++slot) work(slot, 0);
  return rows;
}

}  // namespace

template <int Dim>
Totals<Dim> find_totals(const State<Dim>& state, const parallel::World& world, parallel::Team* team) {
  using A = At<Dim>;
  const int bodies = state.count(), pairs = bodies * (bodies - 1) / 2;
  OrderedSums sums;  // items: all bodies, their edges, all pairs
  for (int m = 0; m < bodies; ++m) sums.item(A::sums, A::all - A::sums);
  for (int m = 0; m < bodies; ++m) sums.item(2 + Dim + 1);
  for (int p = 0; p < pairs; ++p) sums.item(2 + Dim + 3);
  const std::vector<double> rows = sum_blocks(state, team);
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    const long order = state.mesh.block(slot).order;
    const auto& ledger = state.ledger[slot];
    for (int m = 0; m < bodies; ++m) {
      const auto e = static_cast<std::size_t>(m);
      const Body<Dim>& body = state.bodies[e];
      if (!body.rigid && body.present(slot)) {
        const auto from = (static_cast<std::size_t>(slot) * static_cast<std::size_t>(bodies) + e) * A::all;
        std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(from), A::all, sums.add(m, order).begin());
      }
      const double released = e < ledger.released.size() ? ledger.released[e] : 0;
      if (e < ledger.edges.size() && (!empty(ledger.edges[e]) || released != 0)) {
        const std::span<double> row = sums.add(bodies + m, order);
        put(ledger.edges[e], row);
        row[2 + Dim] = released;
      }
    }
    for (std::size_t p = 0; p < ledger.pairs.size(); ++p)
      if (!empty(ledger.pairs[p].exchanged)) {
        const std::span<double> row = sums.add(2 * bodies + static_cast<int>(p), order);
        put(ledger.pairs[p].exchanged, row);
        std::copy_n(ledger.pairs[p].moment.c.begin(), 3, row.begin() + 2 + Dim);
      }
  }
  sums.reduce(world);
  Totals<Dim> t;
  if (world.rank() != 0) return t;
  t.time = state.time;
  for (int m = 0; m < bodies; ++m) {
    t.bodies.push_back(take_body<Dim>(sums.total(m)));
    end_at_edges(state.grid(), t.bodies.back());
    if (state.bodies[m].rigid) t.bodies.back() = rigid_totals(*state.bodies[m].rigid);
    t.edges.push_back(take_account<Dim>(sums.total(bodies + m)));
    t.released.push_back(sums.total(bodies + m)[2 + Dim]);
  }
  for (int p = 0; p < pairs; ++p) {
    const std::span<const double> row = sums.total(2 * bodies + p);
    t.pairs.push_back(take_account<Dim>(row));
    t.moments.push_back({{row[2 + Dim], row[3 + Dim], row[4 + Dim]}});
  }
  for (int m = 0; m < bodies; ++m)
    if (state.bodies[m].rigid && state.bodies[m].rigid->mass)
      t.bodies[m].angular_momentum += received_moment(t, m);
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
  template Totals<Dim> find_totals<Dim>(const State<Dim>&, const parallel::World&, parallel::Team*); \
  template Account<Dim> received<Dim>(const Totals<Dim>&, int);                                      \
  template Vec<3> received_moment<Dim>(const Totals<Dim>&, int);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
