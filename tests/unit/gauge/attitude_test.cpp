#include "gauge/attitude.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "../support/small_case.hpp"

namespace recoil::attitude_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

State<2> one_rod(const std::string& rest) {
  return state_of<2>(case_from(fmt::format(R"(
format = 1
[domain]
geometry = "planar"
x = ["-8 mm", "8 mm"]
y = ["-8 mm", "8 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "1 us"
[body.rod]
material = "none"
{}
)",
                                           rest)));
}

Attitude reading(const State<2>& state) {
  ExactSums sums;
  const int item = sums.item(attitude_sums);
  const parallel::World world;
  const AttitudeFrame frame = find_frame(state, 0, world);
  collect_attitude(state, 0, frame, item, sums);
  sums.reduce(world);
  return read_attitude(frame, sums.total(item));
}

const char* tilted =
    R"(shape = { kind = "rectangle", x = ["-6 mm", "6 mm"], y = ["-0.5 mm", "0.5 mm"], rotation = "-20 deg" })";

TEST(Attitude, OfATiltedRodThatTurns) {
  const Attitude a = reading(one_rod(std::string(tilted) + R"(
velocity = { speed = "100 m/s", angle = "-50 deg" }
spin = "3000 rad/s"
spin-centre = { x = "0 mm", y = "0 mm" }
)"));
  EXPECT_NEAR(a.inclination, -20 * degree, 0.02 * degree);
  EXPECT_NEAR(a.front_half, -20 * degree, 0.1 * degree);
  EXPECT_NEAR(a.front_third, -20 * degree, 0.2 * degree);
  EXPECT_NEAR(a.course, -50 * degree, 1e-6);
  EXPECT_NEAR(a.speed, 100, 1e-6);
  EXPECT_NEAR(a.spin, 3000, 3);
  // The foremost third is 4 mm ahead of the centre, at -20 degrees, and goes round it.
  EXPECT_NEAR(a.head_x, 100 * std::cos(50 * degree) + 3000 * 4e-3 * std::sin(20 * degree), 0.1);
  EXPECT_NEAR(a.head_y, -100 * std::sin(50 * degree) + 3000 * 4e-3 * std::cos(20 * degree), 0.1);
}

/// A rod of 8 mm that reaches across a periodic edge, half of it on each side.
TEST(Attitude, OfARodAcrossAPeriodicEdge) {
  const State<2> state = state_of<2>(case_from(R"(
format = 1
[domain]
geometry = "planar"
x = ["-8 mm", "8 mm"]
y = ["-8 mm", "8 mm"]
boundary = { x = "periodic" }
[mesh]
finest = "0.1 mm"
[time]
end = "1 us"
[body.rod]
material = "none"
shape = { kind = "union", parts = [{ kind = "box", x = ["4 mm", "9 mm"], y = ["-1 mm", "1 mm"] },
                                   { kind = "box", x = ["-9 mm", "-4 mm"], y = ["-1 mm", "1 mm"] }] }
velocity = { x = "100 m/s" }
)"));
  const parallel::World world;
  const AttitudeFrame frame = find_frame(state, 0, world);
  EXPECT_NEAR(std::abs(frame.centre[0]), 8e-3, 1e-5);
  EXPECT_NEAR(frame.length, 8e-3, 1e-5);
  EXPECT_NEAR(frame.spin, 0, 1e-3);
  EXPECT_NEAR(reading(state).head_x, 100, 1e-6);
}

TEST(Attitude, FrontIsWhereItGoes) {
  const Attitude a = reading(one_rod(std::string(tilted) + "\nvelocity = { x = \"-100 m/s\" }\n"));
  EXPECT_NEAR(a.inclination, 160 * degree, 0.02 * degree);
  const Attitude at_rest = reading(one_rod(tilted));
  EXPECT_NEAR(at_rest.inclination, -20 * degree, 0.02 * degree);
}

// Straight to x = 2 mm, from there on bent up by 20 degrees.
TEST(Attitude, PartsOfABentRod) {
  const Attitude a = reading(one_rod(R"(
velocity = { x = "10 m/s" }
shape = { kind = "union", parts = [
  { kind = "rectangle", x = ["-7 mm", "2 mm"], y = ["-0.3 mm", "0.3 mm"] },
  { kind = "rectangle", x = ["2 mm", "7 mm"], y = ["-0.3 mm", "0.3 mm"], rotation = "20 deg", centre = { x = "2 mm", y = "0 mm" } }] }
)"));
  EXPECT_NEAR(a.front_third, 20 * degree, 1 * degree);
  EXPECT_LT(a.front_half, a.front_third);
  EXPECT_LT(a.inclination, a.front_half);
  EXPECT_GT(a.inclination, 4 * degree);
}

}  // namespace
}  // namespace recoil::attitude_test
