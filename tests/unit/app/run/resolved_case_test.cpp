#include "app/run/resolved_case.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "../../support/scratch_folder.hpp"

namespace recoil::app::resolved_case_test {
namespace {

/// Without the remarks on where values come from.
std::string bare(const std::string& text) { return std::regex_replace(text, std::regex(" *#[^\n]*"), ""); }

std::string written(const ScratchFolder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder / name) << text;
  return (folder / name).string();
}

/// A resolved case, read again and resolved again, is the same.
void expect_same_again(const std::string& file) {
  const LoadedCase first = load_case(file, {});
  ASSERT_FALSE(first.found.has_errors()) << first.found.text();
  const std::string text = resolved_text(first);
  const ScratchFolder folder;
  const LoadedCase second = load_case(written(folder, "again.toml", text), {});
  ASSERT_FALSE(second.found.has_errors()) << second.found.text() << text;
  EXPECT_EQ(bare(resolved_text(second)), bare(text));
}

TEST(ResolvedCase, ShippedCasesReadBack) {
  for (const auto& entry : std::filesystem::directory_iterator(std::string(RECOIL_SOURCE_DIR) + "/cases"))
    if (std::filesystem::exists(entry.path() / "case.toml")) {
      SCOPED_TRACE(entry.path().string());
      expect_same_again(entry.path().string());
    }
}

constexpr const char* planar_case = R"(
title = "every \"planar\" shape"
[domain]
geometry = "planar"
x = ["0 mm", "20 mm"]
y = ["0 mm", "20 mm"]
boundary = { x = "periodic", y = ["symmetry", "outflow"] }
[mesh]
finest = "0.1 mm"
offset = 0
[time]
end = "1 us"
fixed-dt = "1 ns"
[body.a]
material = "copper/seed"
shape = { kind = "box", x = ["1 mm", "2 mm"], y = ["1 mm", "3 mm"], rotation = "30 deg" }
velocity = { speed = "1 km/s", angle = "-10 deg" }
spin = "1000 rad/s"
spin-centre = { x = "1 mm", y = "2 mm" }
[body.b]
material = "copper/seed"
shape = { kind = "polygon", vertices = [["5 mm", "5 mm"], ["8 mm", "5 mm"], ["5 mm", "8 mm"]] }
[body.c]
rigid = true
shape = { kind = "difference", parts = [{ kind = "disc", radius = "2 mm", centre = { x = "15 mm", y = "15 mm" } }, { kind = "half-space", point = { x = "15 mm" }, normal = { x = 1, y = 1 } }] }
[gauge.g]
kind = "point"
body = "b"
at = { x = "6 mm", y = "6 mm" }
every = "10 ns"
[gauge.touch]
kind = "contact"
pair = "c-b"
at = { x = "7 mm", y = "7 mm" }
radius = "2 mm"
direction = { x = 3, y = -4 }
[expect]
"gauge.g.pressure.peak" = { at-most = "1 GPa", source = "nowhere" }
)";

TEST(ResolvedCase, EveryPlanarShapeReadsBack) {
  const ScratchFolder folder;
  expect_same_again(written(folder, "planar.toml", planar_case));
}

TEST(ResolvedCase, TextsMayHoldAnyCharacter) {
  const ScratchFolder folder;
  std::string text = planar_case;
  const std::string title = R"(every \"planar\" shape)";
  text.replace(text.find(title), title.size(),
               R"(\\ \" \n \r \t \b \f \u0001 \u0007 \u001B[31m \u007F \u00e4)");
  const std::string file = written(folder, "control.toml", text);
  const LoadedCase loaded = load_case(file, {});
  EXPECT_EQ(loaded.contents.title, "\\ \" \n \r \t \b \f \x01 \a \x1B[31m \x7F \u00e4");
  const LoadedCase again = load_case(written(folder, "resolved.toml", resolved_text(loaded)), {});
  EXPECT_EQ(again.contents.title, loaded.contents.title);
}

constexpr const char* space_case = R"(
[domain]
geometry = "3d"
x = ["0 mm", "20 mm"]
y = ["0 mm", "20 mm"]
z = ["0 mm", "20 mm"]
[mesh]
finest = "1 mm"
[time]
end = "1 us"
[body.a]
material = "steel/hzb"
shape = { kind = "cylinder", radius = "3 mm", centre = { x = "10 mm", y = "10 mm" }, axis = { y = 1, z = 1 }, along = ["1 mm", "5 mm"] }
spin = { x = "1 rad/s" }
spin-centre = { x = "1 mm" }
[body.b]
material = "steel/hzb"
shape = { kind = "union", parts = [{ kind = "sphere", radius = "2 mm", centre = { x = "15 mm", y = "15 mm", z = "15 mm" } }] }
)";

TEST(ResolvedCase, ShapesInSpaceReadBack) {
  const ScratchFolder folder;
  expect_same_again(written(folder, "space.toml", space_case));
}

TEST(ResolvedCase, SaysWhereValuesComeFrom) {
  const LoadedCase loaded =
      load_case(std::string(RECOIL_SOURCE_DIR) + "/cases/flyer_al_cu", {"mesh.finest=0.1 mm"});
  const std::string text = resolved_text(loaded);
  EXPECT_NE(text.find("finest = \"0.0001 m\"  # --set"), std::string::npos);
  EXPECT_NE(text.find("cfl = 0.9  # default"), std::string::npos);
  EXPECT_NE(text.find("end = \"6e-06 s\"  # line "), std::string::npos);
}

TEST(ResolvedCase, SaysWhereATableHasBeenChangedInPart) {
  const LoadedCase loaded = load_case(std::string(RECOIL_SOURCE_DIR) + "/cases/flyer_al_cu",
                                      {"body.flyer.velocity.x=460m/s", "body.target.velocity.x=1m/s"});
  const std::string text = resolved_text(loaded);
  EXPECT_TRUE(std::regex_search(text, std::regex(R"(velocity = \{ x = "460 m/s" \}  # line \d+, --set)")))
      << text;
  EXPECT_NE(text.find("velocity = { x = \"1 m/s\" }  # --set\n"), std::string::npos) << text;
}

TEST(ResolvedCase, NamesTheChangesOfTheCommandLine) {
  const std::string file = std::string(RECOIL_SOURCE_DIR) + "/cases/flyer_al_cu";
  EXPECT_TRUE(changes_of(resolved_text(load_case(file, {}))).empty());
  const LoadedCase changed = load_case(file, {"time.end=1us", "mesh.finest = 0.1 mm", "time.end=2us"});
  const std::vector<std::string> last_of_each{"mesh.finest = 0.1 mm", "time.end=2us"};
  EXPECT_EQ(changes_of(resolved_text(changed)), last_of_each);
}

}  // namespace
}  // namespace recoil::app::resolved_case_test
