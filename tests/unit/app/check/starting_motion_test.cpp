#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "../../support/scratch_folder.hpp"
#include "app/load_case.hpp"

namespace recoil::app::starting_motion_test {
namespace {

constexpr const char* disc = R"(format = 1
[domain]
geometry = "axisymmetric"
r = ["0 mm", "6 mm"]
z = ["-4 mm", "4 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "1 us"
)";

constexpr const char* layer = R"(format = 1
[domain]
geometry = "1d"
x = ["-6 mm", "2 mm"]
[mesh]
finest = "0.03 mm"
[time]
end = "1 us"
[body.layer]
material = "copper/ofhc-johnson-cook"
shape = { kind = "box", x = ["-2 mm", "0 mm"] }
)";

/// All that check_logic() says of a case.
std::string said_of(const std::string& text) {
  const ScratchFolder folder;
  std::ofstream(folder / "case.toml") << text << '\n';
  LoadedCase loaded = load_case((folder / "case.toml").string(), {});
  if (!loaded.found.has_errors()) check_logic(loaded);
  return loaded.found.text();
}

std::string disc_with(const std::string& r, const std::string& velocity) {
  return said_of(std::string(disc) +
                 "[body.disc]\nmaterial = \"copper/ofhc-johnson-cook\"\nshape = { kind = \"box\", r = [" + r +
                 "], z = [\"-2 mm\", \"2 mm\"] }\n" + velocity);
}

bool holds(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(StartingMotion, AtRestHelpNamesTheLastAxis) {
  const std::string said = disc_with(R"("0 mm", "4 mm")", "");
  EXPECT_TRUE(holds(said, "nothing moves")) << said;
  EXPECT_TRUE(holds(said, "velocity = { z = \"450 m/s\" }")) << said;
}

TEST(StartingMotion, MatterAtTheAxisDoesNotMoveAlongR) {
  const char* along_r = "velocity = { r = \"100 m/s\" }";
  const std::string said = disc_with(R"("0 mm", "4 mm")", along_r);
  EXPECT_TRUE(holds(said, "'disc' reaches the axis")) << said;
  EXPECT_FALSE(holds(disc_with(R"("1 mm", "4 mm")", along_r), "reaches the axis"));
  EXPECT_FALSE(holds(disc_with(R"("0 mm", "4 mm")", "velocity = { z = \"100 m/s\" }"), "reaches the axis"));
}

TEST(StartingMotion, AFieldOfNothingIsAWarning) {
  const std::string with = std::string(layer) + "velocity = { x = \"10 m/s\" }\nvelocity-field = { x = ";
  const std::string said = said_of(with + "\"x > 1*mm ? 5*m/s : 0*m/s\" }");
  EXPECT_TRUE(holds(said, "the velocity-field of 'layer' is zero in the whole body")) << said;
  EXPECT_FALSE(holds(said_of(with + "\"x > -1*mm ? 5*m/s : 0*m/s\" }"), "is zero"));
}

/// Formulas that end where the body ends, which lies askew in the cells.
TEST(StartingMotion, AFieldIsNotAskedOutsideOfTheBody) {
  const std::string with = std::string(layer) + "velocity-field = { x = ";
  for (const char* formula : {"\"m/s*sqrt((x+2*mm)/mm)\" }", "\"m/s*sqrt(-x/mm)\" }"})
    EXPECT_FALSE(holds(said_of(with + formula), "error")) << said_of(with + formula);
  EXPECT_TRUE(holds(said_of(with + "\"m/s*sqrt(-1-x/mm)\" }"), "has no finite value at"));
}

TEST(StartingMotion, TimesBeyondTheEndAreNeverMet) {
  const std::string with = std::string(layer) + R"(velocity = { x = "10 m/s" }
[body.wall]
rigid = true
shape = { kind = "box", x = ["0 mm", "1 mm"] }
[expect]
"contact.layer-wall.opens" = )";
  const std::string said = said_of(with + R"({ value = "5 us", within = "3 %" })");
  EXPECT_TRUE(holds(said, "'contact.layer-wall.opens' cannot be met: the run ends at 1 us, before 4.85 us"))
      << said;
  EXPECT_TRUE(holds(said_of(with + R"({ at-least = "2 us" })"), "cannot be met"));
  EXPECT_FALSE(holds(said_of(with + R"({ at-most = "2 us" })"), "cannot be met"));
  EXPECT_FALSE(holds(said_of(with + R"({ value = "1.01 us", within = "3 %" })"), "cannot be met"));
}

}  // namespace
}  // namespace recoil::app::starting_motion_test
