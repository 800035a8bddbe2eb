#include "app/check/estimate.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/load_case.hpp"

namespace recoil::app::estimate_test {
namespace {

const std::string cases = std::string(RECOIL_SOURCE_DIR) + "/cases/";

double memory_of(const std::vector<std::string>& overrides) {
  const LoadedCase loaded = load_case(cases + "oblique_levels", overrides);
  EXPECT_FALSE(loaded.found.has_errors()) << loaded.found.text();
  return estimate(loaded.contents, loaded.materials, 6000).memory;
}

/// Measured: largest resident set of one process in 3-D (docs/changes/0043), while a field file is written.
TEST(Estimate, MemoryInSpaceIsThatOfARun) {
  EXPECT_NEAR(memory_of({"mesh.levels=1", "mesh.finest=0.2mm"}), 3.76e9, 0.1 * 3.76e9);
  EXPECT_NEAR(memory_of({"mesh.levels=1", "mesh.finest=0.4mm"}), 0.55e9, 0.1 * 0.55e9);
  EXPECT_NEAR(memory_of({"mesh.levels=1", "mesh.finest=0.4mm", R"(output.fields.variables=["pressure"])"}),
              0.49e9, 0.1 * 0.49e9);
}

}  // namespace
}  // namespace recoil::app::estimate_test
