#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "measured_shapes.hpp"

/// Shapes in a domain from -9 to 9 whose x axis is periodic.
namespace recoil::periodic_shape_test {
namespace {

using namespace measured;

config::Domain periodic(config::Domain domain) {
  domain.boundary[0] = {config::Boundary::periodic, config::Boundary::periodic};
  return domain;
}

TEST(PeriodicShapes, AreMetAgainAfterThePeriod) {
  const auto ball = ball_shape(vector_of(-8, 0), 2);  // from -10, which is 8
  EXPECT_NEAR(at<2>(ball, periodic(plane), {{8.5, 0}}), -1.5 + 1, 1e-12);
  EXPECT_NEAR(at<2>(ball, periodic(plane), {{7, 0}}), 1, 1e-12);
  EXPECT_NEAR(at<2>(ball, plane, {{7, 0}}), 13, 1e-12) << "without a period";
  EXPECT_NEAR(at<1>(ball, periodic(line), {{8.5}}), -0.5, 1e-12);
  EXPECT_NEAR(at<2>(ball, periodic(plane), {{7 + 36, 0}}), 1, 1e-12) << "beyond the domain as in it";
}

/// A ball as wide as the domain, but not in its middle.
TEST(PeriodicShapes, AreWholeIfNoLongerThanThePeriod) {
  EXPECT_NEAR(at<2>(ball_shape(vector_of(4, 0), 9), periodic(plane), {{-8.5, 0}}), -3.5, 1e-12);
}

TEST(PeriodicShapes, BoxesThatReachOneEndEndThere) {
  const auto box = box_shape(vector_of(-9, -1), vector_of(-5, 1));
  EXPECT_NEAR(at<2>(box, periodic(plane), {{-8.7, 0}}), -0.3, 1e-12);
  EXPECT_NEAR(at<2>(box, periodic(plane), {{8.5, 0}}), 0.5, 1e-12);
  EXPECT_NEAR(at<2>(box, plane, {{-8.7, 0}}), -1, 1e-12) << "it goes on beyond an open edge";
}

TEST(PeriodicShapes, WhatReachesBothEndsHasNone) {
  const auto slab = box_shape(vector_of(-9, -1), vector_of(9, 1));
  EXPECT_NEAR(at<2>(slab, periodic(plane), {{-9, 0}}), -1, 1e-12);
  const config::Shape band{config::Polygon{{{-9, -1}, {9, -1}, {9, 1}, {-9, 1}}}};
  EXPECT_NEAR(at<2>(band, periodic(plane), {{9, 0}}), -1, 1e-12);
}

TEST(PeriodicShapes, PartsHaveImagesOfTheirOwn) {
  const auto slab = box_shape(vector_of(-9, -1), vector_of(9, 1));
  const config::Shape ribbed{config::Union{{slab, box_shape(vector_of(-9, 1), vector_of(-8, 3))}}};
  EXPECT_NEAR(at<2>(ribbed, periodic(plane), {{8.5, 2}}), 0.5, 1e-12);
  EXPECT_NEAR(at<2>(ribbed, periodic(plane), {{0, 0}}), -1, 1e-12);
  const config::Shape drilled{config::Difference{{slab, ball_shape(vector_of(-9, 0), 0.5)}}};
  EXPECT_NEAR(at<2>(drilled, periodic(plane), {{8.75, 0}}), 0.25, 1e-12);
}

TEST(PeriodicShapes, MayBeGivenSeveralPeriodsAway) {
  EXPECT_NEAR(at<2>(ball_shape(vector_of(-36, 0), 2), periodic(plane), {{0.5, 0}}), -1.5, 1e-12);
  EXPECT_NEAR(at<2>(ball_shape(vector_of(45, 0), 2), periodic(plane), {{8.5, 0}}), -1.5, 1e-12);
}

TEST(PeriodicShapes, CopiesOfALatticeHaveImagesOfTheirOwn) {
  config::Lattice lattice;
  lattice.shape = {ball_shape(vector_of(-9, 0), 1)};
  lattice.count = {3, 1, 1};
  lattice.pitch = {6, 6, 6};  // at -9, -3, 3
  lattice.make_copies();
  EXPECT_NEAR(at<2>(config::Shape{lattice}, periodic(plane), {{8.5, 0}}), -0.5, 1e-12);
  EXPECT_NEAR(at<2>(config::Shape{lattice}, periodic(plane), {{0, 0}}), 2, 1e-12);
}

/// That of a body that takes up fragments.
TEST(PeriodicShapes, AnEmptyUnionIsFarAway) {
  EXPECT_GT(at<2>(config::Shape{config::Union{}}, periodic(plane), {{0, 0}}), 1e6);
}

TEST(PeriodicShapes, TurnedOnesAndPolygonsToo) {
  auto turned = box_shape(vector_of(-9, -1), vector_of(-5, 1));  // turned by a quarter: x from -8 to -6
  std::get<config::Box>(turned.form).rotation = std::numbers::pi / 2;
  EXPECT_NEAR(at<2>(turned, periodic(plane), {{9, 0}}), 1, 1e-12);
  const config::Shape triangle{config::Polygon{{{-8, -1}, {-6, 0}, {-8, 1}}}};
  EXPECT_NEAR(at<2>(triangle, periodic(plane), {{8, 0}}), 2, 1e-12);
}

TEST(PeriodicShapes, APlaceInAnImageBelongsToTheShape) {
  const auto own = within_shape<2>(ball_shape(vector_of(-8, 0), 2), periodic(plane));
  EXPECT_NEAR(own({{8.5, 0.5}})[0], -9.5, 1e-12);
  EXPECT_EQ(own({{8.5, 0.5}})[1], 0.5);
  EXPECT_EQ(own({{-7, 0}})[0], -7);
}

}  // namespace
}  // namespace recoil::periodic_shape_test
