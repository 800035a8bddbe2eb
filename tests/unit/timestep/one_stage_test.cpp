#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "run.hpp"

namespace recoil::one_stage_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3;

/// A run whose steps have one stage.
template <int Dim>
struct OneStageRun : TestRun<Dim> {
  OneStageRun(const config::Case& c, const std::vector<Material>& materials, int threads = 1)
      : TestRun<Dim>(c, materials, threads) {
    this->stepping.stages = StepStages::one;
  }
};

/// A longitudinal elastic sound wave of one period that runs along the diagonal of a periodic domain of 10 mm
/// filled with matter: the mean error of the velocity, in amplitudes, after it has gone once around.
/// @param flow of the matter along the diagonal, in speeds of sound. @param sign -1: the wave runs against
/// it.
template <int Dim>
double error_of_a_wave(int cells, double flow = 0, double sign = 1) {
  using C = Components<Dim>;
  const double side = 10 * mm, amplitude = 1e-3, k = 2 * std::numbers::pi / side;
  Material m = samples::copper();
  m.eos = LinearEos{8930, 130e9};
  m.strength = Elastic{43e9};
  const double rho = density(m), g = shear_modulus(m), c = longitudinal_speed(m);
  config::Vector lo{}, hi{};
  for (std::size_t d = 0; d < Dim; ++d) hi[d] = side;
  const Geometry geometry = Dim == 1 ? Geometry::line : Dim == 2 ? Geometry::planar : Geometry::space;
  auto domain = domain_of(geometry, lo, hi, Boundary::periodic);
  for (auto& x : lo) x = -1;
  for (auto& x : hi) x = 1;
  OneStageRun<Dim> run(case_of(domain, side / cells, {body_of("all", box_shape(lo, hi))}), {m});
  const double n = 1 / std::sqrt(Dim);  // of the direction, along each axis
  const auto phase = [&](const Vec<Dim>& x) {
    double sum = 0;
    for (int d = 0; d < Dim; ++d) sum += k * x[d];
    return sum;
  };
  const double mean_of_cell = std::pow(std::sin(0.5 * k * side / cells) / (0.5 * k * side / cells), Dim);
  const auto each = [&](auto&& f) {
    for (int s = 0; s < run.state.mesh.local(); ++s) {
      const Box<Dim> own = run.state.mesh.block(s).cells;
      for_each(own, [&](const Index<Dim>& i) {
        f(run.state.bodies[0].at(s), run.state.grid().layout().at(i - own.lo),
          mean_of_cell * std::sin(phase(run.state.grid().centre(i))));
      });
    }
  };
  each([&](auto& b, int cell, double wave) {
    const std::size_t count = b.volume.size();
    const double own = amplitude * wave, strain = -sign * own / c, u = flow * c + own, v = b.volume[cell],
                 density_now = rho * (1 - strain);
    const auto put = [&](int at, double value) { b.contents[at * count + cell] = v * value; };
    put(C::rho, density_now);
    for (int d = 0; d < Dim; ++d) put(C::u + d, density_now * u * n);
    put(C::energy, 0.5 * density_now * u * u);
    for (int i = 0; i < Dim; ++i)
      for (int j = i; j < Dim; ++j)
        if (C::stress(i, j) >= 0)
          put(C::s + C::stress(i, j), density_now * 2 * g * strain * (n * n - (i == j ? 1.0 / 3 : 0)));
  });
  const double period =
      side * n / (c * std::abs(flow + sign));  // the diagonal wave repeats after side/sqrt(Dim)
  while (run.state.time < period) advance(run.state, run.stepping, period, run.engine);
  double error = 0, number = 0;
  each([&](auto& b, int cell, double wave) {
    const std::size_t count = b.volume.size();
    for (int d = 0; d < Dim; ++d)
      error += std::abs(
          (b.contents[(C::u + d) * count + cell] / b.contents[cell] / n - flow * c) / amplitude - wave);
    number += Dim;
  });
  return error / number;
}

TEST(OneStage, AWaveConvergesAtSecondOrder) {
  const double coarse = error_of_a_wave<1>(20), fine = error_of_a_wave<1>(40);
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << ' ' << fine;
}

/// Its steps are 1.43 times as long as by the rule of docs/decisions/0036, with which the limit was 4e-3.
TEST(OneStage, AWaveAcrossTheMeshConvergesAtSecondOrder) {
  const double coarse = error_of_a_wave<2>(20), fine = error_of_a_wave<2>(40);
  EXPECT_LT(fine, 8e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << ' ' << fine;
}

TEST(OneStage, AWaveAcrossSpaceConvergesAtSecondOrder) {
  const double coarse = error_of_a_wave<3>(10), fine = error_of_a_wave<3>(20);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << ' ' << fine;
}

/// A wave that runs against matter faster than sound leaves its cells on the other side.
TEST(OneStage, AWaveThatIsSweptAlongConvergesAtSecondOrder) {
  for (const double way : {1.0, -1.0}) {
    const double coarse = error_of_a_wave<1>(20, 2 * way, -way), fine = error_of_a_wave<1>(40, 2 * way, -way);
    EXPECT_LT(fine, 2e-2);
    EXPECT_GT(std::log2(coarse / fine), 1.8) << way << ' ' << coarse << ' ' << fine;
  }
}

/// Part of its kinetic energy that a shear flow of matter with a shear modulus but no yield stress, one
/// period of a sine across 20 cells, keeps over 100 steps.
double kept_of_a_shear_flow() {
  using C = Components<2>;
  const double side = 10 * mm, dx = 0.5 * mm, speed = 200;
  Material m = samples::copper();
  m.eos = LinearEos{8930, 130e9};
  m.strength = JohnsonCook{43e9, 0, 0, 1.0, 0, 1.09, 1358};
  const auto domain = domain_of(Geometry::planar, {0, 0}, {side, 4 * dx}, Boundary::periodic);
  OneStageRun<2> run(case_of(domain, dx, {body_of("all", box_shape({-1, -1}, {1, 1}))}), {m});
  const auto add_kinetic = [&](auto& b, std::size_t cell, double& sum) {
    const std::size_t n = b.volume.size();
    for (std::size_t d = 0; d < 2; ++d)
      sum += 0.5 * b.contents[(C::u + d) * n + cell] * b.contents[(C::u + d) * n + cell] / b.contents[cell];
  };
  const auto each = [&](auto&& f) {
    for (int s = 0; s < run.state.mesh.local(); ++s) {
      const Box<2> own = run.state.mesh.block(s).cells;
      for_each(own, [&](const Index<2>& i) {
        f(run.state.bodies[0].at(s), static_cast<std::size_t>(run.state.grid().layout().at(i - own.lo)), i);
      });
    }
  };
  double before = 0, after = 0;
  each([&](auto& b, std::size_t cell, const Index<2>& i) {
    const std::size_t n = b.volume.size();
    const double u = speed * std::sin(2 * std::numbers::pi * run.state.grid().centre(i)[0] / side);
    b.contents[(C::u + 1) * n + cell] = b.contents[cell] * u;
    b.contents[C::energy * n + cell] += 0.5 * b.contents[cell] * u * u;
    add_kinetic(b, cell, before);
  });
  run.steps(100);
  each([&](auto& b, std::size_t cell, const Index<2>&) { add_kinetic(b, cell, after); });
  return after / before;
}

/// A melt stays without stress over half a step. The shear modulus times the strain of half a step, 0.2 GPa
/// here, would be a viscosity, and take 38 % of the energy; three stages keep 0.9991.
TEST(OneStage, AShearFlowOfAMeltGoesOn) { EXPECT_GT(kept_of_a_shear_flow(), 0.998); }

/// Cold gas runs against a wall, at Mach 100: what half a step changes across the faces along the shock
/// leaves states that gas can have.
TEST(OneStage, AStrongShockAlongTheFacesOfAGas) {
  Material gas;
  gas.eos = IdealGas{.rho0 = 100, .gamma = 5.0 / 3, .p0 = 6e3};
  gas.strength = NoStrength{};
  auto domain = domain_of(Geometry::planar, vector_of(0, 0), vector_of(4 * mm, 0.4 * mm), Boundary::symmetry);
  domain.boundary[0] = {Boundary::symmetry, Boundary::outflow};
  auto c = case_of(domain, 0.05 * mm,
                   {body_of("gas", box_shape(vector_of(-1, -1), vector_of(1, 1)), vector_of(-1000, 0))});
  OneStageRun<2> run(c, {gas});
  run.steps(60);
  EXPECT_EQ(run.counted().first_order_faces, 0);
  EXPECT_LT(run.imbalance(0, 1000), 1e-12);
}

/// Plates along one axis between planes of symmetry.
template <int Dim>
config::Case plates(int axis) {
  const double dx = 0.2 * mm;
  const auto e = static_cast<std::size_t>(axis);
  config::Vector lo{}, hi{}, u{};
  for (std::size_t d = 0; d < Dim; ++d) hi[d] = 3 * dx;
  lo[e] = -3 * mm, hi[e] = 4 * mm, u[e] = 450;
  auto domain = domain_of(Dim == 2 ? Geometry::planar : Geometry::space, lo, hi, Boundary::symmetry);
  domain.boundary[e] = {Boundary::outflow, Boundary::outflow};
  auto low = lo, high = hi;
  low[e] = -2 * mm, high[e] = 0;
  auto c = case_of(domain, dx, {body_of("flyer", box_shape(low, high), u)});
  low[e] = 0, high[e] = 3 * mm;
  c.bodies.push_back(body_of("target", box_shape(low, high)));
  c.mesh.offset = 0.37;
  c.mesh.block = 16;
  return c;
}

/// Normal velocity, normal stress deviator and plastic strain of all cells along the axis.
template <int Dim>
std::vector<double> along(int axis, int steps) {
  using C = Components<Dim>;
  OneStageRun<Dim> run(plates<Dim>(axis), {samples::aluminium(), samples::copper()});
  run.stepping.fixed_dt = 10e-9;
  run.steps(steps);
  EXPECT_GT(run.contact_area(0), 0);
  EXPECT_LT(run.imbalance(0, 450), 1e-12);
  EXPECT_LT(run.imbalance(1, 450), 1e-12);
  std::vector<double> out;
  const auto q = run.cells(1);
  const Box<Dim> domain = run.state.grid().domain();
  for_each(domain, [&](const Index<Dim>& i) {
    for (int d = 0; d < Dim; ++d)
      if (d != axis && i[d] != 0) return;
    const double* c = q.data() + static_cast<std::size_t>(domain.at(i)) * (C::contents + 1) + 1;
    const double mass = c[0] > 0 ? c[0] : 1;
    const int s = C::stress(axis, axis);
    out.push_back(c[C::u + axis] / mass / 450);
    out.push_back((s >= 0 ? c[C::s + s] : -c[C::s] - c[C::s + 1]) / mass / 1e9);
    out.push_back(c[C::ep] / mass);
  });
  return out;
}

TEST(OneStage, PlatesAlongEveryAxisAreTheSame) {
  const auto x = along<2>(0, 30), y = along<2>(1, 30);
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t k = 0; k < x.size(); ++k) ASSERT_NEAR(x[k], y[k], 1e-9) << k;
  const auto a = along<3>(0, 6), b = along<3>(1, 6), c = along<3>(2, 6);
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_NEAR(a[k], b[k], 1e-9) << k;
    ASSERT_NEAR(a[k], c[k], 1e-9) << k;
  }
}

TEST(OneStage, ABodyThatNothingTouchesFeelsNothing) {
  auto c =
      case_of(domain_of(Geometry::planar, vector_of(-3 * mm, -3 * mm), vector_of(3 * mm, 3 * mm)), 0.2 * mm,
              {body_of("disc", ball_shape(vector_of(0.03 * mm, 0.01 * mm), 1 * mm), vector_of(300, 170))});
  OneStageRun<2> run(c, {samples::copper()});
  run.steps(10);
  EXPECT_LT(run.imbalance(0, 350), 1e-13);
  const auto now = run.totals(0);
  for (std::size_t k = Components<2>::s; k < now.size(); ++k) EXPECT_NEAR(now[k], 0, 1e-3 * now[0]) << k;
}

TEST(OneStage, ThreadsAndBlocksGiveTheSameBits) {
  std::vector<std::vector<double>> found;
  for (const auto& [block, threads] :
       {std::pair{14, 1}, std::pair{14, 2}, std::pair{10, 1}, std::pair{41, 1}}) {
    auto c = case_of(domain_of(Geometry::planar, vector_of(-3 * mm, -3 * mm), vector_of(3 * mm, 3 * mm)),
                     0.15 * mm,
                     {body_of("disc", ball_shape(vector_of(-1.005 * mm, 0), 1 * mm), vector_of(600, 200)),
                      body_of("plate", box_shape(vector_of(0, -2.5 * mm), vector_of(1 * mm, 2.5 * mm)))});
    c.mesh.block = block;
    c.mesh.offset = 0.21;
    OneStageRun<2> run(c, {samples::aluminium(), samples::copper()}, threads);
    run.steps(8);
    EXPECT_GT(run.contact_area(0), 0);
    EXPECT_LT(run.imbalance(0, 600), 1e-12);
    EXPECT_LT(run.imbalance(1, 600), 1e-12);
    found.push_back(run.cells(0));
    const auto more = run.cells(1);
    found.back().insert(found.back().end(), more.begin(), more.end());
  }
  for (std::size_t k = 1; k < found.size(); ++k) EXPECT_TRUE(found[k] == found[0]) << k;
}

}  // namespace
}  // namespace recoil::one_stage_test
