#include "gauge/point_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../support/small_case.hpp"

namespace recoil::point_state_test {
namespace {

TEST(PointState, OfAStrainedPiece) {
  Body<2> body;
  body.material = hard_matter();
  body.material.thermal.rule = Thermal::Rule::plastic_work;
  body.temperature = temperature_law(body.material);
  using C = Components<2>;
  const double rho = 1010, volume = 2e-8, mass = rho * volume;
  Contents<2> q{};
  q[C::rho] = mass;
  q[C::u] = 3 * mass, q[C::u + 1] = -4 * mass;
  q[C::energy] = mass * (12.5 + 700);
  q[C::s] = mass * 3e6, q[C::s + 1] = mass * -1e6, q[C::s + 2] = mass * 2e6;
  q[C::ep] = mass * 0.25;
  q[C::temperature_rise] = mass * 11;
  const PointState<2> p = point_state(body, q, volume);
  EXPECT_DOUBLE_EQ(p.density, rho);
  EXPECT_DOUBLE_EQ(p.velocity[1], -4);
  EXPECT_NEAR(p.pressure, 15e9 * 0.01, 1e-3);
  EXPECT_NEAR(p.stress[0], 3e6 - 1.5e8, 1);
  EXPECT_NEAR(p.stress[1], -1e6 - 1.5e8, 1);
  EXPECT_NEAR(p.stress[2], 2e6, 1) << "shear";
  EXPECT_NEAR(p.stress[3], -2e6 - 1.5e8, 1) << "out of the plane: no trace";
  EXPECT_NEAR(p.von_mises, std::sqrt(1.5 * (9 + 1 + 4 + 2 * 4)) * 1e6, 1);
  EXPECT_DOUBLE_EQ(p.plastic_strain, 0.25);
  EXPECT_DOUBLE_EQ(p.temperature, 298 + 11);
}

TEST(PointState, OfALineSharesTheRestBetweenBothSides) {
  Body<1> body;
  body.material = hard_matter();
  body.temperature = temperature_law(body.material);
  Contents<1> q{};
  q[Components<1>::rho] = 1000;
  q[Components<1>::s] = 1000 * 6e6;
  const PointState<1> p = point_state(body, q, 1);
  EXPECT_NEAR(p.stress[0], 6e6, 1);
  EXPECT_NEAR(p.stress[1], -3e6, 1);
  EXPECT_NEAR(p.stress[2], -3e6, 1);
  EXPECT_NEAR(p.von_mises, 9e6, 1);
}

TEST(PointState, ElasticDistortionIsNoHeat) {
  Body<2> body;
  body.material = hard_matter();  // by energy; G 7.5 GPa, c 500 J/(kg K)
  body.temperature = temperature_law(body.material);
  using C = Components<2>;
  const double distortion = 2 * (9e12 + 9e12) / (4 * 7.5e9 * 1000);  // S_xx = -S_yy = 3 MPa and S_xy = 3 MPa
  Contents<2> q{};
  q[C::rho] = 1000;
  q[C::s] = 1000 * 3e6, q[C::s + 1] = 1000 * -3e6, q[C::s + 2] = 1000 * 3e6;
  q[C::energy] = 1000 * distortion;
  EXPECT_NEAR(point_state(body, q, 1).temperature, 298, 1e-9);
  q[C::energy] += 1000 * 500;
  EXPECT_NEAR(point_state(body, q, 1).temperature, 299, 1e-9);
}

}  // namespace
}  // namespace recoil::point_state_test
