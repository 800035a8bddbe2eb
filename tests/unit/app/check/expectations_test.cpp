#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "../../support/scratch_folder.hpp"
#include "app/load_case.hpp"
#include "config/units.hpp"
#include "record/findings.hpp"

namespace recoil::app::expectations_test {
namespace {

constexpr const char* plates = R"(
[domain]
geometry = "1d"
x = ["-4 mm", "18 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "6 us"
[body.flyer]
material = "aluminium/6061-t6"
shape = { kind = "box", x = ["-2 mm", "0 mm"] }
velocity = { x = "450 m/s" }
[body.target]
material = "copper/ofhc-johnson-cook"
shape = { kind = "box", x = ["0 mm", "15 mm"] }
[gauge.rear]
kind = "surface-velocity"
body = "target"
at = { x = "15 mm" }
[gauge.inside]
kind = "point"
body = "target"
at = { x = "5 mm" }
[gauge.line]
kind = "peak-stress"
body = "target"
at = { x = "1 mm" }
to = { x = "9 mm" }
[gauge.touch]
kind = "contact"
pair = "flyer-target"
[expect]
)";

/// What check_logic() says of the plates with an expectation, of the lines behind [expect].
std::string said_of(const std::string& expectation) {
  const ScratchFolder folder;
  std::ofstream(folder / "plates.toml") << plates << expectation << '\n';
  LoadedCase loaded = load_case((folder / "plates.toml").string(), {});
  if (!loaded.found.has_errors()) check_logic(loaded);
  return loaded.found.has_errors() ? loaded.found.text() : "";
}

TEST(Expectations, AreOfTheDimensionOfTheirResult) {
  for (const char* good :
       {R"("contact.flyer-target.opens" = { value = "0.7 us", within = "1 %" })",
        R"("contact.target-flyer.made" = { at-least = 0 })",
        R"("body.flyer.kinetic" = { at-most = "9 MJ/m2" })",
        R"("body.flyer.velocity" = { at-most = "1 km/s" })",
        R"("body.flyer.lowest.x" = { at-most = "1 km" })",
        R"x("body.total.momentum.x" = { at-least = "1 kg/(m s)" })x",
        R"("budget.total.energy" = { at-most = "1 %" })", R"("run.steps" = { at-most = 1000 })",
        R"("failure.target.x" = { at-most = "1 mm" })",
        R"("fragments.target.1.velocity" = { at-most = "1 m/s" })",
        R"("fragments.target.1.mass" = { at-most = "1 kg/m2" })", R"("event.ricochet" = false)",
        R"("gauge.rear.velocity.arrival@1m/s" = { at-most = "4 us" })",
        R"x("gauge.rear.velocity.slope@1us..2us" = { at-most = "1 m/(s us)" })x",
        R"("gauge.touch.work.max" = { at-most = "1 J/m2" })", R"("gauge.touch.area.max" = { at-most = 1 })",
        R"("gauge.line.stress@2mm" = { at-most = "9 GPa" })"})
    EXPECT_EQ(said_of(good), "") << good;
  for (const auto& [bad, text] :
       {std::pair(R"("contact.flyer-target.opens" = { value = "0.7 um", within = "1 %" })",
                  "'contact.flyer-target.opens' is of [time], but the expected value is of [length]"),
        std::pair(R"("contact.target-flyer.opens" = { at-most = "1 um" })", "give it in us"),
        std::pair(R"("body.flyer.velocity.x" = { value = "-150.5 s", within = "60 %" })", "is of [velocity]"),
        std::pair(R"("body.flyer.velocity" = { at-most = 3 })", "is a bare number"),
        std::pair(R"("body.flyer.kinetic" = { at-most = "1e9 kg" })", "give it in J/m2"),
        std::pair(R"("body.flyer.kinetic" = { at-most = "1e9 J" })", "give it in J/m2"),
        std::pair(R"("fragments.target.1.mass" = { at-most = "1 kg" })", "give it in kg/m2"),
        std::pair(R"("budget.total.energy" = { at-most = "1 mm" })", "is a pure number"),
        std::pair(R"("run.steps" = { at-most = "1000 us" })", "give a number without a unit"),
        std::pair(R"("gauge.touch.work.max" = { at-most = "1 J" })", "give it in J/m2"),
        std::pair(R"("gauge.rear.velocity.arrival@1m/s" = { at-most = "1 m/s" })", "is of [time]"),
        std::pair(R"("gauge.rear.velocity.slope@1us..2us" = { at-most = "1 m/s" })",
                  "is of [acceleration]")}) {
    const std::string said = said_of(bad);
    EXPECT_NE(said.find(text), std::string::npos) << bad << '\n' << said;
    EXPECT_NE(said.find("plates.toml:33:1"), std::string::npos) << said;
  }
}

TEST(Expectations, NameWhatARunCanTell) {
  for (const auto& [bad, text] :
       {std::pair(R"("event.nonsense" = true)", "known are: event.contact"),
        std::pair(R"("event.ricochets" = true)", "did you mean 'event.ricochet'?"),
        std::pair(R"("event.ricochet" = { at-most = 1 })", "is true or false, not a number"),
        std::pair(R"("floor.nonsense" = { at-most = 1 })", "known are: floor."),
        std::pair(R"("run.nonsense" = { at-most = 1 })", "known are: run.steps"),
        std::pair(R"("budget.nobody.mass" = { at-most = 1 })", "did you mean 'budget.total.mass'?"),
        std::pair(R"("body.flyer.nonsense" = { at-most = 1 })", "no run of this case has such a result"),
        std::pair(R"("body.flyer.velocity.y" = { at-most = "1 m/s" })",
                  "did you mean 'body.flyer.velocity.x'?"),
        std::pair(R"("failure.target.time" = false)", "is a number, not true or false"),
        std::pair(R"("gauge.rear.velocity.mean@2us..1us" = { at-most = "1 m/s" })",
                  "the span of time is empty"),
        std::pair(R"("gauge.rear.velocity.mean@1mm" = { at-most = "1 m/s" })", "is not a span of time"),
        std::pair(R"("gauge.rear.velocity.arrival@1GPa" = { at-most = "1 us" })", "needs [velocity]"),
        std::pair(R"("gauge.line.stress@2us" = { at-most = "9 GPa" })", "needs [length]"),
        std::pair(R"("gauge.inside.position.x.max" = { at-most = "1 mm" })", "has no column 'position.x'"),
        std::pair(R"("gauge.inside.velocity.y.max" = { at-most = "1 m/s" })", "has no column 'velocity.y'"),
        std::pair(R"("gauge.touch.force.along.max" = { at-most = "1 GPa" })",
                  "has no column 'force.along'")}) {
    const std::string said = said_of(bad);
    EXPECT_NE(said.find(text), std::string::npos) << bad << '\n' << said;
    EXPECT_NE(said.find("plates.toml:33:1"), std::string::npos) << said;
  }
}

/// Sums are per area in 1d, per depth in the plane, whole in the others.
TEST(Expectations, SumsHaveTheUnitsOfTheGeometry) {
  config::Case c;
  c.bodies.resize(1);
  c.bodies[0].name = "body";
  const auto unit = [&](config::Geometry geometry, const char* quantity) {
    c.domain.geometry = geometry;
    return unit_of(known_quantities(c), quantity);
  };
  EXPECT_EQ(unit(config::Geometry::line, "body.body.kinetic"), "J/m2");
  EXPECT_EQ(unit(config::Geometry::planar, "body.body.kinetic"), "J/m");
  EXPECT_EQ(unit(config::Geometry::axisymmetric, "body.body.kinetic"), "J");
  EXPECT_EQ(unit(config::Geometry::space, "body.total.angular-momentum.z"), "kg m2/s");
  EXPECT_EQ(unit(config::Geometry::planar, "body.body.volume"), "m2");
  EXPECT_EQ(unit(config::Geometry::space, "fragments.body.rubble-mass"), "kg");
}

TEST(Expectations, EveryKnownNumberHasAUnitThatTheProgramKnows) {
  const ScratchFolder folder;
  std::ofstream(folder / "plates.toml") << plates;
  const Quantities known = known_quantities(load_case((folder / "plates.toml").string(), {}).contents);
  EXPECT_GT(known.numbers.size(), 100U);
  for (const auto& [name, value] : known.numbers) {
    ASSERT_TRUE(known.units.contains(name)) << name;
    EXPECT_NO_THROW(config::dimension_name(known.units.at(name))) << name;
  }
}

}  // namespace
}  // namespace recoil::app::expectations_test
