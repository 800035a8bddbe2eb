#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

#include "dynamics/primitives.hpp"
#include "run.hpp"

namespace recoil::step_length_test {
namespace {

constexpr double mm = 1e-3;

/// Matter fills a periodic domain and moves by noise so weak that all weights of the reconstruction are those
/// of the linear scheme. @returns kinetic energy after `steps` steps of this CFL number, in parts of that of
/// the start.
template <int Dim>
double growth_of_noise(int cells, double cfl, int steps, StepStages stages = StepStages::three,
                       Strength strength = Elastic{43e9}) {
  using C = Components<Dim>;
  constexpr double amplitude = 1e-5;  // m/s
  Material m = samples::copper();
  m.eos = LinearEos{8930, 130e9};
  m.strength = strength;
  config::Vector lo{}, hi{};
  for (std::size_t d = 0; d < Dim; ++d) hi[d] = 10 * mm;
  const auto geometry = Dim == 1   ? config::Geometry::line
                        : Dim == 2 ? config::Geometry::planar
                                   : config::Geometry::space;
  const auto domain = domain_of(geometry, lo, hi, config::Boundary::periodic);
  for (auto& x : lo) x = -1;
  for (auto& x : hi) x = 1;
  TestRun<Dim> run(case_of(domain, 10 * mm / cells, {body_of("all", box_shape(lo, hi))}), {m});
  run.stepping.cfl = cfl;
  run.stepping.stages = stages;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-amplitude, amplitude);
  const auto kinetic_energy = [&](bool put_noise) {
    double sum = 0;
    for (int s = 0; s < run.state.mesh.local(); ++s) {
      BodyBlock<Dim>& b = run.state.bodies[0].at(s);
      const std::size_t n = b.volume.size();
      for (std::size_t k = 0; k < n; ++k)
        for (int d = 0; d < Dim; ++d) {
          double& momentum = b.contents[(C::u + d) * n + k];
          if (put_noise) momentum = b.contents[k] * noise(random);
          if (b.contents[k] > 0) sum += 0.5 * momentum * momentum / b.contents[k];
        }
    }
    return sum;
  };
  const double start = kinetic_energy(true);
  for (int k = 0; k < steps; ++k) advance(run.state, run.stepping, 1.0, run.engine);
  return kinetic_energy(false) / start;
}

/// The largest stable CFL numbers are 1.435, 1.447 and 1.36 (docs/decisions/0036).
TEST(StepLength, NoiseDiesOutBelowTheLimit) {
  EXPECT_LT(growth_of_noise<1>(64, 1.35, 60), 1);
  EXPECT_LT(growth_of_noise<2>(24, 1.35, 60), 1);
  EXPECT_LT(growth_of_noise<3>(12, 1.3, 40), 1);
}

TEST(StepLength, NoiseGrowsBeyondTheLimit) {
  EXPECT_GT(growth_of_noise<1>(64, 1.6, 60), 10);
  EXPECT_GT(growth_of_noise<2>(24, 1.6, 60), 10);
  EXPECT_GT(growth_of_noise<3>(12, 1.6, 40), 10);
}

/// With one stage linear waves are stable while c_L dt is below 1, 0.89 and 0.72 of dx in 1-D, 2-D and 3-D
/// (tools/stable_cfl): CFL numbers of 1, 1.25 and 1.01.
TEST(StepLength, WithOneStageNoiseDiesOutBelowItsOwnLimit) {
  for (const Strength& strength : {Strength{NoStrength{}}, Strength{Elastic{43e9}}}) {
    EXPECT_LT(growth_of_noise<1>(64, 0.95, 100, StepStages::one, strength), 1);
    EXPECT_LT(growth_of_noise<2>(24, 0.95, 100, StepStages::one, strength), 1);
    EXPECT_LT(growth_of_noise<3>(12, 0.95, 60, StepStages::one, strength), 1);
  }
  EXPECT_GT(growth_of_noise<1>(64, 1.2, 100, StepStages::one, NoStrength{}), 10);
  EXPECT_GT(growth_of_noise<2>(24, 1.5, 100, StepStages::one, NoStrength{}), 10);
  EXPECT_GT(growth_of_noise<3>(12, 1.4, 60, StepStages::one, NoStrength{}), 10);
}

/// A gas at rest, with sound far slower than the piston before it: the step must know of the piston before
/// the first matter moves with it.
TEST(StepLength, KnowsOfARigidBodyBeforeItSweepsMatterAlong) {
  const auto domain = domain_of(config::Geometry::line, {-10 * mm}, {20 * mm});
  config::Body piston = body_of("piston", box_shape({-4 * mm}, {0}));
  piston.rigid = true;
  piston.velocity = {2000};
  Material gas = samples::copper();
  gas.eos = IdealGas{1.66, 5.0 / 3, 101325, 0};
  gas.strength = NoStrength{};
  TestRun<1> run(case_of(domain, 0.1 * mm, {piston, body_of("gas", box_shape({0}, {30 * mm}))}), {gas, gas});
  const double sound = std::sqrt(5.0 / 3 * 101325 / 1.66);
  const double dt = advance(run.state, run.stepping, 1.0, run.engine);
  EXPECT_NEAR(dt, run.stepping.cfl * 0.1 * mm / (2000 + sound), 1e-3 * dt);
}

TEST(StepLength, SoundCountsOnceAlongADiagonal) {
  for (const int dim : {1, 2, 3}) {
    EXPECT_DOUBLE_EQ(sound_in_step(dim, StepStages::three), std::sqrt(dim));
    EXPECT_LT(sound_in_step(dim, StepStages::one), std::sqrt(dim) + 1e-12);
  }
}

}  // namespace
}  // namespace recoil::step_length_test
