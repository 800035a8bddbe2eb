#include "app/run/run_quantities.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "../../support/scratch_folder.hpp"
#include "app/run/run_folder.hpp"
#include "core/error.hpp"

namespace recoil::app::run_quantities_test {
namespace {

std::string said_of(const std::filesystem::path& run) {
  try {
    read_quantities(run, run);
    return "nothing";
  } catch (const InputError& e) {
    return e.what();
  }
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(RunQuantities, OfARunWithoutResultsSayWhy) {
  const ScratchFolder folder;
  EXPECT_TRUE(holds(said_of(folder.path()), "holds no finished run")) << said_of(folder.path());
  const auto stands = [&](const std::string& state) {
    std::ofstream(folder / "status.json")
        << R"({"state": ")" << state << R"(", "time_us": 4.69, "end_us": 10, "step": 7})";
    return said_of(folder.path());
  };
  EXPECT_TRUE(holds(stands("failed"), "stopped at 4.69 of 10 us (exit code 3)")) << stands("failed");
  EXPECT_TRUE(holds(stands("stopped"), "was stopped at 4.69 of 10 us")) << stands("stopped");
  EXPECT_TRUE(holds(stands("running"), "was interrupted at 4.69 of 10 us")) << stands("running");
  EXPECT_TRUE(holds(stands("finished"), "holds no quantities.csv")) << stands("finished");
  const RunLock lock(folder.path());
  EXPECT_TRUE(holds(stands("running"), "is still going, at 4.69 of 10 us")) << stands("running");
}

}  // namespace
}  // namespace recoil::app::run_quantities_test
