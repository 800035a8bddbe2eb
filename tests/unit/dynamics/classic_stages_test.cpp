#include "dynamics/classic_stages.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace recoil::classic_stages_test {
namespace {

/// dQ/dt = -Q by the rule, for one block of a single number.
double decay(double length, int steps) {
  BodyBlock<1> b;
  b.contents.assign(1, 1.0);
  const double dt = length / steps;
  for (int n = 0; n < steps; ++n) {
    b.contents_old = b.contents;
    for (const ClassicStage& stage : rk4) {
      const double rate = -b.contents[0];
      start_stage(b);
      b.contents[0] += stage.length * dt * rate;
      collect_stage(b, stage);
      if (&stage == &rk4.back()) finish_stages(b);
    }
  }
  return b.contents[0];
}

TEST(ClassicStages, AreOfFourthOrder) {
  const auto error = [](int steps) { return std::abs(decay(1, steps) - std::exp(-1.0)); };
  EXPECT_NEAR(std::log2(error(4) / error(8)), 4, 0.2);
}

TEST(ClassicStages, OneStepIsTheTaylorPolynomial) {
  EXPECT_NEAR(decay(0.5, 1), 1 - 0.5 + 0.125 - 0.125 / 6 + 0.0625 / 24, 1e-15);
}

}  // namespace
}  // namespace recoil::classic_stages_test
