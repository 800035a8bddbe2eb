#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "dynamics/plastic_return.hpp"
#include "material/hugoniot.hpp"
#include "run.hpp"

/// Porous matter in runs: pressed copper powder, 6.4 g/cm3.
namespace recoil::timestep_porous_test {
namespace {

using config::Geometry;

constexpr double mm = 1e-3, us = 1e-6;

Material powder() {
  Material m;
  m.name = "powder";
  m.eos = samples::porous(MieGruneisen{8930, 3940, 1.489, 2.02}, 6400, 0.14e9, 3.56e9, 8);
  m.thermal.specific_heat = 383;
  return m;
}

/// The state of one cell of the second body, by place.
struct Cell {
  double x, density, velocity, pressure, crushed, energy;
};

/// Two plates of the same powder meet at twice the speed `u`: each becomes a piston of that speed for the
/// other.
struct Plates : TestRun<1> {
  Plates(double u, double dx, StepStages stages, const Material& m = powder(), int threads = 1, int block = 0)
      : TestRun<1>(plates(u, dx, block), {m, m}, threads), material(m) {
    stepping.stages = stages;
  }
  static config::Case plates(double u, double dx, int block) {
    auto c = case_of(domain_of(Geometry::line, vector_of(-5 * mm), vector_of(6 * mm)), dx,
                     {body_of("flyer", box_shape(vector_of(-4 * mm), vector_of(0)), vector_of(2 * u)),
                      body_of("target", box_shape(vector_of(0), vector_of(4 * mm)))});
    if (block > 0) c.mesh.block = block;
    c.mesh.offset = 0.37;
    return c;
  }
  void until(double time) {
    while (state.time < time) advance(state, stepping, time, engine);
  }
  std::vector<Cell> target() const {
    std::vector<Cell> list;
    for (int s = 0; s < state.mesh.local(); ++s) {
      const auto& b = state.bodies[1].at(s);
      if (!b.present) continue;
      const Box<1> own = state.mesh.block(s).cells;
      for_each(own, [&](const Index<1>& i) {
        const auto k = static_cast<std::size_t>(state.grid().layout().at(i - own.lo));
        const std::size_t n = b.volume.size();
        const double mass = b.contents[k];
        if (!(b.volume[k] > 0.5 * state.grid().dx)) return;
        const double u = b.contents[C::u * n + k] / mass, rho = mass / b.volume[k];
        const double e = b.contents[C::energy * n + k] / mass - 0.5 * u * u,
                     lost = b.contents[C::crushed * n + k] / mass;
        list.push_back({state.grid().centre(i)[0], rho, u, pressure(material.eos, rho, e, lost), lost, e});
      });
    }
    std::sort(list.begin(), list.end(), [](const Cell& a, const Cell& b) { return a.x < b.x; });
    return list;
  }
  /// Where the velocity of the target falls through `u` [m], linear between cells.
  double front(double u) const {
    const std::vector<Cell> cells = target();
    for (std::size_t k = cells.size() - 1; k > 0; --k)
      if (cells[k - 1].velocity > u)
        return cells[k - 1].x + (cells[k].x - cells[k - 1].x) * (cells[k - 1].velocity - u) /
                                    (cells[k - 1].velocity - cells[k].velocity);
    return 0;
  }

  Material material;
};

/// Means over the middle of what the shock has passed.
Cell plateau(const std::vector<Cell>& cells, double from, double to) {
  Cell mean{};
  double n = 0;
  for (const Cell& c : cells) {
    if (c.x < from || c.x > to) continue;
    mean.density += c.density, mean.velocity += c.velocity, mean.pressure += c.pressure;
    mean.crushed += c.crushed, mean.energy += c.energy, n += 1;
  }
  return {0, mean.density / n, mean.velocity / n, mean.pressure / n, mean.crushed / n, mean.energy / n};
}

class PorousPlates : public testing::TestWithParam<StepStages> {};
INSTANTIATE_TEST_SUITE_P(Stages, PorousPlates, testing::Values(StepStages::three, StepStages::one),
                         [](const auto& info) { return info.param == StepStages::one ? "One" : "Three"; });

/// Behind the shock stands the state of the jump conditions with the crush curve: pores half crushed, all
/// crushed, and crushed by a shock that has overtaken the precursor. The shock runs at their speed.
TEST_P(PorousPlates, ReachTheHugoniotOfTheModel) {
  for (const double u : {100.0, 250.0, 600.0, 1500.0}) {
    Plates run(u, 0.02 * mm, GetParam());
    const ShockState s = shock_at_velocity(run.material, u);
    const double end = 7 * mm / (3948 + s.shock_speed);  // before waves come back from the rear
    run.until(0.5 * end);
    const double middle = 0.5 * (u + s.precursor_velocity), half = run.front(middle);
    run.until(end);
    const double speed = (run.front(middle) - half) / (0.5 * end);
    const double at_wall = u * end, front = s.shock_speed * end;
    const Cell p =
        plateau(run.target(), at_wall + 0.3 * (front - at_wall), at_wall + 0.8 * (front - at_wall));
    EXPECT_NEAR(p.pressure, s.pressure, 0.01 * s.pressure) << u;
    EXPECT_NEAR(p.density, s.density, 0.005 * s.density) << u;
    EXPECT_NEAR(p.velocity, u, 0.005 * u) << u;
    EXPECT_NEAR(p.energy, s.energy, 0.02 * s.energy) << u;
    EXPECT_NEAR(p.crushed, crushed_by(run.material.eos, s.density, s.energy), 0.003) << u;
    EXPECT_NEAR(speed, s.shock_speed, 0.01 * s.shock_speed) << u;
    for (int m = 0; m < 2; ++m) EXPECT_LT(run.imbalance(m, 2 * u), 1e-11);
    const Counters counted = run.counted();
    EXPECT_LE(counted.averaged_states, u > 1000 ? 1 : 0) << u;  // a sliver between plates at 3 km/s
    // In cut cells at the interface, which empty while their pores are crushed; one of 1000 states.
    EXPECT_LT(counted.clamped_distensions + counted.cleared_strains, 400 * 3 * run.state.step / 1000) << u;
  }
}

/// Ahead of a weak shock the elastic precursor, at p_e and the speed of sound, with all pores still there.
TEST_P(PorousPlates, SendAnElasticPrecursor) {
  Plates run(100, 0.02 * mm, GetParam());
  const ShockState s = shock_at_velocity(run.material, 100);
  run.until(0.8 * us);  // it has come to 3.15 mm
  const Cell between = plateau(run.target(), 1 * mm, 2.7 * mm);
  EXPECT_NEAR(between.pressure, 0.14e9, 0.02 * 0.14e9);
  EXPECT_NEAR(between.velocity, s.precursor_velocity, 0.02 * s.precursor_velocity);
  EXPECT_LT(between.crushed, 0.004);
  EXPECT_NEAR(run.front(0.5 * s.precursor_velocity), 0.8 * us * s.precursor_speed, 0.05 * mm);
}

/// The release from the rear does not open pores again: the matter flies off compacted and hot.
TEST_P(PorousPlates, StayCompactedAfterTheRelease) {
  Plates run(600, 0.04 * mm, GetParam());
  run.until(3.5 * us);
  const Porous& eos = std::get<Porous>(run.material.eos);
  for (const Cell& c : run.target()) {
    EXPECT_GE(c.crushed, 0);
    EXPECT_LE(c.crushed, eos.alpha0 - 1 + 1e-12);
  }
  const Cell p = plateau(run.target(), 2 * mm, 3.5 * mm);
  EXPECT_NEAR(p.crushed, eos.alpha0 - 1, 0.01);
  EXPECT_LT(run.imbalance(1, 1200), 1e-11);
}

TEST_P(PorousPlates, GiveTheSameBitsForAnyThreadsAndBlocks) {
  std::vector<double> first;
  for (const auto& [block, threads] : {std::pair{16, 1}, {16, 2}, {32, 1}}) {
    Plates run(250, 0.04 * mm, GetParam(), powder(), threads, block);
    run.steps(60);
    const auto cells = run.cells(1);
    if (first.empty()) first = cells;
    EXPECT_EQ(first, cells) << block << " " << threads;
  }
}

/// With strength, over a solid whose pressure does not know the energy, and by a table.
TEST_P(PorousPlates, KeepTheirBudgetsWithAnySolid) {
  Material strong = powder();
  strong.strength = PerfectlyPlastic{20e9, 0.1e9};
  Material cold = powder();
  cold.eos = samples::porous(LinearEos{8930, 138e9}, 6400, 0.14e9, 3.56e9, 8);
  Material table = powder();
  table.eos = samples::porous(samples::of(Tabular{}).front(), 6400, 0.14e9, 3.56e9, 8);
  for (const Material& m : {strong, cold, table}) {
    Plates run(300, 0.04 * mm, GetParam(), m);
    run.steps(80);
    EXPECT_LT(run.imbalance(0, 600), 1e-11);
    EXPECT_LT(run.imbalance(1, 600), 1e-11);
    EXPECT_EQ(run.counted().averaged_states, 0);
    const Cell p = plateau(run.target(), 0.3 * mm, 0.45 * mm);
    EXPECT_GT(p.crushed, 0.3);
    EXPECT_NEAR(p.velocity, 300, 6);
  }
}

/// A ball of powder on a plate of it in two dimensions: slanted surfaces, fits and redistribution.
TEST(Porous, BallOnPlateKeepsItsBounds) {
  auto c =
      case_of(domain_of(Geometry::axisymmetric, vector_of(0, -3 * mm), vector_of(4 * mm, 4 * mm)), 0.1 * mm,
              {body_of("ball", ball_shape(vector_of(0, -1 * mm), 1 * mm), vector_of(0, 800)),
               body_of("plate", box_shape(vector_of(-1, 0), vector_of(3 * mm, 2 * mm)))});
  TestRun<2> run(c, {powder(), powder()});
  using C = Components<2>;
  run.steps(150);
  const double most = std::get<Porous>(powder().eos).alpha0 - 1;
  double deepest = 0;
  for (int m = 0; m < 2; ++m) {
    EXPECT_LT(run.imbalance(m, 800), 1e-11);
    for (const auto& b : run.state.bodies[m].blocks)
      for (std::size_t k = 0; k < b.volume.size(); ++k) {
        if (!(b.contents[k] > 0)) continue;
        const double lost = b.contents[C::crushed * b.volume.size() + k] / b.contents[k];
        EXPECT_GE(lost, -1e-12);
        EXPECT_LE(lost, most + 1e-6);
        deepest = std::max(deepest, lost);
      }
  }
  EXPECT_NEAR(deepest, most, 1e-3);
  EXPECT_EQ(run.counted().averaged_states, 0);
}

}  // namespace
}  // namespace recoil::timestep_porous_test
