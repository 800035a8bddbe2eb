#include "config/section/velocity_field.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "config/formula/formula.hpp"
#include "config/read_case.hpp"
#include "core/error.hpp"

namespace recoil::config::velocity_field_test {
namespace {

const std::vector<std::string> axes{"x", "y"};

TEST(Formulas, KnowCoordinatesUnitsAndFunctions) {
  EXPECT_DOUBLE_EQ(Formula("20*m/s * sin(pi*x/(60*mm))", axes).at({30e-3, 0, 0}), 20);
  EXPECT_DOUBLE_EQ(Formula("1.5*mm/us", axes).at({}), 1500);
  EXPECT_DOUBLE_EQ(Formula("x < y ? 2*km/s : cm/ms", axes).at({1, 2, 0}), 2000);
  EXPECT_DOUBLE_EQ(Formula("x < y ? 2*km/s : cm/ms", axes).at({2, 1, 0}), 10);
  EXPECT_DOUBLE_EQ(Formula("-(x^2)/m/s + 3*um/ns", axes).at({2, 0, 0}), -4 + 3000);
}

TEST(Formulas, AreVelocitiesOnlyWithUnits) {
  const std::vector<Vector> places{{0.3, 0.2, 0}, {0.1, -0.7, 0}};
  const auto is_velocity = [&](const char* text) {
    return Formula(text, axes).has_dimension(places, {1, -1, 0});
  };
  EXPECT_TRUE(is_velocity("m/s * exp(-(x^2 + y^2)/(5*mm)^2)"));
  EXPECT_TRUE(is_velocity("0"));
  EXPECT_TRUE(is_velocity("x/us"));
  EXPECT_FALSE(is_velocity("20"));
  EXPECT_FALSE(is_velocity("20*m/s * sin(x)"));
  EXPECT_FALSE(is_velocity("20*m/s + x"));
}

TEST(Formulas, CompareOnlyNumbersWithUnits) {
  const std::vector<Vector> places{{-1.4e-3, 0.2e-3, 0}, {-0.3e-3, 0.7e-3, 0}};
  const auto is_velocity = [&](const char* text) {
    return Formula(text, axes).has_dimension(places, {1, -1, 0});
  };
  EXPECT_TRUE(is_velocity("x > 20*mm ? 5*m/s : 0*m/s"));
  EXPECT_TRUE(is_velocity("min(x/mm, 20)*m/s"));
  EXPECT_TRUE(is_velocity("x < -0.5*mm && y > 0 ? x^8/(mm^8)*m/s : sqrt(y/us*m/s)"));
  EXPECT_FALSE(is_velocity("x > 20 ? 5*m/s : 0*m/s"));
  EXPECT_FALSE(is_velocity("x < 0.0005 ? 5*m/s : 0*m/s"));
  EXPECT_FALSE(is_velocity("y/us > 1000 ? 5*m/s : 0*m/s"));
  EXPECT_FALSE(is_velocity("min(x, 20)/us"));
}

TEST(Formulas, KnowPureNumbers) {
  EXPECT_TRUE(Formula("x/mm + us/s", axes).has_dimension({{1e-3, 0, 0}}, {}));
  EXPECT_FALSE(Formula("x", axes).has_dimension({{1e-3, 0, 0}}, {}));
}

TEST(Formulas, SayWhatIsWrong) {
  const auto fault = [](const char* text) -> std::string {
    try {
      Formula(text, axes);
      return "nothing";
    } catch (const InputError& e) {
      return e.what();
    }
  };
  EXPECT_EQ(fault("20*m/s * sinus(x/m)"), "knows no 'sinus'");
  EXPECT_EQ(fault("z/s"), "knows no 'z'");
  EXPECT_EQ(fault("20*m/"), "ends too early");
  EXPECT_EQ(fault("(x + y/s"), "lacks a parenthesis");
  EXPECT_EQ(fault("min()*m/s"), "gives a function a wrong number of values at character 6");
  EXPECT_EQ(fault("x = 3"), "assigns with '='");
  EXPECT_EQ(fault("x/s, y/s"), "holds a comma between two values");
  EXPECT_EQ(fault("20 m/s"), "lacks a '*' before 'm'");
  EXPECT_EQ(fault("5mm/us"), "lacks a '*' before 'mm'");
  EXPECT_EQ(fault("20*m/s sin(x/m)"), "lacks a '*' before 'sin'");
  EXPECT_EQ(fault("20*m/*s"), "cannot be read at character 6");
}

/// A case with this line in its body.
Diagnostics said_of(const std::string& line) {
  const std::string text = R"(format = 1
[domain]
geometry = "planar"
x = ["0 mm", "80 mm"]
y = ["0 mm", "20 mm"]
[mesh]
finest = "0.5 mm"
[time]
end = "10 us"
[body.plate]
shape = { kind = "box", x = ["0 mm", "2 mm"], y = ["0 mm", "9 mm"] }
)" + line + "\n";
  Diagnostics out;
  const Document doc = parse_document(text, "case.toml", out);
  read_case(doc, out);
  return out;
}

struct Mistake {
  const char *line, *message;
};
void PrintTo(const Mistake& m, std::ostream* out) { *out << m.line; }

class FieldMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(FieldMistakes, AreSaidWhereTheyStand) {
  const Diagnostics out = said_of(GetParam().line);
  ASSERT_EQ(out.error_count(), 1) << out.text();
  EXPECT_NE(out.list().front().message.find(GetParam().message), std::string::npos) << out.text();
  EXPECT_EQ(out.list().front().place.line, 13) << out.text();
  EXPECT_FALSE(out.list().front().help.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Case, FieldMistakes,
    testing::Values(Mistake{"material = \"m\"\nvelocity-field = { x = \"20*m/s * sinus(y)\" }",
                            "knows no 'sinus'"},
                    Mistake{"material = \"m\"\nvelocity-field = { x = \"20\" }", "is no velocity"},
                    Mistake{"material = \"m\"\nvelocity-field = { x = \"m/s * sin(cos(y/mm)*x)\" }",
                            "sin needs a pure number"},
                    Mistake{"material = \"m\"\nvelocity-field = { z = \"m/s\" }", "'z'"},
                    Mistake{"material = \"m\"\nvelocity-field = { }", "has no formula"},
                    Mistake{"rigid = true\nvelocity-field = { x = \"m/s\" }", "cannot bend"}));

TEST(VelocityFields, SayHowToWriteThem) {
  const auto help = [](const std::string& formula) {
    const Diagnostics out = said_of("material = \"m\"\nvelocity-field = { x = \"" + formula + "\" }");
    return out.list().empty() ? "" : out.list().front().help;
  };
  EXPECT_NE(help("pow(x/mm, 2)*m/s").find("functions sin, cos"), std::string::npos) << help("pow(x)");
  EXPECT_NE(help("x > 20 ? 5*m/s : 0*m/s").find("comparisons: x > 20*mm"), std::string::npos);
  EXPECT_NE(help("m/s*exp(x)").find("exp(x/mm)"), std::string::npos);
}

TEST(VelocityFields, AreEvaluated) {
  const Diagnostics said = said_of("material = \"m\"\nvelocity-field = { y = \"x/s\" }");
  EXPECT_EQ(said.error_count(), 0) << said.text();
  VelocityField field;
  field.y = "x/s";
  EXPECT_EQ(evaluated(field, Geometry::planar)({3, 4, 0}), (Vector{0, 3, 0}));
  EXPECT_EQ(fastest_in(field, Geometry::planar, {-5, 0, 0}, {2, 1, 0}), 5);
  EXPECT_EQ(fastest_in({}, Geometry::planar, {-5, 0, 0}, {2, 1, 0}), 0);
}

}  // namespace
}  // namespace recoil::config::velocity_field_test
