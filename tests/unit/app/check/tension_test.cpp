#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/check/checks.hpp"
#include "app/load_case.hpp"
#include "core/error.hpp"

namespace recoil::app {
namespace {

const std::string cases = RECOIL_SOURCE_DIR "/cases/";

std::string told(const std::vector<std::string>& overrides) {
  LoadedCase loaded = load_case(cases + "flyer_al_cu", overrides);
  EXPECT_FALSE(loaded.found.has_errors()) << loaded.found.text();
  const std::string before = loaded.found.text();
  check_tension(loaded);
  return loaded.found.text().substr(before.size());
}

const std::string ofhc = "body.target.material=copper/ofhc-johnson-cook";

// 5.1 GPa of compression come back as tension where the releases meet, 5.6 us after the impact.
TEST(CheckTension, ReleasesThatPullHarderThanAMaterialBearsAreTold) {
  EXPECT_EQ(told({ofhc, "time.end=4us"}), "") << "they have not met";
  const std::string text = told({ofhc, "time.end=6us"});
  EXPECT_NE(text.find("will pull 'target' with some 5."), std::string::npos) << text;
  EXPECT_NE(text.find("1.5 GPa"), std::string::npos) << text;
  EXPECT_EQ(text.find("'flyer'"), std::string::npos) << text;
}

TEST(CheckTension, ATargetThatBearsItOrCanBreakIsNot) {
  EXPECT_EQ(told({ofhc, "time.end=6us", "limits.spall-strength=10"}), "");
  EXPECT_EQ(told({"body.target.material=breaking", "time.end=6us",
                  "material.breaking={ base = \"copper/ofhc-johnson-cook\", damage = { kind = \"tensile\", "
                  "threshold = \"1.5 GPa\", time = \"0.02 us\" } }"}),
            "");
}

}  // namespace
}  // namespace recoil::app
