#include "kernels/reconstruction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

#include "../core/random.hpp"

namespace recoil::reconstruction_test {
namespace {

constexpr double least = 1e-12;

double face(const std::array<double, 5>& v, double small = least) {
  return weno5z(v[0], v[1], v[2], v[3], v[4], small).high;
}

/// Means over five cells of width h, of which the third ends at x, of a function given by its integral.
std::array<double, 5> means(const std::function<double(double)>& integral, double x, double h) {
  std::array<double, 5> v{};
  for (int k = 0; k < 5; ++k) {
    const double low = x + (k - 3) * h;
    v[k] = (integral(low + h) - integral(low)) / h;
  }
  return v;
}

TEST(Weno5z, AConstantStaysTheSameToTheLastBit) {
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const double v = random(-1e9, 1e9);
    ASSERT_EQ(face({v, v, v, v, v}), v);
    ASSERT_EQ(face({v, v, v, v, v}, 1e8), v);
  }
}

TEST(Weno5z, MirroredDataGiveTheMirroredResultToTheLastBit) {
  Random random(7);
  for (int n = 0; n < 1000; ++n) {
    std::array<double, 5> v{};
    for (double& x : v) x = random(-1, 1);
    const Ends ends = weno5z(v[0], v[1], v[2], v[3], v[4], least),
               mirrored = weno5z(v[4], v[3], v[2], v[1], v[0], least);
    ASSERT_EQ(ends.low, mirrored.high);
    ASSERT_EQ(ends.high, mirrored.low);
  }
}

/// Every one of the three parabolas is exact for means of a parabola, whatever the weights.
TEST(Weno5z, ParabolasAreExact) {
  Random random(2);
  for (int n = 0; n < 200; ++n) {
    const double a = random(-3, 3), b = random(-3, 3), c = random(-3, 3), x = random(-2, 2),
                 h = random(0.1, 1);
    const auto integral = [&](double t) { return t * (a + t * (b / 2 + t * c / 3)); };
    ASSERT_NEAR(face(means(integral, x, h)), a + x * (b + x * c), 1e-12);
  }
}

TEST(Weno5z, SmoothFunctionsAreOfFifthOrder) {
  const auto error = [](double h) {
    double largest = 0;
    for (int k = 6; k < 24; ++k) {  // away from extrema
      const double x = 0.05 * k;
      largest = std::max(
          largest, std::abs(face(means([](double t) { return -std::cos(t); }, x, h), 1e-40) - std::sin(x)));
    }
    return largest;
  };
  EXPECT_GT(error(0.1) / error(0.05), 25);
  EXPECT_GT(error(0.05) / error(0.025), 25);
  EXPECT_LT(error(0.05), 1e-7);
}

/// With the largest `least` the weights are the linear ones: fifth order means exact for degree four.
TEST(Weno5z, SmoothDataUseTheFivePointsTogether) {
  const double x = 0.4, h = 0.1;
  const auto v = means([](double t) { return std::pow(t, 5) / 5; }, x, h);
  EXPECT_NEAR(face(v, 1e8), std::pow(x, 4), 1e-15);
}

TEST(Weno5z, AStepIsNotOvershot) {
  for (std::size_t jump = 0; jump <= 5; ++jump) {
    std::array<double, 5> v{};
    for (std::size_t k = 0; k < 5; ++k) v[k] = k < jump ? 1 : 0;
    EXPECT_GE(face(v), -0.01) << jump;
    EXPECT_LE(face(v), 1.01) << jump;
  }
}

TEST(Weno5z, IsTheSameInAllUnitsAndUpsideDown) {
  Random random(3);
  for (int n = 0; n < 100; ++n) {
    std::array<double, 5> v{}, scaled{};
    for (std::size_t k = 0; k < 5; ++k) {
      v[k] = random(-1, 1);
      scaled[k] = -1024 * v[k];
    }
    ASSERT_EQ(face(scaled, 1024.0 * 1024.0 * least), -1024 * face(v));
  }
}

double limited_face(const std::array<double, 5>& v) { return mp5(v[0], v[1], v[2], v[3], v[4], least).high; }

TEST(Mp5, ConstantsAndMirroredDataGiveTheSameToTheLastBit) {
  Random random(4);
  for (int n = 0; n < 1000; ++n) {
    const double same = random(-1e9, 1e9);
    ASSERT_EQ(limited_face({same, same, same, same, same}), same);
    std::array<double, 5> v{};
    for (double& x : v) x = random(-1, 1);
    const Ends ends = mp5(v[0], v[1], v[2], v[3], v[4], least),
               mirrored = mp5(v[4], v[3], v[2], v[1], v[0], least);
    ASSERT_EQ(ends.low, mirrored.high);
    ASSERT_EQ(ends.high, mirrored.low);
  }
}

/// At extrema as elsewhere: that is what it has over limiters of the total variation.
TEST(Mp5, SmoothFunctionsAreOfFifthOrderAtExtremaToo) {
  const auto error = [](double h) {
    double largest = 0;
    for (int k = 0; k < 630; ++k) {
      const double x = 0.01 * k;
      largest = std::max(
          largest, std::abs(limited_face(means([](double t) { return -std::cos(t); }, x, h)) - std::sin(x)));
    }
    return largest;
  };
  EXPECT_GT(error(0.2) / error(0.1), 28);
  EXPECT_GT(error(0.1) / error(0.05), 28);
}

/// Of data that rise, the value lies between the means beside the face.
TEST(Mp5, AStepIsNotOvershot) {
  for (std::size_t jump = 0; jump <= 5; ++jump) {
    std::array<double, 5> v{};
    for (std::size_t k = 0; k < 5; ++k) v[k] = k < jump ? 1 : 0;
    EXPECT_GE(limited_face(v), -1e-12) << jump;
    EXPECT_LE(limited_face(v), 1 + 1e-12) << jump;
  }
}

/// Waves of six cells and more get the linear weights, whatever their phase.
TEST(Mp5, AShortWaveGetsTheLinearWeights) {
  for (const int cells : {6, 7, 8, 12})
    for (int phase = 0; phase < 24; ++phase) {
      const double h = 2 * std::acos(-1.0) / cells;
      const auto v = means([](double t) { return -std::cos(t); }, phase * h / 24, h);
      const double linear = (2 * v[0] - 13 * v[1] + 47 * v[2] + 27 * v[3] - 3 * v[4]) / 60;
      ASSERT_NEAR(limited_face(v), linear, 1e-12) << cells << " cells, phase " << phase;
    }
}

}  // namespace
}  // namespace recoil::reconstruction_test
