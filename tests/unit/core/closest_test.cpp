#include "core/closest.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace recoil::closest_test {
namespace {

TEST(Closest, CountsEditsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("velocty", "velocity"), 1);
  EXPECT_EQ(edit_distance("traget", "target"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("GPA", "gpa"), 0);
  EXPECT_EQ(edit_distance("ab", "ba"), edit_distance("ba", "ab"));
}

TEST(Closest, FindsTheNearestAndNothingFar) {
  const std::vector<std::string> names{"check", "run", "resume", "report", "study"};
  EXPECT_EQ(closest("chekc", names), "check");
  EXPECT_EQ(closest("resme", names), "resume");
  EXPECT_EQ(closest("xylophone", names), "");
  EXPECT_EQ(closest("", names), "");
}

TEST(Closest, PrefersWhatLooksAlike) {
  const std::vector<std::string> units{"m", "min", "um", "mm"};
  EXPECT_EQ(closest("mn", units), "mm");
}

TEST(Closest, FindsNamesByAPart) {
  const std::vector<std::string> names{"copper/seed", "copper/ofhc-johnson-cook", "steel/4340"};
  EXPECT_EQ(nearest("4340", names), std::vector<std::string>{"steel/4340"});
  EXPECT_EQ(nearest("copper", names).size(), 2U);
}

TEST(Closest, TheEndOfANameMayBeMissing) {
  const std::vector<std::string> names{"aluminium/7039", "aluminium/6061-t6", "copper/ofhc-johnson-cook",
                                       "copper/pure"};
  EXPECT_EQ(nearest("coper/ofhc", names), std::vector<std::string>{"copper/ofhc-johnson-cook"});
  EXPECT_EQ(nearest("aluminium/6061", names, 1), std::vector<std::string>{"aluminium/6061-t6"});
  EXPECT_TRUE(nearest("copt", names).empty());
}

TEST(Closest, WritesAQuestion) {
  const std::vector<std::string> names{"finest", "offset"};
  EXPECT_EQ(did_you_mean("finset", names), "did you mean 'finest'?");
  EXPECT_EQ(did_you_mean("zzzzzz", names), "");
  const std::vector<std::string> twins{"rod1", "rod2", "rod3"};
  EXPECT_EQ(did_you_mean("rod", twins, 3), "did you mean 'rod1', 'rod2' or 'rod3'?");
}

}  // namespace
}  // namespace recoil::closest_test
