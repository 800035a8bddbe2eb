#include "app/approach.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "config/shape/shape.hpp"

namespace recoil::app::approach_test {
namespace {

/// Two squares of 4 mm side by side in the plane: `first` moves, its right side `gap` left of the other one.
Approach squares(double gap, const config::Vector& velocity, double up = 0) {
  config::Case c;
  c.domain.geometry = config::Geometry::planar;
  c.domain.lo = {-8e-3, -8e-3, 0};
  c.domain.hi = {8e-3, 8e-3, 0};
  c.mesh.finest = 0.1e-3;
  for (const auto& [x, y] : {std::pair(-4e-3 - gap, up), std::pair(0.0, 0.0)}) {
    config::Body& body = c.bodies.emplace_back();
    body.name = c.bodies.size() == 1 ? "first" : "second";
    body.shape.form = config::Box{{x, y - 2e-3, 0}, {x + 4e-3, y + 2e-3, 0}};
  }
  c.bodies[0].velocity = velocity;
  return find_approaches(c).at(0);
}

TEST(Approach, BodiesThatSlideAlongASharedFaceDoNotClose) {
  for (const double up : {0.0, 1e-3, -2.5e-3}) {
    const Approach p = squares(0, {0, 100, 0}, up);
    EXPECT_EQ(p.meeting, Meeting::rest) << up;
    EXPECT_EQ(squares(0, {0, -100, 0}, up).meeting, Meeting::rest) << up;
  }
}

TEST(Approach, FacesThatMeetAskewCloseAlongTheirNormal) {
  for (const double gap : {0.0, 0.5e-3})
    for (const double up : {0.0, 1e-3}) {
      const Approach p = squares(gap, {300, 100, 0}, up);
      ASSERT_EQ(p.meeting, Meeting::close) << gap << ' ' << up;
      EXPECT_NEAR(p.closing, 300, 1e-3) << gap << ' ' << up;
      EXPECT_NEAR(p.sliding, 100, 1e-3) << gap << ' ' << up;
      EXPECT_NEAR(p.time, gap / 300, 1e-9) << gap << ' ' << up;
    }
}

TEST(Approach, BodiesThatLeaveASharedFacePart) {
  EXPECT_EQ(squares(0, {-300, 100, 0}).meeting, Meeting::part);
  EXPECT_EQ(squares(0, {0, 0, 0}).meeting, Meeting::rest);
  EXPECT_EQ(squares(0.5e-3, {0, 100, 0}).meeting, Meeting::pass);
}

}  // namespace
}  // namespace recoil::app::approach_test
