#include "app/run/crash.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "../../support/scratch_folder.hpp"
#include "../../support/small_case.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"
#include "record/field_dump.hpp"

namespace recoil::app::crash_test {
namespace {

const char* two_blocks = R"(
format = 1
[domain]
geometry = "planar"
x = ["-4 mm", "4 mm"]
y = ["0 mm", "8 mm"]
[mesh]
finest = "0.25 mm"
[time]
end = "1 us"
[body.low]
material = "none"
shape = { kind = "box", x = ["-2 mm", "2 mm"], y = ["1 mm", "4 mm"] }
[body.high]
material = "none"
shape = { kind = "box", x = ["-2 mm", "2 mm"], y = ["4 mm", "7 mm"] }
velocity = { y = "-100 m/s" }
)";

TEST(Crash, TellsTheStatesAroundThePlace) {
  const ScratchFolder run;
  const config::Case c = case_from(two_blocks);
  const State<2> state = state_of<2>(c);
  const Failure failure{"too dense", "high", {0, 4.05e-3}, 1e-9};
  write_crash<2>(
      run.path(), c, state, failure, [&] { return own_fields(state, field_variables()); }, 3);
  const std::string text = text_of(run / "crash/process_3.txt");
  for (const char* part :
       {"too dense\n", "body high\n", "place (0, 4.05) mm\n", "last dt 1 ns, process 3",
        "states of low around\n", "states of high around\n", "(0, -100) m/s", "recoil run "})
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
  EXPECT_TRUE(std::filesystem::exists(run / "crash/process_3.hdf"));
  EXPECT_NE(text.find("no picture: "), std::string::npos);  // there is no case.resolved.toml
}

TEST(Crash, IsToldWhereTheFieldsCannotBeMade) {
  const ScratchFolder run;
  const config::Case c = case_from(two_blocks);
  const State<2> state = state_of<2>(c);
  const auto fails = []() -> UnstructuredGrid { throw InternalError("no fields"); };
  write_crash<2>(run.path(), c, state, {"too dense", "", {}, 0}, fails, 0);
  const std::string text = text_of(run / "crash/process_0.txt");
  EXPECT_EQ(text.find("too dense"), 0U);
  EXPECT_NE(text.find("no picture: no fields"), std::string::npos);
}

}  // namespace
}  // namespace recoil::app::crash_test
