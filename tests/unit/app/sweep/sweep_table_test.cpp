#include "app/sweep/sweep_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "../../support/scratch_folder.hpp"
#include "format/csv.hpp"

namespace recoil::app::sweep_table_test {
namespace {

SweepTable made_up() {
  config::Diagnostics found;
  SweepTable t;
  t.title = "made up";
  t.keys = read_swept_keys({"v=300 m/s,0.4 km/s", R"(shape={ kind = "box" },{ kind = "disc" })", "fixed=1mm"},
                           found);
  t.columns = {{"gauge.a.pressure.mean@1us..2us", "GPa"}, {"event.ricochet", "1"}, {"run.steps", "1"}};
  for (const std::string& v : t.keys[0].values)
    for (const std::string& s : t.keys[1].values)
      t.rows.push_back({{v, s, "1mm"}, "run", "valid", {0.1, 1, 20}});
  t.rows.back().numbers[0] = std::numeric_limits<double>::quiet_NaN();
  return t;
}

CsvTable read_back(const std::string& text) {
  const ScratchFolder folder;
  std::ofstream(folder / "table.csv") << text;
  return read_csv(folder / "table.csv");
}

TEST(SweepTable, TheCsvReadsBack) {
  const CsvTable csv = read_back(sweep_csv(made_up()));
  ASSERT_EQ(csv.rows.size(), 4U);
  EXPECT_EQ(csv.numbers("set.v"), (std::vector<double>{300, 300, 400, 400}));  // in the unit of the first
  EXPECT_EQ(csv.unit("set.v"), "m/s");
  EXPECT_EQ(csv.texts("set.shape")[1], R"({ kind = "disc" })");
  EXPECT_EQ(csv.unit("gauge.a.pressure.mean@1us..2us"), "GPa");
  EXPECT_EQ(csv.numbers("run.steps")[3], 20);
  EXPECT_TRUE(std::isnan(csv.numbers("gauge.a.pressure.mean@1us..2us")[3]));
}

// The velocity that is set, and the one that is left: two columns.
TEST(SweepTable, AKeyAndAResultOfItsNameHaveTheirOwnColumns) {
  SweepTable table = made_up();
  table.columns[0] = {"v", "m/s"};
  const CsvTable csv = read_back(sweep_csv(table));
  EXPECT_EQ(csv.numbers("set.v")[0], 300);
  EXPECT_EQ(csv.numbers("v")[0], 0.1);
}

TEST(SweepTable, PeopleSeeWhatVaries) {
  const std::string text = sweep_markdown(made_up(), {0, 2});
  EXPECT_NE(
      text.find("| set.v [m/s] | set.shape | verdict | gauge.a.pressure.mean@1us..2us [GPa] | run.steps |"),
      std::string::npos)
      << text;
  EXPECT_EQ(text.find("fixed"), std::string::npos);
  EXPECT_NE(text.find("| 400 | { kind = \"disc\" } | valid | - | 20 |"), std::string::npos) << text;
}

FoundThreshold found_at(const std::string& thickness, double place) {
  FoundThreshold f{{thickness, ""}, Threshold({200, 800}, 10), ""};
  for (auto next = f.search.wanted(); !next.empty(); next = f.search.wanted())
    for (const double x : next) f.search.learn(x, x > place);
  return f;
}

TEST(SweepTable, ThresholdsOverTheOtherKeys) {
  config::Diagnostics none;
  const auto keys = read_swept_keys({"t=1mm,2mm,4mm", "v=200m/s:800m/s"}, none);
  std::vector<FoundThreshold> found{found_at("1mm", 310), found_at("2mm", 500), found_at("4mm", 900)};
  const CsvTable csv = read_back(threshold_csv(keys, 1, found));
  EXPECT_EQ(csv.numbers("t"), (std::vector<double>{1, 2, 4}));
  EXPECT_NEAR(csv.numbers("v")[0], 310, 10);
  EXPECT_LE(csv.numbers("half-width")[1], 10);
  EXPECT_EQ(csv.texts("holds"), (std::vector<std::string>{"above", "above", "nowhere"}));
  const std::string text = threshold_text(keys, 1, "x > 0", found);
  EXPECT_NE(text.find("t=1mm: v = "), std::string::npos) << text;
  EXPECT_NE(text.find("'x > 0' holds at no point of the range 200 m/s to 800 m/s"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace recoil::app::sweep_table_test
