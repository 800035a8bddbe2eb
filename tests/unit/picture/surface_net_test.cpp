#include "picture/space/surface_net.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "../support/scratch_folder.hpp"
#include "config/shape/stl/stl_file.hpp"
#include "core/turn.hpp"
#include "core/vec.hpp"

namespace recoil::surface_net_test {
namespace {

/// A ball of radius 1 about the origin in a box.
class Ball : public Scene {
 public:
  explicit Ball(SpaceBox box) : box_(box) {}
  SpaceBox box() const override { return box_; }
  double cell() const override { return 0.1; }
  double distance(const Vec<3>& x) const override { return norm(x) - 1; }
  int body(const Vec<3>& /*x*/) const override { return 0; }
  double value(const Vec<3>& x, int /*body*/) const override { return x[0]; }

 private:
  SpaceBox box_;
};

/// By the divergence theorem; positive where faces look outwards.
double volume_of(const SurfaceNet& net) {
  double sum = 0;
  const auto triangle = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    const auto at = [&](std::int32_t n) { return net.points[static_cast<std::size_t>(n)]; };
    sum += dot(at(a), cross(at(b), at(c))) / 6;
  };
  for (const auto& f : net.faces) {
    triangle(f[0], f[1], f[2]);
    triangle(f[0], f[2], f[3]);
  }
  return sum;
}

/// Whether each side of a face is that of one other, taken the other way round.
void expect_closed(const SurfaceNet& net) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
  for (const auto& f : net.faces)
    for (std::size_t n = 0; n < 4; ++n) {
      ++sides[{f[n], f[(n + 1) % 4]}];
      --sides[{f[(n + 1) % 4], f[n]}];
    }
  for (const auto& [side, count] : sides) EXPECT_EQ(count, 0) << side.first << ' ' << side.second;
}

TEST(SurfaceNet, OfABallIsClosedAndNearlyRound) {
  for (const double h : {0.2, 0.1, 0.05}) {
    const SurfaceNet net = surface_net(Ball({{{-2, -2, -2}}, {{2, 2, 2}}}), h);
    expect_closed(net);
    for (const Vec<3>& x : net.points) {
      EXPECT_LT(norm(x), 1 + 1e-12);
      EXPECT_GT(norm(x), 1 - h * h / 2);
    }
    const double exact = 4 * std::numbers::pi / 3;
    EXPECT_LT(volume_of(net), exact);
    EXPECT_GT(volume_of(net), exact * (1 - 1.5 * h * h));
  }
}

TEST(SurfaceNet, EndsAtTheBox) {
  const double h = 0.05;
  const SurfaceNet half = surface_net(Ball({{{0, -2, -2}}, {{2, 2, 2}}}), h);
  expect_closed(half);
  const double exact = 2 * std::numbers::pi / 3;
  EXPECT_LT(volume_of(half), exact);
  EXPECT_GT(volume_of(half), exact - (1.5 * exact + std::numbers::pi / 2) * h * h);  // round, and its edge
  double least = 1;
  for (const Vec<3>& x : half.points) least = std::min(least, x[0]);
  EXPECT_NEAR(least, 0, 1e-12);
  // A box that is full of matter loses h^2 / 4 along each of its edges, less at the 8 corners.
  const SurfaceNet full = surface_net(Ball({{{0, 0, 0}}, {{0.5, 0.4, 0.3}}}), h);
  expect_closed(full);
  EXPECT_NEAR(volume_of(full), 0.06 - 4 * (0.5 + 0.4 + 0.3) * h * h / 4, 8 * h * h * h / 2);
}

TEST(SurfaceNet, PointsBelowLieInTheMatter) {
  const SurfaceNet net = surface_net(Ball({{{-2, -2, -2}}, {{2, 2, 2}}}), 0.05);
  const auto below = points_below(net, 0.1);
  ASSERT_EQ(below.size(), net.points.size());
  for (std::size_t n = 0; n < below.size(); ++n) EXPECT_NEAR(norm(below[n]), norm(net.points[n]) - 0.1, 2e-3);
}

TEST(SurfaceNet, StlIsReadBack) {
  const ScratchFolder folder;
  const SurfaceNet net = surface_net(Ball({{{-2, -2, -2}}, {{2, 2, 2}}}), 0.2);
  const std::string bytes = stl_bytes(net, "ball");
  std::ofstream(folder / "ball.stl", std::ios::binary) << bytes;
  EXPECT_EQ(bytes.size(), 84 + 100 * net.faces.size());
  const config::StlFile file = config::read_stl(folder / "ball.stl");
  EXPECT_EQ(file.problem, "") << "closed, and outside is outside";
}

}  // namespace
}  // namespace recoil::surface_net_test
