#include "core/marks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace recoil::marks_test {
namespace {

TEST(Marks, EveryMarkIsFoundInItsOrder) {
  for (const int count : {0, 1, 7, 8, 9, 16, 21})
    for (int step = 1; step < 12; ++step) {
      std::array<std::uint8_t, 21 + marks_beyond> marks{};
      std::vector<int> set, found;
      for (int c = step - 1; c < 21; c += step) {
        marks[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(1 + c % 3);
        if (c < count) set.push_back(c);
      }
      for_each_set(marks.data(), count, [&](int c) { found.push_back(c); });
      EXPECT_EQ(found, set) << count << " " << step;
      if (!set.empty()) {
        EXPECT_TRUE(any_set(marks.data(), count));
      }
    }
}

TEST(Marks, NoneIsFoundWhereNoneIs) {
  const std::array<std::uint8_t, 21 + marks_beyond> marks{};
  EXPECT_FALSE(any_set(marks.data(), 21));
}

}  // namespace
}  // namespace recoil::marks_test
