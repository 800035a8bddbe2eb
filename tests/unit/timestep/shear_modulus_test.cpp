#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <variant>

#include "run.hpp"

namespace recoil::shear_modulus_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3, dx = 0.1 * mm, pressed = 20e9;
constexpr int cells = 48;
constexpr double length = cells * dx;

/// Aluminium by Steinberg, whose shear modulus follows the state to a part.
Material aluminium(double follows) {
  Material m = samples::aluminium();
  m.thermal.rule = Thermal::Rule::energy;
  SteinbergGuinan s{27.6e9, 0.29e9, 0.68e9, 125, 0.1, 65.2e-12, 6.16e-4, 1220, 1.5, 1.97};
  s.modulus_follows = follows;
  m.strength = s;
  return m;
}

/// A closed domain full of it, under pressure from the start, periodic along y.
template <int Dim>
TestRun<Dim> full_of(const Material& m) {
  const Geometry geometry = Dim == 1 ? Geometry::line : Geometry::planar;
  auto domain = domain_of(geometry, {0, 0, 0}, {length, Dim > 1 ? 1.6 * mm : 0, 0}, Boundary::symmetry);
  if (Dim > 1) domain.boundary[1] = {Boundary::periodic, Boundary::periodic};
  auto c =
      case_of(domain, dx, {body_of("b", box_shape({-1 * mm, -5 * mm, 0}, {length + 1 * mm, 5 * mm, 0}))});
  c.bodies[0].pressure = pressed;
  return TestRun<Dim>(c, {m});
}

/// f(place in the arrays of the one body's block, x) for all cells of the domain.
template <int Dim, class F>
void for_each_cell(TestRun<Dim>& run, F&& f) {
  for (int s = 0; s < run.state.mesh.local(); ++s) {
    auto& b = run.state.bodies[0].at(s);
    const Box<Dim> own = run.state.mesh.block(s).cells;
    for_each(own, [&](const Index<Dim>& i) {
      const auto k = static_cast<std::size_t>(run.state.grid().layout().at(i - own.lo));
      if (b.volume[k] > 0) f(b, k, run.state.grid().centre(i)[0]);
    });
  }
}

/// Speed of a standing wave of half a length, by the time at which its velocity has gone: a quarter of a
/// period.
template <int Dim>
double measured_speed(TestRun<Dim>& run, int axis, const std::function<double(double)>& shape) {
  using C = Components<Dim>;
  const auto u = static_cast<std::size_t>(C::u + axis);
  for_each_cell(run, [&](BodyBlock<Dim>& b, std::size_t k, double x) {
    const std::size_t n = b.volume.size();
    const double velocity = shape(x), mass = b.contents[k];
    b.contents[u * n + k] = mass * velocity;
    b.contents[C::energy * n + k] += 0.5 * mass * velocity * velocity;
  });
  run.start[0] = run.totals(0);
  const auto amplitude = [&] {
    double sum = 0;
    for_each_cell(run, [&](const BodyBlock<Dim>& b, std::size_t k, double x) {
      sum += b.contents[u * b.volume.size() + k] * shape(x);
    });
    return sum;
  };
  double before = amplitude(), then = 0;
  EXPECT_GT(before, 0);
  for (int step = 0; step < 2000; ++step) {
    run.steps(1);
    const double now = amplitude();
    if (now <= 0) {
      const double at = then + (run.state.time - then) * before / (before - now);
      return length / (2 * at);
    }
    before = now;
    then = run.state.time;
  }
  ADD_FAILURE() << "no wave";
  return 0;
}

struct Exact {
  double density, bulk, shear;  // kg/m3, Pa
};
template <int Dim>
Exact exact(const TestRun<Dim>& run, double follows) {
  const auto q = run.totals(0);
  double volume = 0;
  for (const auto& b : run.state.bodies[0].blocks)
    for (const double v : b.volume) volume += v;
  const double rho = q[0] / volume;
  const Material m = aluminium(follows);
  const double c2 = std::visit([&](const auto& eos) { return eos.sound_speed_squared(rho, pressed); }, m.eos);
  const auto& s = std::get<SteinbergGuinan>(m.strength);
  const double growth =
      s.a * pressed / std::cbrt(rho / density(m)) - s.b * (m.thermal.initial_temperature - 300);
  return {rho, rho * c2, s.shear_modulus * (1 + follows * growth)};
}

/// Elastic waves in matter under 20 GPa run with c_L = sqrt((K + 4/3 G(p))/rho).
TEST(ShearModulus, LongitudinalWavesFollowThePressure) {
  for (const double follows : {0.0, 0.5, 1.0}) {
    TestRun<1> run = full_of<1>(aluminium(follows));
    const Exact state = exact(run, follows);
    const double speed =
        measured_speed<1>(run, 0, [](double x) { return std::sin(std::numbers::pi * x / length); });
    EXPECT_NEAR(speed / std::sqrt((state.bulk + 4.0 / 3 * state.shear) / state.density), 1, 1e-3) << follows;
    EXPECT_LT(run.imbalance(0, 1e3), 1e-12);
  }
}

/// And shear waves with sqrt(G(p)/rho).
TEST(ShearModulus, ShearWavesFollowThePressure) {
  for (const double follows : {0.0, 1.0}) {
    TestRun<2> run = full_of<2>(aluminium(follows));
    const Exact state = exact(run, follows);
    const double speed =
        measured_speed<2>(run, 1, [](double x) { return std::cos(std::numbers::pi * x / length); });
    EXPECT_NEAR(speed / std::sqrt(state.shear / state.density), 1, 1e-3) << follows;
    EXPECT_LT(run.imbalance(0, 1e3), 1e-12);
  }
}

TEST(ShearModulus, BlocksAndThreadsDoNotMatter) {
  const auto run_on = [](int block, int threads) {
    auto domain = domain_of(Geometry::planar, {-2 * mm, -2 * mm, 0}, {3 * mm, 2 * mm, 0}, Boundary::outflow);
    auto c = case_of(domain, dx, {body_of("flyer", ball_shape({-1 * mm, 0, 0}, 0.9 * mm), {3000, 0, 0})});
    c.bodies.push_back(body_of("target", box_shape({0, -1.5 * mm, 0}, {2 * mm, 1.5 * mm, 0})));
    c.mesh.block = block;
    TestRun<2> run(c, {aluminium(1), aluminium(1)}, threads);
    run.steps(60);
    return run.cells(1);
  };
  EXPECT_EQ(run_on(16, 1), run_on(28, 2));
}

}  // namespace
}  // namespace recoil::shear_modulus_test
