#include "gauge/due.hpp"

#include <gtest/gtest.h>

namespace recoil::due_test {
namespace {

TEST(Due, OncePerIntervalWhateverTheSteps) {
  Due due(1.0);
  int count = 0;
  for (double t = 0; t <= 10.001; t += 0.3) {
    if (!due.at(t)) continue;
    ++count;
    due.done(t);
    EXPECT_FALSE(due.at(t));
  }
  EXPECT_EQ(count, 10);  // in 0 ... 9.9
}

TEST(Due, ExactMultiplesCountInSpiteOfRoundOff) {
  Due due(0.1e-6);
  due.done(0);
  double t = 0;
  for (int n = 0; n < 10; ++n) t += 0.01e-6;  // a little beside 0.1e-6
  EXPECT_TRUE(due.at(t));
  due.done(t);
  EXPECT_FALSE(due.at(t));
  EXPECT_FALSE(due.at(0.19e-6));
  EXPECT_TRUE(due.at(0.2e-6));
}

TEST(Due, ZeroIsAlways) {
  Due due(0);
  due.done(3);
  EXPECT_TRUE(due.at(3));
}

}  // namespace
}  // namespace recoil::due_test
