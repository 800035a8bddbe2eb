#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "../../core/random.hpp"
#include "../../support/stl_bodies.hpp"
#include "config/shape/extrusion.hpp"
#include "config/shape/stl/closed_surface.hpp"
#include "config/shape/stl/stl_file.hpp"
#include "core/vec.hpp"

namespace recoil::config::stl_test {
namespace {

const std::vector<Corner> an_l{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};

/// The domain that no shape reaches the edge of.
Domain wide() {
  Domain d;
  d.geometry = Geometry::space;
  d.lo = {-99, -99, -99};
  d.hi = {99, 99, 99};
  return d;
}

TEST(ClosedSurface, HasTheDistancesOfThePrismThatItCovers) {
  const ClosedSurface surface(prism(an_l, -1, 2));
  Extrusion same;
  same.vertices = an_l;
  same.z = {-1, 2};
  Random random(7);
  int inside = 0;
  for (int n = 0; n < 3000; ++n) {
    const Vec<3> x = random.vector<3>(-2, 5);
    const double exact = same.distance(x, wide());
    inside += exact < 0;
    ASSERT_NEAR(surface.distance(x), exact, 1e-12) << x[0] << ' ' << x[1] << ' ' << x[2];
  }
  EXPECT_GT(inside, 50);
}

TEST(ClosedSurface, TellsInsideFromOutsideBesideEdgesAndCorners) {
  // Straight out of an edge or corner several faces are equally near, and some of their planes say "behind".
  std::vector<Corner> spike{{0, 0}, {10, -0.2}, {10, 0.2}};
  const ClosedSurface surface(prism(spike, 0, 1));
  for (const double z : {-0.5, 0.25, 0.5, 1.5}) {
    EXPECT_GT(surface.distance({{-0.3, 0.001, z}}), 0);
    EXPECT_GT(surface.distance({{-0.001, 0, z}}), 0);
    EXPECT_EQ(surface.distance({{9, 0, z}}) < 0, z > 0 && z < 1);
  }
  EXPECT_NEAR(surface.distance({{-3, 0, 5}}), 5, 1e-12);
}

TEST(ClosedSurface, FindsTheNearestOfManyTriangles) {
  // A ball of flat strips: distances within what the strips lack of the ball.
  Triangles ball;
  constexpr int around = 40, up = 20;
  constexpr double pi = 3.14159265358979323846;
  ball.points.push_back({{0, 0, -1}});
  for (int j = 1; j < up; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * pi * i / around, e = pi * (static_cast<double>(j) / up - 0.5);
      ball.points.push_back({{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)}});
    }
  ball.points.push_back({{0, 0, 1}});
  const int top = static_cast<int>(ball.points.size()) - 1;
  const auto at = [&](int j, int i) {
    return j == 0 ? 0 : j == up ? top : 1 + (j - 1) * around + i % around;
  };
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < around; ++i) {
      if (j > 0) ball.corners.push_back({at(j, i), at(j, i + 1), at(j + 1, i)});
      if (j + 1 < up) ball.corners.push_back({at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)});
    }
  EXPECT_EQ(fault_of(ball).problem, "");
  EXPECT_NEAR(volume_of(ball) / (4 * pi / 3), 1, 0.015);
  const ClosedSurface surface(ball);
  Random random(3);
  const double lacking = 1 - std::cos(pi / up);
  for (int n = 0; n < 500; ++n) {
    const Vec<3> x = random.vector<3>(-2, 2);
    const double away = surface.distance(x) - (norm(x) - 1);
    ASSERT_GE(away, -1e-12);
    ASSERT_LE(away, lacking);
    // No two places differ more than they are apart.
    const Vec<3> y = x + random.vector<3>(-0.01, 0.01);
    ASSERT_LE(std::abs(surface.distance(y) - surface.distance(x)), norm(y - x) * (1 + 1e-9));
  }
}

TEST(ClosedSurface, FaultsAreCountedAndPlaced) {
  Triangles s = cube(0, 1);
  EXPECT_EQ(fault_of(s).problem, "");
  EXPECT_DOUBLE_EQ(volume_of(s), 1);
  const auto last = s.corners.back();
  s.corners.pop_back();
  EXPECT_NE(fault_of(s).problem.find("not closed: 3 of 18 edges are open"), std::string::npos)
      << fault_of(s).problem;
  EXPECT_NE(fault_of(s).problem.find("(0, 1000, 0) mm"), std::string::npos) << fault_of(s).problem;
  s.corners.push_back({last[1], last[0], last[2]});
  EXPECT_NE(fault_of(s).problem.find("3 of 18 edges run the same way"), std::string::npos)
      << fault_of(s).problem;
  s.corners.back() = last;
  for (auto& t : s.corners) std::swap(t[0], t[1]);
  EXPECT_NE(fault_of(s).problem.find("inside out: the volume that it encloses is -1e+09 mm3"),
            std::string::npos)
      << fault_of(s).problem;
  // Two cubes that share an edge.
  Triangles two = cube(0, 1);
  const int n = static_cast<int>(two.points.size());
  for (const auto& p : cube(0, 1).points) two.points.push_back({{p[0] + 1, p[1] + 1, p[2]}});
  for (auto t : cube(0, 1).corners) {
    for (int& p : t) p = p == 0 ? 2 : p == 4 ? 6 : p + n;  // (0, 0) of the second is (1, 1) of the first
    two.corners.push_back(t);
  }
  EXPECT_NE(fault_of(two).problem.find("join more than two triangles"), std::string::npos)
      << fault_of(two).problem;
}

TEST(StlFile, TextAndBinaryHoldTheSame) {
  const Triangles s = prism(an_l, -1, 2);
  for (const std::string& bytes : {stl_text(s), stl_binary(s)}) {
    const StlFile file = parse_stl(bytes, "l.stl");
    ASSERT_EQ(file.problem, "");
    EXPECT_EQ(file.surface.points.size(), s.points.size());
    EXPECT_EQ(file.surface.corners.size(), s.corners.size());
    EXPECT_EQ(fault_of(file.surface).problem, "");
    EXPECT_DOUBLE_EQ(volume_of(file.surface), 18);
  }
  // A binary file may begin like a text, and triangles without an area say nothing.
  std::string named = stl_binary(s);
  named.replace(0, 5, "solid");
  EXPECT_EQ(parse_stl(named, "l.stl").surface.corners.size(), s.corners.size());
  Triangles more = s;
  more.corners.push_back({1, 1, 2});
  EXPECT_EQ(parse_stl(stl_binary(more), "l.stl").surface.corners.size(), s.corners.size());
}

TEST(StlFile, MistakesAreNamed) {
  const std::string text = stl_text(cube(0, 1)), binary = stl_binary(cube(0, 1));
  const auto problem = [](const std::string& bytes) { return parse_stl(bytes, "b.stl").problem; };
  EXPECT_NE(problem(binary.substr(0, 300)).find("12 triangles in 684 bytes, but has 300 bytes"),
            std::string::npos)
      << problem(binary.substr(0, 300));
  EXPECT_NE(problem("").find("no STL file"), std::string::npos);
  EXPECT_NE(problem("solid a\nendsolid a\n").find("no triangle"), std::string::npos);
  EXPECT_NE(problem(text.substr(0, text.find("vertex 0") + 30)).find("within a triangle"), std::string::npos);
  std::string wrong = text;
  wrong.replace(wrong.find("vertex 0"), 8, "vertex q");
  EXPECT_NE(problem(wrong).find("b.stl, line 4: 'q"), std::string::npos) << problem(wrong);
  std::string four = text;
  four.insert(four.find("  endloop"), "   vertex 1 2 3\n");
  EXPECT_NE(problem(four).find("line 8: a facet that is no triangle"), std::string::npos) << problem(four);
  EXPECT_NE(problem("solid a\n<html>\n").find("line 2: '<html>' does not belong"), std::string::npos);
  std::string nan = binary;
  nan.replace(84 + 12, 4, std::string("\x00\x00\xc0\x7f", 4));
  EXPECT_NE(problem(nan).find("triangle 1 has a corner that is no number"), std::string::npos);
}

}  // namespace
}  // namespace recoil::config::stl_test
