#include "picture/space/surface_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../support/scratch_folder.hpp"
#include "config/shape/stl/stl_file.hpp"
#include "core/turn.hpp"

namespace recoil {
namespace {

const SpaceBox box{{{-1, -1, -1}}, {{1, 1, 1}}};

double ball(const Vec<3>& x) { return norm(x) - 0.7; }

double area(const std::vector<Triangle>& surface) {
  double sum = 0;
  for (const Triangle& t : surface) sum += 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
  return sum;
}

double volume(const std::vector<Triangle>& surface) {
  double sum = 0;
  for (const Triangle& t : surface) sum += dot(t[0], cross(t[1], t[2])) / 6;
  return sum;
}

/// Each edge is passed as often one way as the other.
bool is_closed(const std::vector<Triangle>& surface) {
  std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> passed;
  for (const Triangle& t : surface)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& a = t[k].c;
      const auto& b = t[(k + 1) % 3].c;
      if (a < b)
        ++passed[{a, b}];
      else
        --passed[{b, a}];
    }
  for (const auto& [edge, count] : passed)
    if (count != 0) return false;
  return true;
}

TEST(SurfaceMesh, BallIsClosedAndOfSecondOrder) {
  const double exact = 4.0 / 3 * M_PI * 0.343, sphere = 4 * M_PI * 0.49;
  const auto coarse = surface_mesh(ball, box, 0.1), fine = surface_mesh(ball, box, 0.05);
  EXPECT_TRUE(is_closed(coarse));
  EXPECT_TRUE(is_closed(fine));
  // Edges of triangles are at most sqrt(3) cells long, so a chord is at most 3 h^2/(8 R) below the sphere.
  const double deepest = 3 * 0.05 * 0.05 / (8 * 0.7);
  EXPECT_NEAR(volume(fine), exact, 3 * deepest / 0.7 * exact) << "and outside is outside";
  EXPECT_NEAR(area(fine), sphere, 2 * deepest / 0.7 * sphere);
  EXPECT_NEAR((volume(coarse) - exact) / (volume(fine) - exact), 4, 0.5);
  for (const Triangle& t : fine)
    for (const Vec<3>& x : t) EXPECT_NEAR(norm(x), 0.7, deepest);
}

TEST(SurfaceMesh, EndsAtTheBox) {
  const auto rod = [](const Vec<3>& x) { return std::hypot(x[1], x[2]) - 0.5; };
  const auto surface = surface_mesh(rod, box, 0.07);
  EXPECT_TRUE(is_closed(surface));
  EXPECT_NEAR(volume(surface), 2 * M_PI * 0.25, 0.02);
}

TEST(SurfaceMesh, FacesThroughCornersOfCellsAreClosedToo) {
  const auto cube = [](const Vec<3>& x) {
    return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}) - 0.625;
  };
  const auto surface = surface_mesh(cube, box, 0.25);
  EXPECT_TRUE(is_closed(surface));
  EXPECT_LE(volume(surface), 1.25 * 1.25 * 1.25 + 1e-12);
  EXPECT_GE(volume(surface), 1.25 * 1.25 * 1.25 - 12 * 1.25 * 0.5 * 0.25 * 0.25)
      << "edges are cut off by a cell";
}

TEST(SurfaceMesh, StlIsReadBack) {
  const ScratchFolder folder;
  const auto surface = surface_mesh(ball, box, 0.2);
  const std::string bytes = stl_bytes(surface, "ball");
  std::ofstream(folder / "ball.stl", std::ios::binary) << bytes;
  EXPECT_EQ(bytes.size(), 84 + 50 * surface.size());
  const config::StlFile file = config::read_stl(folder / "ball.stl");
  EXPECT_EQ(file.problem, "");
}

}  // namespace
}  // namespace recoil
