#include "app/study/study_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace recoil::app::study_table_test {
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

TEST(StudyTable, ThreeMeshesGiveOrderAndExtrapolation) {
  for (const double p : {0.5, 1.0, 2.0, 3.0})
    for (const std::array<double, 3> h : {std::array{4e-4, 2e-4, 1e-4}, std::array{5e-4, 2e-4, 1.5e-4}}) {
      std::array<double, 3> q{};
      for (std::size_t k = 0; k < 3; ++k) q[k] = 7 - 3 * std::pow(h[k] / 1e-3, p);
      const double order = observed_order(h, q);
      EXPECT_NEAR(order, p, 1e-6);
      EXPECT_NEAR(extrapolated_value(h, q, order), 7, 1e-6);
    }
  const StudyRow row = rows_of(made_up(2)).front();
  EXPECT_NEAR(row.own_order, 2, 1e-6);
  EXPECT_NEAR(row.extrapolated, 10, 1e-6);
}

TEST(StudyTable, ValuesThatDoNotApproachEachOtherHaveNoOrder) {
  const std::array<double, 3> h{4, 2, 1};
  for (const std::array<double, 3> q :
       {std::array{1.0, 2.0, 1.5}, std::array{1.0, 2.0, 4.0}, std::array{3.0, 3.0, 3.0},
        std::array{1.0, 2.0, 2.0}, std::array{nothing, 2.0, 1.0}}) {
    EXPECT_TRUE(std::isnan(observed_order(h, q))) << q[0] << ' ' << q[1] << ' ' << q[2];
    EXPECT_TRUE(std::isnan(extrapolated_value(h, q, observed_order(h, q))));
  }
}

// Without any reference the study still says what the meshes say themselves.
TEST(StudyTable, AQuantityWithoutReferenceHasItsOwnOrder) {
  StudyTable table = made_up(1);
  for (StudyRun& run : table.runs) run.values[0].reference = nothing;
  const std::string text = study_markdown(table);
  EXPECT_NE(text.find("| a [1] | 10 |"), std::string::npos) << text;
  EXPECT_TRUE(std::isnan(rows_of(table).front().order[1]));
  EXPECT_NEAR(rows_of(table).front().own_order, 1, 1e-6);
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
}  // namespace recoil::app::study_table_test
