#include "record/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../support/scratch_folder.hpp"

namespace recoil::summary_test {
namespace {

nlohmann::json read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

TEST(Summary, SaysWhatScriptsRelyOn) {
  const ScratchFolder folder;
  Summary s;
  s.version = "1";
  s.case_name = "plates";
  s.exit = 5;
  s.passed = false;
  s.steps = 12, s.cells = 340, s.cell_steps = 4e3, s.wall_s = 2, s.cpu_s = 3, s.rate = 6;
  s.budgets = {{"total", 1e-15, 2e-15, 3e-15}};
  s.gauges = {{"rear", "stress.xx", "GPa", 1e-9, {-5e9, 3e-6}, NAN}};
  s.events = {{0.7e-6, "opening", "a-b", {0.001}, "apart"}};
  s.floors = {{"lone-fragments-moved", 3}};
  config::Expectation e;
  e.quantity = "contact.a-b.opens";
  e.value = 0.7e-6, e.tolerance = 0.01e-6, e.unit = "us", e.source = "theory";
  s.expect = {{e, {0.72e-6, false, false, ""}, false}};
  s.verdict = {Verdict::Kind::doubtful,
               {{"averaged-states", "a", "0.4 % replaced", 4e-3, 1e-5, 1e-6, NAN, {0.001}}},
               {"not this"},
               {"nor that"}};
  write_summary(folder / "summary.json", s);
  const auto j = read_json(folder / "summary.json");
  EXPECT_EQ(j["remarks"][0], "nor that");
  EXPECT_EQ(j["case"], "plates");
  EXPECT_EQ(j["exit"], 5);
  EXPECT_EQ(j["verdict"], "doubtful");
  EXPECT_EQ(j["not_judged"][0], "not this");
  const auto& reason = j["reasons"].at(0);
  EXPECT_EQ(reason["what"], "averaged-states");
  EXPECT_EQ(reason["body"], "a");
  EXPECT_EQ(reason["limit"], 1e-5);
  EXPECT_NEAR(reason["first_us"].get<double>(), 1, 1e-12);
  EXPECT_TRUE(reason["last_us"].is_null());
  EXPECT_EQ(reason["place_mm"], nlohmann::json::array({1.0}));
  EXPECT_EQ(j["steps"], 12);
  EXPECT_EQ(j["cells"], 340);
  EXPECT_EQ(j["cell_steps"], 4000);
  EXPECT_EQ(j["cpu_s"], 3);
  EXPECT_EQ(j["rate_mcell_stage_per_s"], 6);
  EXPECT_EQ(j["budgets"]["total"]["energy"], 3e-15);
  EXPECT_NEAR(j["gauges"]["rear"]["peak"].get<double>(), -5, 1e-12);
  EXPECT_TRUE(j["gauges"]["rear"]["arrival_us"].is_null()) << "JSON knows no NaN";
  EXPECT_EQ(j["events"][0]["event"], "opening");
  EXPECT_EQ(j["floors"]["lone-fragments-moved"], 3);
  const auto& check = j["expect"]["contact.a-b.opens"];
  EXPECT_NEAR(check["value"].get<double>(), 0.72, 1e-12);
  EXPECT_NEAR(check["reference"].get<double>(), 0.7, 1e-12);
  EXPECT_NEAR(check["tolerance"].get<double>(), 0.01, 1e-12);
  EXPECT_EQ(check["unit"], "us");
  EXPECT_EQ(check["pass"], false);
}

TEST(Summary, Status) {
  const ScratchFolder folder;
  write_status(folder / "status.json", {"running", 1e-6, 4e-6, 5e-9, 200, 3, 9, {{"total", 0, 0, 0}}});
  const auto j = read_json(folder / "status.json");
  EXPECT_EQ(j["state"], "running");
  EXPECT_NEAR(j["dt_ns"].get<double>(), 5, 1e-12);
  EXPECT_EQ(j["left_s"], 9);
  EXPECT_TRUE(j["budgets"].contains("total"));
}

}  // namespace
}  // namespace recoil::summary_test
