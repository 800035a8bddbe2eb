#include "material/starting_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "../core/dimensions.hpp"
#include "core/error.hpp"
#include "run.hpp"

namespace recoil::starting_state_test {
namespace {

using config::Boundary;
using config::Geometry;

constexpr double mm = 1e-3;

Material copper_by_energy() {
  Material m = samples::copper();
  m.thermal.rule = Thermal::Rule::energy;
  m.strength = JohnsonCook{43.33e9, 400e6, 0, 1.0, 0, 1.09, 1358};
  return m;
}

/// Every equation of state: the pressure and temperature that were asked for, and rest without.
TEST(StartingState, HasItsPressureAndTemperature) {
  samples::for_each<Eos>([](const auto& eos) {
    Material m = samples::hydro(copper_by_energy());
    m.eos = eos;
    const TemperatureLaw law(m.thermal, m.eos);
    const StartingState rest = state_at_start(m, {}, {}, "b");
    EXPECT_EQ(rest.density, eos.rho0);
    EXPECT_EQ(rest.energy, 0);
    for (const double p : {0.0, 5e4, 5e6})
      for (const double t : {298.0, 400.0}) {
        const StartingState s = state_at_start(m, p, t, "b");
        EXPECT_NEAR(eos.pressure(s.density, s.energy), p,
                    1e-9 * (p + eos.rho0 * std::pow(bulk_sound_speed(eos), 2)));
        EXPECT_NEAR(law.by_energy(law.solid_density(s.density, 0), s.energy), t, 1e-3) << eos.kind;
        EXPECT_EQ(s.heat, 0);
      }
  });
}

TEST(StartingState, OfMatterThatOnlyPlasticWorkHeats) {
  const Material m = samples::copper();
  const StartingState s = state_at_start(m, {}, 500, "bar");
  EXPECT_NEAR(s.density, 8930, 1e-6);
  EXPECT_NEAR(s.heat, 202, 1e-9);
  EXPECT_THROW(state_at_start(m, {}, 200, "bar"), InputError);
  EXPECT_THROW(state_at_start(m, -500e9, {}, "bar"), InputError);
}

template <class D>
struct Pressed : testing::Test {
  static constexpr int dim = D::value;
};
TYPED_TEST_SUITE(Pressed, Dimensions);

/// Under 5 GPa between walls on all sides, a rigid one among them: at rest for good.
TYPED_TEST(Pressed, BodyBetweenWallsStaysAtRest) {
  constexpr int dim = TestFixture::dim;
  using C = Components<dim>;
  const double dx = 0.1 * mm;
  config::Vector lo{}, hi{}, middle{};
  for (std::size_t d = 0; d < dim; ++d) hi[d] = 8 * dx;
  middle = hi;
  middle[0] = 5 * dx;
  const Geometry geometry = dim == 1 ? Geometry::line : dim == 2 ? Geometry::planar : Geometry::space;
  auto low = lo, high = hi;
  for (std::size_t d = 0; d < dim; ++d) low[d] -= 1 * mm, high[d] += 1 * mm;
  auto matter = body_of("matter", box_shape(low, high));
  high[0] = middle[0];
  matter.shape = box_shape(low, high);
  matter.pressure = 5e9;
  matter.temperature = 400;
  low[0] = middle[0], high[0] = hi[0] + 1 * mm;
  auto wall = body_of("wall", box_shape(low, high));
  wall.rigid = true;
  auto c = case_of(domain_of(geometry, lo, hi, Boundary::symmetry), dx, {matter, wall});
  TestRun<dim> run(c, {copper_by_energy(), Material{}});
  run.steps(20);
  for (const auto& b : run.state.bodies[0].blocks) {
    const std::size_t n = b.volume.size();
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t d = 0; d < dim && b.volume[k] > 0; ++d)
        EXPECT_NEAR(b.contents[(C::u + d) * n + k] / b.contents[k], 0, 1e-8);
  }
  EXPECT_LT(run.imbalance(0, 1000), 1e-13);
}

/// A bar strikes a rigid wall: where it yields, the stress is that of Johnson and Cook at its temperature.
TEST(StartingState, APreheatedBarIsSofter) {
  const auto strongest = [](std::optional<double> temperature) {
    auto bar = body_of("bar", box_shape(vector_of(0), vector_of(2 * mm)), vector_of(-100));
    bar.temperature = temperature;
    auto wall = body_of("wall", box_shape(vector_of(-2 * mm), vector_of(0)));
    wall.rigid = true;
    TestRun<1> run(
        case_of(domain_of(Geometry::line, vector_of(-1 * mm), vector_of(3 * mm)), 0.05 * mm, {bar, wall}),
        {copper_by_energy(), Material{}});
    run.steps(20);
    double most = 0;
    for (const auto& b : run.state.bodies[0].blocks) {
      const std::size_t n = b.volume.size();
      for (std::size_t k = 0; k < n; ++k)
        if (b.volume[k] > 0.5 * 0.05 * mm)
          most = std::max(most, 1.5 * std::abs(b.contents[Components<1>::s * n + k] / b.contents[k]));
    }
    return most;
  };
  const double cold = strongest({}), hot = strongest(700);
  EXPECT_NEAR(cold / 400e6, 1, 0.02);
  EXPECT_NEAR(hot / cold, 1 - std::pow((700.0 - 298) / (1358 - 298), 1.09), 0.02);
}

}  // namespace
}  // namespace recoil::starting_state_test
