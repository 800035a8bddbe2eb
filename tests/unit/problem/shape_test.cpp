#include "problem/shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "../core/dimensions.hpp"
#include "cases.hpp"
#include "core/index.hpp"
#include "measured_shapes.hpp"

namespace recoil::shape_test {
namespace {

using namespace measured;

using config::Shape;

using std::numbers::pi;

TEST(SignedDistance, Intervals) {
  const auto s = box_shape(vector_of(1), vector_of(3));
  EXPECT_DOUBLE_EQ(at<1>(s, line, {{0}}), 1);
  EXPECT_DOUBLE_EQ(at<1>(s, line, {{1.5}}), -0.5);
  EXPECT_DOUBLE_EQ(at<1>(s, line, {{2.875}}), -0.125);
  EXPECT_DOUBLE_EQ(at<1>(s, line, {{5}}), 2);
}

TEST(SignedDistance, Boxes) {
  const auto s = box_shape(vector_of(-1, -2, -3), vector_of(1, 2, 3));
  EXPECT_DOUBLE_EQ(at<2>(s, plane, {{4, 6}}), 5);  // the corner
  EXPECT_DOUBLE_EQ(at<2>(s, plane, {{0, 5}}), 3);
  EXPECT_DOUBLE_EQ(at<2>(s, plane, {{0.2, 0}}), -0.8);
  EXPECT_DOUBLE_EQ(at<3>(s, space, {{2, 4, 5}}), 3);
  EXPECT_DOUBLE_EQ(at<3>(s, space, {{0, 0, 2.5}}), -0.5);
}

TEST(SignedDistance, TurnedBoxes) {
  auto s = box_shape(vector_of(1, 1), vector_of(5, 2));
  std::get<config::Box>(s.form).rotation =
      pi / 2;  // about its centre (3, 1.5): x in 2.5..3.5, y in -0.5..3.5
  EXPECT_NEAR(at<2>(s, plane, {{3, 4.5}}), 1, 1e-14);
  EXPECT_NEAR(at<2>(s, plane, {{5, 1.5}}), 1.5, 1e-14);
  EXPECT_NEAR(at<2>(s, plane, {{3, 1.5}}), -0.5, 1e-14);
  std::get<config::Box>(s.form).rotation = pi / 6;  // counter-clockwise: the right end goes up
  const double c = std::cos(pi / 6), n = std::sin(pi / 6);
  EXPECT_NEAR(at<2>(s, plane, {{3 + 3 * c, 1.5 + 3 * n}}), 1, 1e-14);
}

TEST(SignedDistance, BallsAndDiscs) {
  const auto s = ball_shape(vector_of(1, 2, 3), 2);
  EXPECT_DOUBLE_EQ(at<2>(s, plane, {{4, 6}}), 3);
  EXPECT_DOUBLE_EQ(at<3>(s, space, {{1, 2, 4}}), -1);
  const Shape disc{config::Cylinder{.radius = 2, .centre = vector_of(1, 2, 3)}};
  EXPECT_DOUBLE_EQ(at<2>(disc, plane, {{4, 6}}), 3);
  EXPECT_DOUBLE_EQ(at<2>(ball_shape(vector_of(0, 1), 2), round, {{3, 5}}), 3);
}

TEST(SignedDistance, Cylinders) {
  config::Cylinder cylinder{.radius = 2, .length = {-1, 4}};
  Shape s{cylinder};
  EXPECT_DOUBLE_EQ(at<2>(s, round, {{5, 8}}), 5);  // the edge at r 2, z 4
  EXPECT_DOUBLE_EQ(at<2>(s, round, {{0.1, 3.5}}), -0.5);
  EXPECT_DOUBLE_EQ(at<2>(s, round, {{1.875, 1}}), -0.125);
  cylinder.centre = vector_of(1, 1, 1);
  cylinder.axis = vector_of(0, 1, 0);
  s = {cylinder};
  EXPECT_DOUBLE_EQ(at<3>(s, space, {{1, 7, 1}}), 2);
  EXPECT_DOUBLE_EQ(at<3>(s, space, {{1, -1, 1}}), 1);
  EXPECT_DOUBLE_EQ(at<3>(s, space, {{6, 9, 1}}), 5);
  EXPECT_DOUBLE_EQ(at<3>(s, space, {{1.5, 2, 1}}), -1.5);
}

TEST(SignedDistance, HalfSpaces) {
  const Shape s{config::HalfSpace{vector_of(1, 1, 1), vector_of(0.6, 0.8, 0)}};
  EXPECT_DOUBLE_EQ(at<2>(s, plane, {{4, 5}}), 5);
  EXPECT_DOUBLE_EQ(at<3>(s, space, {{-2, -3, 7}}), -5);
}

TEST(SignedDistance, PolygonsOfEitherOrientation) {
  config::Polygon polygon;
  polygon.vertices = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};  // an L
  for (int n = 0; n < 2; ++n) {
    const Shape s{polygon};
    EXPECT_NEAR(at<2>(s, plane, {{0.5, 2}}), -0.5, 1e-14);
    EXPECT_NEAR(at<2>(s, plane, {{2, 2}}), 1, 1e-14);
    EXPECT_NEAR(at<2>(s, plane, {{7, 5}}), 5, 1e-14);
    EXPECT_NEAR(at<2>(s, plane, {{0.8, 0.8}}), -std::sqrt(0.08), 1e-14);  // to the inner corner
    std::reverse(polygon.vertices.begin(), polygon.vertices.end());
  }
}

TEST(SignedDistance, UnionsAndDifferences) {
  const std::vector<Shape> parts{ball_shape(vector_of(0, 0), 2), ball_shape(vector_of(3, 0), 2)};
  Shape s{config::Union{parts}};
  EXPECT_DOUBLE_EQ(at<2>(s, plane, {{6, 0}}), 1);
  EXPECT_DOUBLE_EQ(at<2>(s, plane, {{1.5, 0}}), -0.5);
  s = {config::Difference{parts}};
  EXPECT_DOUBLE_EQ(at<2>(s, plane, {{1.5, 0}}), 0.5);
  EXPECT_DOUBLE_EQ(at<2>(s, plane, {{-1, 0}}), -1);
}

TEST(SignedDistance, BodiesAtTheEdgeOfTheDomainContinue) {
  const auto low = box_shape(vector_of(-9, -9), vector_of(0, 9));
  EXPECT_DOUBLE_EQ(at<2>(low, plane, {{-8.9, 8.9}}), -8.9);  // only the face at x = 0 is there
  EXPECT_DOUBLE_EQ(at<2>(low, plane, {{-1, 0}}), -1);
  EXPECT_DOUBLE_EQ(at<2>(low, plane, {{2, 30}}), 2);
  config::Polygon corners;
  corners.vertices = {{-9, -9}, {0, -9}, {0, 9}, {-9, 9}};
  const Shape polygon{corners};
  EXPECT_NEAR(at<2>(polygon, plane, {{-4, 8.9}}), -4, 1e-14);
  // On the edge and beyond it as well.
  EXPECT_NEAR(at<2>(polygon, plane, {{-4, 9}}), -4, 1e-14);
  EXPECT_NEAR(at<2>(polygon, plane, {{-9, -9}}), -9, 1e-14);
  EXPECT_LT(at<2>(polygon, plane, {{-9.1, -9.1}}), -9);
  EXPECT_NEAR(at<2>(polygon, plane, {{2, 9}}), 2, 1e-14);
  const auto within = box_shape(vector_of(-8, -8), vector_of(0, 9));
  EXPECT_DOUBLE_EQ(at<2>(within, plane, {{-4, -7.5}}), -0.5);
}

TEST(InsidePart, DiscsBallsAndBoxesHaveTheirVolumes) {
  EXPECT_NEAR(volume_of<2>(ball_shape(vector_of(0.1, 0.07), 2), plane, {{-2.5, -2.5}}, 20, 0.25) / (4 * pi),
              1, 1e-4);
  EXPECT_NEAR(volume_of<3>(ball_shape(vector_of(0.1, 0.07, 0), 2), space, {{-2.5, -2.5, -2.5}}, 20, 0.25) /
                  (32 * pi / 3),
              1, 1e-3);
  EXPECT_NEAR(volume_of<2>(ball_shape(vector_of(0, 0.07), 2), round, {{0, -2.5}}, 20, 0.25) / (16.0 / 3), 1,
              1e-4);
  EXPECT_NEAR(volume_of<1>(box_shape(vector_of(0.137), vector_of(2.91)), line, {{0}}, 20, 0.25), 2.773,
              1e-12);
  auto turned = box_shape(vector_of(-1, -0.5), vector_of(1, 0.5));
  std::get<config::Box>(turned.form).rotation = 0.3;
  EXPECT_NEAR(volume_of<2>(turned, plane, {{-2.5, -2.5}}, 20, 0.25) / 2, 1, 1e-3);
}

TEST(InsidePart, AlignedFacesAreExact) {
  const auto distance = signed_distance<2>(box_shape(vector_of(-20, -20), vector_of(0.3, 20)), plane);
  EXPECT_NEAR(inside_part<2>(distance, {{0.5, 0.5}}, 1, 0), 0.3, 1e-12);
  EXPECT_EQ(inside_part<2>(distance, {{-1.5, 0.5}}, 1, 0), 1);
  EXPECT_EQ(inside_part<2>(distance, {{2.5, 0.5}}, 1, 0), 0);
}

}  // namespace
}  // namespace recoil::shape_test
