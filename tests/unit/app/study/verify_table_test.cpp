#include "app/study/verify_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../../support/scratch_folder.hpp"
#include "record/summary.hpp"

namespace recoil::app::verify_table_test {
namespace {

config::Expectation time_of(double value, double tolerance) {
  config::Expectation e;
  e.quantity = "contact.a-b.opens";
  e.value = value, e.tolerance = tolerance, e.unit = "us", e.source = "theory";
  return e;
}

/// A run with one reference that is met, one limit that is not, and one truth.
VerifiedCase made_up(const ScratchFolder& folder) {
  Summary s;
  s.version = "1";
  s.cells = 340, s.steps = 12, s.wall_s = 2.5, s.cpu_s = 3.5, s.exit = 5;
  s.expect.push_back({time_of(0.7e-6, 0.014e-6), {0.707e-6, false, false, ""}, true});
  config::Expectation limit;
  limit.quantity = "budget.total.mass", limit.value = 1e-11, limit.at_most = true, limit.why = "round-off";
  s.expect.push_back({limit, {1e-3, false, false, ""}, false});
  config::Expectation truth;
  truth.quantity = "contact.a-b.recloses", truth.is_flag = true;
  s.expect.push_back({truth, {0, true, false, ""}, true});
  write_summary(folder / "summary.json", s);
  VerifiedCase c = read_verified(folder / "");
  c.name = "plates", c.title = "Two plates";
  return c;
}

TEST(VerifyTable, ReadsWhatARunLeft) {
  const ScratchFolder folder;
  const VerifiedCase c = made_up(folder);
  ASSERT_EQ(c.values.size(), 3U);
  EXPECT_EQ(c.values[0].ours, "0.707 us");
  EXPECT_EQ(c.values[0].error, "+1 %");
  EXPECT_EQ(c.values[0].tolerance, "± 2 %");
  EXPECT_TRUE(c.values[0].pass && c.values[0].has_source);
  EXPECT_EQ(c.values[1].reference, "≤ 1e-11");
  EXPECT_EQ(c.values[1].source, "round-off");
  EXPECT_FALSE(c.values[1].has_source) << "a reason is no reference";
  EXPECT_EQ(c.values[2].ours, "false");
  EXPECT_EQ(c.failures(), 1);
  EXPECT_EQ(c.cells, 340);
}

TEST(VerifyTable, ARunThatLeftNothingIsAFailure) {
  const ScratchFolder folder;
  const VerifiedCase c = read_verified(folder / "none");
  EXPECT_FALSE(c.problem.empty());
  EXPECT_EQ(c.failures(), 1);
  EXPECT_NE(verify_markdown({c}).find("FAIL"), std::string::npos);
}

TEST(VerifyTable, SaysTheSameInAllForms) {
  const ScratchFolder folder;
  const std::vector<VerifiedCase> cases{made_up(folder)};
  const VerifyCount n = count(cases);
  EXPECT_EQ(n.values, 3);
  EXPECT_EQ(n.references, 1);
  EXPECT_EQ(n.failures, 1);
  const std::string text = verify_markdown(cases, {"mesh.finest=0.2mm"});
  EXPECT_NE(text.find("In every case: `--set mesh.finest=0.2mm`"), std::string::npos) << text;
  EXPECT_NE(text.find("| plates | 3 | **1 failed** | 3.5 s |"), std::string::npos) << text;
  EXPECT_NE(text.find("1 case, 3 checks, 1 of them"), std::string::npos) << text;
  EXPECT_NE(text.find("| budget.total.mass | ≤ 1e-11 | round-off | 0.001 | - | - | **FAIL** |"),
            std::string::npos)
      << text;
  EXPECT_NE(verify_csv(cases).find("plates,\"contact.a-b.opens\",us,value,0.7,0.707,"), std::string::npos)
      << verify_csv(cases);
  const auto j = nlohmann::json::parse(verify_json(cases));
  EXPECT_EQ(j["failures"], 1);
  EXPECT_NEAR(j["results"]["plates"]["values"]["contact.a-b.opens"]["value"].get<double>(), 0.707, 1e-9);
}

}  // namespace
}  // namespace recoil::app::verify_table_test
