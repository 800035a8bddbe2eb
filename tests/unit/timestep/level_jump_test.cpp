#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "run.hpp"
#include "timestep/phases.hpp"
#include "timestep/regrid.hpp"

/// Waves where cells become twice as wide, or half as wide.
namespace recoil::level_jump_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3;
constexpr double width = 4 * mm;    // of the pulse
constexpr double length = 40 * mm;  // of the rod
constexpr double speed = 0.01;      // m/s: so slow that the wave is linear to 1e-6

/// Velocity of a pulse with three smooth derivatives, in parts of its peak; its mean over a cell by three
/// points of Gauss.
double pulse(double x) {
  const double r = x / width;
  return std::abs(r) < 0.5 ? std::pow(std::cos(M_PI * r), 4) : 0;
}
double mean_pulse(double x, double dx) {
  const double o = 0.5 * std::sqrt(0.6) * dx;
  return (5 * pulse(x - o) + 8 * pulse(x) + 5 * pulse(x + o)) / 18;
}

/// f(block, cell in it, middle of the cell, its width) for all cells of the rod.
template <class F>
void for_each_cell(State<1>& state, F&& f) {
  for (int s = 0; s < state.mesh.local(); ++s) {
    if (!state.bodies[0].present(s)) continue;
    const Box<1> own = state.mesh.block(s).cells;
    for_each(own, [&](const Index<1>& i) {
      f(state.bodies[0].at(s), static_cast<std::size_t>(i[0] - own.lo[0]), state.grid(s).centre(i)[0],
        state.grid(s).dx);
    });
  }
}

/// An elastic wave that runs to higher x without a change of its shape.
void start_pulse(State<1>& state, double middle) {
  using C = Components<1>;
  const Material m = samples::aluminium();
  const double sound = longitudinal_speed(m), g = shear_modulus(m), rho0 = density(m);
  const double bulk = rho0 * bulk_sound_speed(m) * bulk_sound_speed(m);
  for_each_cell(state, [&](BodyBlock<1>& b, std::size_t k, double x, double dx) {
    const double u = speed * mean_pulse(x - middle, dx);
    const double strain = -u / sound, rho = rho0 / (1 + strain), s = 4.0 / 3 * g * strain, v = b.volume[k];
    const double e = 0.5 * bulk * strain * strain / rho0 + 0.75 * s * s / (2 * g) / rho0;
    const std::size_t n = b.volume.size();
    b.contents[k] = v * rho, b.contents[C::u * n + k] = v * rho * u;
    b.contents[C::energy * n + k] = v * rho * (e + 0.5 * u * u);
    b.contents[C::s * n + k] = v * rho * s;
  });
}

struct Passage {
  double error = 0;  // mean over the pulse of what is wrong at the end, in parts of its peak
  double back = 0;   // largest velocity behind it, likewise
  double imbalance = 0;
};

/// The pulse runs 14 mm, through the middle of the rod.
/// @param cells finest ones in the pulse. @param fine_first which half of the rod has them, of two levels.
Passage pass(int levels, double cells, bool fine_first) {
  const double dx = width / cells, from = 13 * mm, way = 14 * mm;
  auto c = case_of(domain_of(Geometry::line, {-2 * mm}, {length + 2 * mm}, Boundary::outflow), dx,
                   {body_of("rod", box_shape({0}, {length}))});
  c.mesh.levels = levels;
  TestRun<1> run(c, {samples::aluminium()});
  Refinement<1> rules;
  rules.bend = 1e9;
  rules.regions.push_back({{{fine_first ? 0 : 0.5 * length}}, {{fine_first ? 0.5 * length : length}}});
  while (regrid(run.state, run.engine, rules)) {
  }
  start_pulse(run.state, from);
  run.start = {run.totals(0)};
  StepRun<1> step(run.state, run.engine);
  step.has_changed(FieldSet::all());
  update_bands(step);
  const double end = way / longitudinal_speed(samples::aluminium());
  while (run.state.time < end) advance(run.state, run.stepping, end, run.engine);
  Passage p;
  for_each_cell(run.state, [&](BodyBlock<1>& b, std::size_t k, double x, double h) {
    if (x < 2 * mm || x > length - 2 * mm) return;
    const double u = b.contents[Components<1>::u * b.volume.size() + k] / b.contents[k] / speed;
    p.error += std::abs(u - mean_pulse(x - from - way, h)) * h / width;
    if (x < from + way - width) p.back = std::max(p.back, std::abs(u));
  });
  p.imbalance = run.imbalance(0, longitudinal_speed(samples::aluminium()));
  return p;
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

/// A jump in the way leaves the order of the scheme as it is (3), sends back less than 2e-4 of the pulse, and
/// costs less than cells that are twice as wide everywhere. Measured: decision 0017.
TEST(LevelJump, KeepsTheOrderOfASmoothWave) {
  for (const bool fine_first : {true, false}) {
    std::array<Passage, 3> one, jump;
    for (std::size_t k = 0; k < 3; ++k) {
      const double cells = 32 << k;
      one[k] = pass(1, cells, fine_first), jump[k] = pass(2, cells, fine_first);
      EXPECT_LT(jump[k].imbalance, 1e-12);
      EXPECT_LT(jump[k].back, 2e-4) << cells;
      EXPECT_GT(jump[k].error, one[k].error) << cells;  // there is a jump
      if (k == 0) continue;
      EXPECT_GT(order(jump[k - 1].error, jump[k].error), 2.9) << cells;
      EXPECT_LT(jump[k].error, one[k - 1].error) << cells;
    }
  }
}

}  // namespace
}  // namespace recoil::level_jump_test
