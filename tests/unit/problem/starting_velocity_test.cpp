#include "problem/starting_velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cases.hpp"
#include "core/error.hpp"

namespace recoil::starting_velocity_test {
namespace {

using config::Geometry;

const config::Domain plane = domain_of(Geometry::planar, vector_of(-4, -4), vector_of(4, 4));

config::Body with_field(const std::string& x, const std::string& y) {
  config::Body body = body_of("b", box_shape(vector_of(-1, -1), vector_of(1, 1)), vector_of(100, 0));
  body.velocity_field.x = x;
  body.velocity_field.y = y;
  return body;
}

/// The mean of x^3 over a cell is x^3 + x dx^2/4.
TEST(StartingVelocity, FormulasAreAddedAsMeansOfTheirCell) {
  const auto u = starting_velocity<2>(with_field("", "8 * (x/m)^3 * m/s"), plane, 0.2);
  EXPECT_EQ(u({{0.5, 0}})[0], 100);
  EXPECT_NEAR(u({{0.5, 0}})[1], 8 * (0.125 + 0.5 * 0.04 / 4), 1e-12);
}

/// Of a cell whose right half is empty only the left one counts.
TEST(StartingVelocity, OnlyWhatIsInsideOfACellCounts) {
  const auto u = starting_velocity<2>(with_field("x/s", ""), plane, 0.2);
  EXPECT_NEAR(u({{1, 0}})[0], 100 + 1 - 0.1 / std::sqrt(3), 1e-12);
}

TEST(StartingVelocity, NoFiniteValueIsAnError) {
  const auto u = starting_velocity<2>(with_field("m/s * sqrt(x/m)", ""), plane, 0.2);
  EXPECT_NO_THROW(u({{0.5, 0}}));
  try {
    u({{-0.5, 0}});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("the velocity-field of 'b' has no finite value"), std::string::npos)
        << e.what();
  }
}

/// A formula that ends at the surface of the body is not asked outside of it.
TEST(StartingVelocity, FormulasAreAskedInsideOfTheBody) {
  const auto left = starting_velocity<2>(with_field("m/s * sqrt((x+1*m)/m)", ""), plane, 0.2);
  EXPECT_NEAR(left({{-1.08, 0}})[0], 100, 0.05);
  EXPECT_NEAR(left({{-1.1, -1.1}})[0], 100, 0.05);  // beside a corner
  const auto right = starting_velocity<2>(with_field("m/s * sqrt((1*m-x)/m)", ""), plane, 0.2);
  EXPECT_NEAR(right({{1.3, 0.5}})[0], 100, 0.05);
}

/// A disc across the periodic edge turns as one.
TEST(StartingVelocity, ImagesMoveAsTheBody) {
  config::Domain domain = plane;
  domain.boundary[0] = {config::Boundary::periodic, config::Boundary::periodic};
  config::Body disc = body_of("disc", ball_shape(vector_of(-4, 0), 1));
  disc.spin = vector_of(0, 0, 10);
  disc.spin_centre = vector_of(-4, 0);
  const auto u = starting_velocity<2>(disc, domain, 0.1);
  EXPECT_NEAR(u({{-3.5, 0}})[1], 5, 1e-12);
  EXPECT_NEAR(u({{3.5, 0}})[1], -5, 1e-12);
}

}  // namespace
}  // namespace recoil::starting_velocity_test
