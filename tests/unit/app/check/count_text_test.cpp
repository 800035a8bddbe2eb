#include "app/check/count_text.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace recoil::app::count_text_test {
namespace {

TEST(CountText, IsReadable) {
  EXPECT_EQ(count_text(17283.4), "17300");
  EXPECT_EQ(count_text(120.2, 2), "120");
  EXPECT_EQ(count_text(7.68, 2), "7.7");
  EXPECT_EQ(count_text(622.6), "623");
  EXPECT_EQ(count_text(3.2e9), "3.2e+09");
  EXPECT_EQ(count_text(0), "0");
}

TEST(CountText, ACureIsEnough) {
  EXPECT_DOUBLE_EQ(rounded_down(0.1306e-3, 3), 0.130e-3);
  EXPECT_DOUBLE_EQ(rounded_down(1e-4, 3), 1e-4);
  EXPECT_DOUBLE_EQ(rounded_down(2e-3 / 20, 3), 1e-4);
}

TEST(CountText, OneIsNotSeveral) {
  EXPECT_EQ(counted(1, "case", "cases"), "1 case");
  EXPECT_EQ(counted(2L, "case", "cases"), "2 cases");
  EXPECT_EQ(counted(std::size_t{0}, "quantity", "quantities"), "0 quantities");
}

}  // namespace
}  // namespace recoil::app::count_text_test
