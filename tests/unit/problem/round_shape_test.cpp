#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "../core/random.hpp"
#include "cases.hpp"
#include "core/index.hpp"
#include "measured_shapes.hpp"
#include "problem/shape.hpp"

namespace recoil::round_shape_test {
namespace {

using namespace measured;

using config::Line;
using config::Shape;
using std::numbers::pi;

/// About the axis of r = 0 from one place to another.
Line along_axis(double from, double to) { return {{0, from, 0}, {0, to, 0}}; }

/// The same shape about an oblique line in space.
template <class T>
Shape oblique(T shape) {
  const double length = shape.size();
  shape.from = vector_of(0.5, -0.3, 0.2);
  shape.to = shape.from;
  for (std::size_t d = 0; d < 3; ++d) shape.to[d] += length * oblique_axis[d];
  return {shape};
}

TEST(RoundShapes, ConesAndFrustumsInClosedForm) {
  const Shape cone{config::Cone{along_axis(0, 4), 3}};
  EXPECT_DOUBLE_EQ(at<2>(cone, round, {{0, 5}}), 1);   // beyond the tip
  EXPECT_DOUBLE_EQ(at<2>(cone, round, {{6, -4}}), 5);  // to the rim of the base
  EXPECT_DOUBLE_EQ(at<2>(cone, round, {{1, -2}}), 2);  // to the base
  EXPECT_DOUBLE_EQ(at<2>(cone, round, {{5.5, 5}}),
                   5);                                 // straight out of the side, whose normal is (0.8, 0.6)
  EXPECT_DOUBLE_EQ(at<2>(cone, round, {{0, 1}}), -1);  // the base is nearer than the side
  EXPECT_DOUBLE_EQ(at<2>(cone, round, {{0, 3}}), -0.6);          // the side
  const Shape frustum{config::Frustum{along_axis(4, 0), 1, 4}};  // towards -z
  EXPECT_DOUBLE_EQ(at<2>(frustum, round, {{0, 6}}), 2);
  EXPECT_DOUBLE_EQ(at<2>(frustum, round, {{4, 8}}), 5);
  EXPECT_DOUBLE_EQ(at<2>(frustum, round, {{3.5, 3}}), std::abs(4 * 3.5 + 3 * 3 - 16) / 5);
  EXPECT_DOUBLE_EQ(at<2>(frustum, round, {{0.25, 3.5}}), -0.5);
}

TEST(RoundShapes, OgivesInClosedForm) {
  // A radius of 1 and a nose of 3: an arc of radius 5, from which the axis is 4 away.
  const Shape s{config::Ogive{along_axis(0, 7), 1, 3}};
  EXPECT_DOUBLE_EQ(at<2>(s, round, {{0, 8}}), 1);     // beyond the tip
  EXPECT_DOUBLE_EQ(at<2>(s, round, {{4, 2}}), 3);     // beside the cylinder
  EXPECT_DOUBLE_EQ(at<2>(s, round, {{0.5, -2}}), 2);  // behind it
  EXPECT_DOUBLE_EQ(at<2>(s, round, {{0.75, 2}}), -0.25);
  const double steep = 0.5;  // seen from the centre of the arc, which lies at r = -4, z = 4
  EXPECT_NEAR(at<2>(s, round, {{8 * std::cos(steep) - 4, 4 + 8 * std::sin(steep)}}), 3, 1e-14);
  EXPECT_NEAR(at<2>(s, round, {{4.6 * std::cos(steep) - 4, 4 + 4.6 * std::sin(steep)}}), -0.4, 1e-14);
  // A nose as long as the radius is half a ball.
  const Shape ball{config::Ogive{along_axis(-5, 2), 2, 2}};
  EXPECT_DOUBLE_EQ(at<2>(ball, round, {{3, 4}}), 3);
}

TEST(RoundShapes, TorusesAndProfilesInClosedForm) {
  const Shape torus{config::Torus{.radius = 4, .tube = 1, .centre = vector_of(0, 1)}};
  EXPECT_DOUBLE_EQ(at<2>(torus, round, {{7, 5}}), 4);
  EXPECT_DOUBLE_EQ(at<2>(torus, round, {{0, 1}}), 3);
  const Shape in_space{config::Torus{4, 1, {}, {1, 0, 0}}};
  EXPECT_DOUBLE_EQ(at<3>(in_space, space, {{4, 0, 7}}), 4);
  EXPECT_DOUBLE_EQ(at<3>(in_space, space, {{0, 0, 0}}), 3);
  // A profile that is a cylinder: the axis is no surface.
  const Shape cylinder{config::Revolution{config::joined_to_axis({{2, -1}, {2, 4}})}};
  EXPECT_DOUBLE_EQ(at<2>(cylinder, round, {{0, 1.5}}), -2);
  EXPECT_DOUBLE_EQ(at<2>(cylinder, round, {{5, 8}}), 5);
  // One that ends where it begins is a ring.
  const Shape ring{config::Revolution{config::joined_to_axis({{2, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 0}})}};
  EXPECT_DOUBLE_EQ(at<2>(ring, round, {{0, 0.5}}), 2);
  EXPECT_DOUBLE_EQ(at<2>(ring, round, {{2.5, 0.5}}), -0.5);
}

/// Each with its volume [m3].
std::vector<std::pair<Shape, double>> with_volumes() {
  const double arc = 5, off = 4, nose = 3;  // of the ogive above
  const double tip = pi * (arc * arc * nose - nose * nose * nose / 3 + off * off * nose -
                           off * (nose * off + arc * arc * std::asin(nose / arc)));
  return {{{config::Cone{along_axis(-2, 1), 1.5}}, pi * 1.5 * 1.5},
          {{config::Frustum{along_axis(-1, 1), 1.5, 0.5}}, 2 * pi / 3 * (2.25 + 0.75 + 0.25)},
          {{config::Ogive{along_axis(-2.4, 2.2), 1, 3}}, pi * 1.6 + tip},
          {{config::Torus{1.5, 0.6}}, 2 * pi * pi * 1.5 * 0.36},
          {{config::Revolution{config::joined_to_axis({{0, -2}, {1.4, 0}, {1.4, 2}})}},
           pi * 1.96 * (2.0 / 3 + 2)}};
}

TEST(RoundShapes, HaveTheirVolumesAroundTheAxis) {
  for (const auto& [shape, volume] : with_volumes()) {
    SCOPED_TRACE(shape.form.index());
    EXPECT_NEAR(2 * pi * volume_of<2>(shape, round, {{0, -2.5}}, 20, 0.25) / volume, 1, 3e-4);
  }
}

TEST(RoundShapes, ObliqueOnesHaveTheDistancesOfThoseAlongTheAxis) {
  const auto compare = [](const Shape& upright, const Shape& turned) {
    Random random(11);
    for (int n = 0; n < 200; ++n) {
      const double r = random(0, 4), z = random(-4, 8), phase = random(0, 6);
      EXPECT_NEAR(at<3>(turned, space, on_oblique(r, z, phase)), at<2>(upright, round, {{r, z}}), 1e-13);
    }
  };
  const config::Cone cone{along_axis(0, 4), 3};
  const config::Frustum frustum{along_axis(0, 3), 1, 2};
  const config::Ogive ogive{along_axis(0, 6), 1, 3};
  compare({cone}, oblique(cone));
  compare({frustum}, oblique(frustum));
  compare({ogive}, oblique(ogive));
  config::Torus torus{2, 0.5};
  config::Revolution revolution{config::joined_to_axis({{1, -1}, {2, 3}})};
  const Shape upright_torus{torus}, upright_revolution{revolution};
  torus.centre = revolution.centre = vector_of(0.5, -0.3, 0.2);
  torus.axis = revolution.axis = oblique_axis;
  compare(upright_torus, {torus});
  compare(upright_revolution, {revolution});
}

TEST(RoundShapes, AreTheirOwnMirrorImageInThePlane) {
  const config::Ogive ogive{{{1, 1, 0}, {5, 4, 0}}, 0.5, 2};  // along (0.8, 0.6)
  const Shape same{config::Ogive{along_axis(0, 5), 0.5, 2}};
  for (const double side : {-1.0, 1.0})
    for (const double r : {0.0, 0.2, 0.7, 2.0})
      for (const double z : {-1.0, 0.5, 3.4, 6.0})
        EXPECT_NEAR(at<2>({ogive}, plane, {{1 + 0.8 * z - side * 0.6 * r, 1 + 0.6 * z + side * 0.8 * r}}),
                    at<2>(same, round, {{r, z}}), 1e-14);
}

TEST(RoundShapes, CloseToTheSurfaceTheGradientIsOne) {
  Random random(5);
  for (const auto& [shape, volume] : with_volumes()) {
    SCOPED_TRACE(shape.form.index());
    const auto distance = signed_distance<2>(shape, round);
    int judged = 0;
    for (int n = 0; n < 1000; ++n) {
      const Vec<2> x{{random(0.1, 3), random(-3, 3)}};
      if (std::abs(distance(x)) > 0.3) continue;
      const Vec<2> g = gradient<2>(distance, x);
      judged += std::abs(norm(g) - 1) < 1e-6;  // all but those beside a place as near to two faces
      EXPECT_LT(norm(g), 1 + 1e-6);
    }
    EXPECT_GT(judged, 100);
  }
}

}  // namespace
}  // namespace recoil::round_shape_test
