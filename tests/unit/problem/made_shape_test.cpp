#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "../core/random.hpp"
#include "../support/stl_bodies.hpp"
#include "cases.hpp"
#include "measured_shapes.hpp"
#include "problem/shape.hpp"

/// Shapes that are made of others, of a polygon or of triangles.
namespace recoil::made_shape_test {
namespace {

using namespace measured;
using config::Shape;
using std::numbers::pi;

Shape ball(double x, double y, double z, double radius) { return ball_shape(vector_of(x, y, z), radius); }

Shape moved(const Shape& shape, config::Vector axis, double angle, config::Vector centre = {},
            config::Vector shift = {}) {
  config::Moved m;
  m.shape = {shape};
  m.axis = axis;
  m.angle = angle;
  m.centre = centre;
  m.shift = shift;
  return {m};
}

TEST(MadeShapes, IntersectionsEverywhere) {
  const Shape on_line{
      config::Intersection{{box_shape(vector_of(0), vector_of(4)), box_shape(vector_of(3), vector_of(9))}}};
  EXPECT_DOUBLE_EQ(at<1>(on_line, line, {{3.25}}), -0.25);
  EXPECT_DOUBLE_EQ(at<1>(on_line, line, {{2}}), 1);
  const Shape lens{config::Intersection{{ball(-3, 0, 0, 5), ball(3, 0, 0, 5)}}};
  EXPECT_DOUBLE_EQ(at<3>(lens, space, {{0, 0, 0}}), -2);
  EXPECT_DOUBLE_EQ(at<3>(lens, space, {{6, 0, 0}}), 4);
  // Nested: what is left of the lens beside a hole through its middle.
  const Shape hole{config::Cylinder{.radius = 1, .length = {-9, 9}, .axis = vector_of(1)}};
  const Shape ring{config::Difference{{lens, hole}}};
  EXPECT_DOUBLE_EQ(at<3>(ring, space, {{0, 0, 0}}), 1);
  EXPECT_DOUBLE_EQ(at<3>(ring, space, {{0, 1.5, 0}}), -0.5);
  EXPECT_DOUBLE_EQ(at<3>({config::Union{{ring, ball(0, 0, 0, 0.5)}}}, space, {{0, 0, 0}}), -0.5);
}

TEST(MadeShapes, ExtrusionsAlongEachAxis) {
  config::Extrusion s;
  s.vertices = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};  // an L
  s.z = {1, 2};
  EXPECT_DOUBLE_EQ(at<3>({s}, space, {{0.5, 2, 1.75}}), -0.25);
  EXPECT_DOUBLE_EQ(at<3>({s}, space, {{2, 2, 1.5}}), 1);
  EXPECT_DOUBLE_EQ(at<3>({s}, space, {{7, 0.5, 6}}), 5);
  s.along = 0;
  s.x = {1, 2};  // the polygon lies in y and z
  EXPECT_DOUBLE_EQ(at<3>({s}, space, {{1.75, 0.5, 2}}), -0.25);
  EXPECT_DOUBLE_EQ(at<3>({s}, space, {{6, 7, 0.5}}), 5);
  s.along = 1;
  s.y = {1, 9};  // up to the edge of the domain, beyond which it goes on
  EXPECT_DOUBLE_EQ(at<3>({s}, space, {{0.5, 8.99, 2}}), -0.5);
  EXPECT_DOUBLE_EQ(at<3>({s}, space, {{0.5, 0.75, 2}}), 0.25);
  s.vertices = {{-9, -9}, {1, -9}, {1, 9}, {-9, 9}};  // all of x < 1
  EXPECT_DOUBLE_EQ(at<3>({s}, space, {{-8.9, 5, 8.9}}), -4);
}

TEST(MadeShapes, TurnedAndShifted) {
  // A quarter turn about y takes z to x.
  const Shape rod{config::Cylinder{.radius = 1, .length = {0, 6}}};
  const Shape lying = moved(rod, vector_of(0, 1), pi / 2, {}, vector_of(-2, 1, 0));
  EXPECT_NEAR(at<3>(lying, space, {{5, 1, 0}}), 1, 1e-14);
  EXPECT_NEAR(at<3>(lying, space, {{-2.5, 1, 0}}), 0.5, 1e-14);
  EXPECT_NEAR(at<3>(lying, space, {{1, 1, 3}}), 2, 1e-14);
  // As the rod along an oblique axis.
  const Vec<3> a{oblique_axis}, about = unit(cross(Vec<3>{{0, 0, 1}}, a));
  const Shape leaning = moved(rod, about.c, std::acos(a[2])),
              same{config::Cylinder{.radius = 1, .length = {0, 6}, .axis = oblique_axis}};
  Random random(2);
  for (int n = 0; n < 100; ++n) {
    const Vec<3> x = random.vector<3>(-8, 8);
    EXPECT_NEAR(at<3>(leaning, space, x), at<3>(same, space, x), 1e-13);
  }
  // In the plane counter-clockwise about its centre, along r = 0 and on a line by a shift alone.
  const Shape bar = moved(box_shape(vector_of(1, 1), vector_of(5, 2)), {}, pi / 2, vector_of(3, 1.5));
  EXPECT_NEAR(at<2>(bar, plane, {{3, 4.5}}), 1, 1e-14);
  EXPECT_DOUBLE_EQ(at<2>(moved(ball(0, 0, 0, 2), {}, 0, {}, vector_of(0, 3)), round, {{0, 6}}), 1);
  EXPECT_DOUBLE_EQ(at<1>(moved(box_shape(vector_of(0), vector_of(1)), {}, 0, {}, vector_of(3)), line, {{5}}),
                   1);
}

TEST(MadeShapes, WhatIsOnlyShiftedContinuesBeyondTheDomain) {
  const Shape slab = moved(box_shape(vector_of(-10, -9), vector_of(-1, 9)), {}, 0, {}, vector_of(1));
  EXPECT_DOUBLE_EQ(at<2>(slab, plane, {{-8, 8.9}}), -8);  // only the face at x = 0 is there
}

/// The least distance to any of the copies.
double to_nearest(const config::Lattice& lattice, const config::Domain& domain, const Vec<3>& x) {
  double least = 1e300;
  for (const Shape& copy : lattice.copies) least = std::min(least, at<3>(copy, domain, x));
  return least;
}

TEST(MadeShapes, LatticesAreUnionsOfTheirCopies) {
  config::Lattice balls;
  balls.shape = {ball(-6, -6, -6, 1)};
  balls.count = vector_of(4, 3, 2);
  balls.pitch = vector_of(3, 4, -2.5);
  balls.make_copies();
  ASSERT_EQ(balls.copies.size(), 24U);
  Random random(4);
  for (int n = 0; n < 300; ++n) {
    const Vec<3> x = random.vector<3>(-9, 9);
    EXPECT_EQ(at<3>({balls}, space, x), to_nearest(balls, space, x));
  }
  EXPECT_DOUBLE_EQ(at<3>({balls}, space, {{3, 2, -8.5}}), -1);  // the last one
  config::Lattice plates;
  plates.shape = {box_shape(vector_of(-9, -9), vector_of(-8, 9))};
  plates.count = vector_of(3, 1, 1);
  plates.pitch = vector_of(4);
  plates.make_copies();
  EXPECT_DOUBLE_EQ(at<2>({plates}, plane, {{-2, 8.9}}), 1);
  EXPECT_DOUBLE_EQ(at<2>({plates}, plane, {{-4.75, 8.9}}), -0.25);
  EXPECT_DOUBLE_EQ(at<2>({plates}, plane, {{-8.9, 0}}), -0.9);  // the first continues beyond the edge
}

TEST(MadeShapes, StlBodiesHaveTheDistancesOfTheirTwins) {
  config::Stl stl;
  stl.surface = std::make_shared<const config::ClosedSurface>(cube(-1, 2));
  const Shape s{stl}, box = box_shape(vector_of(-1, -1, -1), vector_of(2, 2, 2));
  Random random(9);
  for (int n = 0; n < 500; ++n) {
    const Vec<3> x = random.vector<3>(-4, 5);
    EXPECT_NEAR(at<3>(s, space, x), at<3>(box, space, x), 1e-13);
  }
  EXPECT_NEAR(volume_of<3>(moved(s, oblique_axis, 0.7), space, {{-5, -5, -5}}, 10, 1) / 27, 1, 1e-3);
}

TEST(MadeShapes, BoundsHoldThem) {
  config::Stl stl;
  stl.surface = std::make_shared<const config::ClosedSurface>(cube(-1, 2));
  const config::Line askew{{-2, 0, 1}, {1, 3, 2}};
  const std::vector<Shape> shapes{
      ball(1, 2, 3, 1),
      box_shape(vector_of(-1, 0, 1), vector_of(2, 3, 2)),
      {config::Cylinder{.radius = 1, .length = {-1, 2}, .centre = vector_of(1, 1, 0), .axis = oblique_axis}},
      {config::Cone{askew, 1}},
      {config::Frustum{askew, 1, 2}},
      {config::Ogive{askew, 1, 2}},
      {config::Torus{2, 0.5, {1, 0, 0}, oblique_axis}},
      {config::Revolution{config::joined_to_axis({{1, -1}, {2, 1}}), {0, 1, 0}, oblique_axis}},
      {stl}};
  Random random(6);
  for (const Shape& own : shapes) {
    SCOPED_TRACE(own.form.index());
    const Shape turned = moved(own, oblique_axis, 1, vector_of(1), vector_of(0, 0.5));
    for (const Shape& s :
         {own, turned, Shape{config::Union{{own, turned}}}, Shape{config::Difference{{own, turned}}}}) {
      const config::Bounds bounds = bounds_of(s, space);
      EXPECT_LT(bounds.hi[0] - bounds.lo[0], 20);
      for (int n = 0; n < 100; ++n) {
        const Vec<3> x = random.vector<3>(-6, 6);
        EXPECT_LE(bounds.distance(x), std::max(0.0, at<3>(s, space, x)) + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace recoil::made_shape_test
