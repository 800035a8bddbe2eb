#include "core/series.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace recoil::series_test {
namespace {

TEST(Series, AreExactToRounding) {
  for (const double x : {0.0, 1e-300, 1e-17, 1e-9, 1e-5, 1e-3, 0.0099, 0.01}) {
    for (const double s : {x, -x}) EXPECT_NEAR(exp_of_small(s), std::exp(s), 3e-16) << s;
    for (const double n : {0.01, 0.31, 1.0, 2.0, 5.0})
      EXPECT_NEAR(power_near_one(x, n), std::pow(1 + x, n), 4e-16 * (1 + n)) << x << " " << n;
  }
  EXPECT_EQ(exp_of_small(0.5), std::exp(0.5));
  EXPECT_TRUE(std::isnan(exp_of_small(std::nan(""))));
}

}  // namespace
}  // namespace recoil::series_test
