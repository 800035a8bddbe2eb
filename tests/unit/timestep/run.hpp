#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "../material/samples.hpp"
#include "../parallel/session.hpp"
#include "../problem/cases.hpp"
#include "problem/start.hpp"
#include "timestep/step.hpp"

namespace recoil {

inline config::Case case_of(const config::Domain& domain, double dx, std::vector<config::Body> bodies) {
  config::Case c;
  c.domain = domain;
  c.mesh.finest = dx;
  c.bodies = std::move(bodies);
  return c;
}

/// A run of a case put together in code.
template <int Dim>
struct TestRun {
  using C = Components<Dim>;
  parallel::World world;
  parallel::Team team;
  Engine engine;
  State<Dim> state;
  Stepping stepping;
  std::vector<std::vector<double>> start;

  TestRun(const config::Case& c, const std::vector<Material>& materials, int threads = 1)
      : world(started()),
        team(threads),
        engine{world, team, {}},
        state(make_state<Dim>(c, materials, world)) {
    engine.least_work = 0;  // threads share small cases as well
    prepare_start(state, engine);
    for (int m = 0; m < state.count(); ++m) start.push_back(totals(m));
  }
  void steps(int n) {
    for (int k = 0; k < n; ++k) advance(state, stepping, 1, engine);
  }

  /// Sums of the contents of a body, block by block.
  std::vector<double> totals(int m) const {
    std::vector<double> sum(C::contents);
    for (int s = 0; s < state.mesh.local(); ++s) {
      const auto& b = state.bodies[m].at(s);
      for (std::size_t k = 0; k < b.volume.size(); ++k)
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += b.contents[c * b.volume.size() + k];
    }
    return sum;
  }
  /// What a body has received from the others and through the edges since the start.
  Account<Dim> received(int m) const {
    Account<Dim> a;
    for (const auto& l : state.ledger) {
      const Account<Dim> edge = l.edges[m].value();
      a.mass -= edge.mass;
      a.energy -= edge.energy;
      a.momentum -= edge.momentum;
      for (int q = 0; q < state.count(); ++q) {
        if (q == m) continue;
        const auto n = static_cast<std::size_t>(pair_number(std::min(m, q), std::max(m, q), state.count()));
        const double sign = m < q ? 1 : -1;
        const Account<Dim> exchanged = l.pairs[n].exchanged.value();
        a.energy += sign * exchanged.energy;
        a.momentum += sign * exchanged.momentum;
      }
    }
    return a;
  }
  /// Largest mistake in the balances of mass, momentum and energy of a body, over its mass times `speed` and
  /// so on.
  double imbalance(int m, double speed) const {
    const auto now = totals(m), &then = start[m];
    const auto in = received(m);
    double worst = std::abs(now[0] - in.mass - then[0]) / then[0];
    // Of a wedge about an axis the radial momentum is none that is conserved.
    for (int d = state.grid().has_radius() ? 1 : 0; d < Dim; ++d) {
      const auto c = static_cast<std::size_t>(C::u + d);
      worst = std::max(worst, std::abs(now[c] - in.momentum[d] - then[c]) / (then[0] * speed));
    }
    return std::max(worst,
                    std::abs(now[C::energy] - in.energy - then[C::energy]) / (then[0] * speed * speed));
  }
  Counters counted() const {
    Counters sum;
    for (const auto& l : state.ledger) sum += l.counters;
    return sum;
  }
  double contact_area(std::size_t pair) const {
    double sum = 0;
    for (const auto& l : state.ledger) sum += l.pairs[pair].area.value();
    return sum;
  }

  /// V and Q of all cells of the domain, in one order whatever the blocks.
  std::vector<double> cells(int m) const {
    const Box<Dim> domain = state.grid().domain(), layout = state.grid().layout();
    constexpr std::size_t width = C::contents + 1;
    std::vector<double> out(static_cast<std::size_t>(domain.size()) * width);
    for (int s = 0; s < state.mesh.local(); ++s) {
      const auto& b = state.bodies[m].at(s);
      if (!b.present) continue;
      const Box<Dim> cells = state.mesh.block(s).cells;
      for_each(cells, [&](const Index<Dim>& i) {
        const auto k = static_cast<std::size_t>(layout.at(i - cells.lo));
        double* to = out.data() + static_cast<std::size_t>(domain.at(i)) * width;
        *to++ = b.volume[k];
        for (std::size_t c = 0; c < C::contents; ++c) *to++ = b.contents[c * b.volume.size() + k];
      });
    }
    return out;
  }

 private:
  static parallel::World started() {
    start_parallel();
    return {};
  }
};

}  // namespace recoil
