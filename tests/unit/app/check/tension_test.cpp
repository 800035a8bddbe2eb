#include <gtest/gtest.h>

#include <string>

#include "app/check/checks.hpp"
#include "app/load_case.hpp"
#include "material/damage/damage.hpp"

namespace recoil::app::tension_test {
namespace {

const std::string cases = RECOIL_SOURCE_DIR "/cases/";

/// What is said of aluminium on 6 mm of copper until `end`. @param damage of the target.
std::string told(const std::string& end, const std::string& limits = "limits.budget=1e-11",
                 const Damage& damage = NoDamage{}) {
  LoadedCase loaded = load_case(cases + "flyer_al_cu", {"body.target.material=copper/ofhc-johnson-cook",
                                                        "body.target.shape.x=[\"0 mm\", \"6 mm\"]",
                                                        "gauge.rear.at.x=6 mm", "time.end=" + end, limits});
  EXPECT_FALSE(loaded.found.has_errors()) << loaded.found.text();
  loaded.materials[1].damage = damage;
  const std::string before = loaded.found.text();
  check_tension(loaded);
  return loaded.found.text().substr(before.size());
}

// The releases meet 5 mm deep, 1.7 us after the impact, and what was 5.1 GPa of compression is tension.
TEST(CheckTension, ReleasesThatPullHarderThanAMaterialBearsAreTold) {
  EXPECT_EQ(told("1.5us"), "") << "they have not met";
  const std::string text = told("2us");
  EXPECT_NE(text.find("will pull 'target' with about 5."), std::string::npos) << text;
  EXPECT_NE(text.find("1.4 GPa"), std::string::npos) << text;
  EXPECT_EQ(text.find("'flyer'"), std::string::npos) << text;
}

TEST(CheckTension, ATargetThatBearsItOrCanBreakIsNot) {
  EXPECT_EQ(told("2us", "limits.spall-strength=10"), "");
  EXPECT_EQ(told("2us", "limits.budget=1e-11", MinimumPressure{1e9}), "");
}

}  // namespace
}  // namespace recoil::app::tension_test
