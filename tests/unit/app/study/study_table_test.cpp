#include "app/study/study_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace recoil::app {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Values that approach 10 with the given order, on three meshes and two shifts.
StudyTable made_up(double order) {
  StudyTable table{"made up", {"a", "b"}, {}};
  for (const double size : {1e-4, 4e-4, 2e-4})
    for (const double offset : {0.0, 0.5}) {
      const double error = std::pow(size / 1e-4, order) * (offset > 0 ? 0.3 : 0.1);
      table.runs.push_back({size, offset, {{10 + error, 10, nothing, ""}, {error, nothing, 2, "us"}}});
    }
  return table;
}

TEST(StudyTable, FindsTheOrder) {
  for (const double order : {1.0, 2.0})
    for (const StudyRow& row : rows_of(made_up(order))) {
      ASSERT_EQ(row.sizes, (std::vector<double>{4e-4, 2e-4, 1e-4}));
      EXPECT_TRUE(std::isnan(row.order[0]));
      EXPECT_NEAR(row.order[1], order, 1e-12) << row.quantity;
      EXPECT_NEAR(row.order[2], order, 1e-12) << row.quantity;
      EXPECT_NEAR(row.error[2], 0.2, 1e-12);
      EXPECT_NEAR(row.spread[2], 0.1, 1e-12);
    }
}

TEST(StudyTable, RoundOffHasNoOrder) {
  StudyTable table{"made up", {"a", "b"}, {}};
  for (const double size : {2e-4, 1e-4})
    table.runs.push_back({size, 0, {{10 + size * 1e-8, 10, nothing, ""}, {-size * 1e-8, nothing, 0.1, ""}}});
  for (const StudyRow& row : rows_of(table)) EXPECT_TRUE(std::isnan(row.order[1])) << row.quantity;
}

// One's own finest mesh as truth: zero there, and an order that is too high.
TEST(StudyTable, MeasureAgainstTheFinestFlatters) {
  const StudyRow row = rows_of(made_up(1)).front();
  EXPECT_EQ(row.from_finest[2], 0);
  EXPECT_GT(std::log2(row.from_finest[0] / row.from_finest[1]), 1.5);
}

TEST(StudyTable, MissingValuesAreMarked) {
  StudyTable table = made_up(1);
  table.runs[0].values[0].value = nothing;
  EXPECT_NE(study_markdown(table).find(" - "), std::string::npos);
  EXPECT_NE(study_csv(table).find("nan"), std::string::npos);
}

TEST(StudyTable, ACaseWithoutNumbersHasAnEmptyTable) {
  EXPECT_NE(study_markdown({"empty", {}, {{1e-4, 0, {}}}}).find("no expected numbers"), std::string::npos);
}

}  // namespace
}  // namespace recoil::app
