#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "../material/alumina.hpp"
#include "material/hugoniot.hpp"
#include "run.hpp"

namespace recoil::ceramic_test {
namespace {

using config::Geometry;

constexpr double mm = 1e-3;

/// Alumina (Cronin et al. 2003) strikes its mirror image, a rigid wall, at 200 m/s: the first wave rises to
/// the Hugoniot elastic limit, behind it matter breaks.
TEST(JohnsonHolmquist, PlateImpactHasItsHugoniotElasticLimit) {
  const Material alumina = samples::alumina();
  auto plate = body_of("plate", box_shape(vector_of(0), vector_of(10 * mm)), vector_of(-200));
  auto wall = body_of("wall", box_shape(vector_of(-2 * mm), vector_of(0)));
  wall.rigid = true;
  const double dx = 0.025 * mm;
  TestRun<1> run(
      case_of(domain_of(Geometry::line, vector_of(-0.5 * mm), vector_of(11 * mm)), dx, {plate, wall}),
      {alumina, Material{}});
  while (run.state.time < 0.9e-6) run.steps(1);
  // Stress over place: the plateau of the first wave, seen from ahead.
  const ShockState s = shock_at_velocity(alumina, 200);
  const double front = longitudinal_speed(alumina) * run.state.time;
  double stress = 0, broken = 0;
  int count = 0;
  for (std::size_t slot = 0; slot < run.state.bodies[0].blocks.size(); ++slot) {
    const auto& b = run.state.bodies[0].blocks[slot];
    const std::size_t n = b.volume.size();
    if (!b.present) continue;
    const Box<1> own = run.state.mesh.block(static_cast<int>(slot)).cells;
    for_each(own, [&](const Index<1>& i) {
      const auto k = static_cast<std::size_t>(run.state.grid().layout().at(i - own.lo));
      if (!(b.volume[k] > 0.9 * dx)) return;
      const double x = run.state.grid().centre(i)[0], place = x / front;
      const double damage = b.contents[Components<1>::damage * n + k] / b.contents[k];
      broken = std::max(broken, damage);
      if (place < 0.9 || place > 0.96) return;
      const double rho = b.contents[k] / b.volume[k];
      stress += pressure(alumina.eos, rho, 0) - b.contents[Components<1>::s * n + k] / b.contents[k];
      ++count;
    });
  }
  ASSERT_GT(count, 3);
  EXPECT_NEAR(stress / count / s.precursor_stress, 1, 0.02);
  EXPECT_NEAR(stress / count / 2.79e9, 1, 0.02);
  EXPECT_EQ(broken, 1);
}

}  // namespace
}  // namespace recoil::ceramic_test
