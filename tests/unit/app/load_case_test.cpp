#include "app/load_case.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace recoil::app::load_case_test {
namespace {

const std::string flyer = std::string(RECOIL_SOURCE_DIR) + "/cases/flyer_al_cu";

/// All that is said about the flyer-plate case with these changes.
std::string messages(const std::vector<std::string>& overrides) {
  LoadedCase loaded = load_case(flyer, overrides);
  if (!loaded.found.has_errors()) check_logic(loaded);
  return loaded.found.text();
}

TEST(LoadCase, FindsFilesFoldersAndNames) {
  EXPECT_EQ(find_case_file(flyer), std::filesystem::path(flyer) / "case.toml");
  EXPECT_EQ(find_case_file(flyer + "/case.toml"), std::filesystem::path(flyer) / "case.toml");
  EXPECT_EQ(short_name(flyer + "/case.toml"), "flyer_al_cu");
  EXPECT_EQ(short_name("here/mine.toml"), "mine");
  EXPECT_THROW(find_case_file("no_such_case"), InputError);
}

TEST(LoadCase, TakesExpectedTomlAlong) {
  const LoadedCase loaded = load_case(flyer, {});
  EXPECT_GE(loaded.contents.expect.size(), 10U);
  EXPECT_EQ(loaded.materials.size(), 2U);
}

TEST(CheckLogic, TheShippedCaseIsCleanButForItsDoubtfulCopper) {
  const std::string text = messages({});
  EXPECT_EQ(text.find("warning: material 'copper/seed' is in doubt"), 0U) << text;
  EXPECT_EQ(text.find("warning", 1), std::string::npos) << text;
  EXPECT_EQ(text.find("error"), std::string::npos) << text;
}

TEST(CheckLogic, ThinBodyGetsACure) {
  const std::string text = messages({"mesh.finest=0.5 mm"});
  EXPECT_NE(text.find("'flyer' is 4 cells thick; about 20 are needed"), std::string::npos) << text;
  EXPECT_NE(text.find("finest = \"0.1 mm\" gives 20"), std::string::npos) << text;
}

TEST(CheckLogic, ThinRigidBodyAskewToTheMeshIsAWarning) {
  const auto thin = [](const std::string& rotation) {
    LoadedCase loaded = load_case(std::string(RECOIL_SOURCE_DIR) + "/cases/friction_wedge",
                                  {"body.wedge.shape={ kind = \"rectangle\", x = [\"-4 mm\", \"4 "
                                   "mm\"], y = [\"-0.3 mm\", \"-0.2 mm\"], "
                                   "rotation = \"" +
                                   rotation + "\" }"});
    check_logic(loaded);
    return loaded.found.text();
  };
  EXPECT_NE(thin("20 deg").find("rigid body 'wedge' is 1 cells thick"), std::string::npos) << thin("20 deg");
  EXPECT_EQ(thin("0 deg").find("rigid body"), std::string::npos) << thin("0 deg");
}

TEST(CheckLogic, GaugeOffTheSurface) {
  const std::string text = messages({"gauge.rear.at.x=14 mm"});
  EXPECT_NE(text.find("gauge 'rear' is not on the surface of 'target' but 1 mm below it"), std::string::npos)
      << text;
}

TEST(CheckLogic, OverlapAndAbsence) {
  EXPECT_NE(messages({"body.flyer.shape.x=[\"-2 mm\", \"1 mm\"]"}).find("overlap"), std::string::npos);
  EXPECT_NE(
      messages({"body.flyer.shape.x=[\"-22 mm\", \"-20 mm\"]"}).find("nothing of 'flyer' lies in the domain"),
      std::string::npos);
}

TEST(CheckLogic, DoubtfulMaterialIsAWarning) {
  LoadedCase loaded = load_case(flyer, {});
  loaded.materials[1].thermal.specific_heat *= 4;
  check_logic(loaded);
  EXPECT_FALSE(loaded.found.has_errors());
  EXPECT_NE(loaded.found.text().find("material 'copper/seed'"), std::string::npos);
}

}  // namespace
}  // namespace recoil::app::load_case_test
