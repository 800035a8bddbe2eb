#include "config/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"

namespace recoil::config::units_test {
namespace {

double si(const char* text, const char* unit) {
  const Quantity q = parse_quantity(text, unit, "key");
  EXPECT_TRUE(q.ok()) << text << ": " << q.problem;
  return q.value;
}

TEST(Units, ConvertsToSi) {
  EXPECT_EQ(si("0.05 mm", "m"), 0.05e-3);  // the very same double
  EXPECT_EQ(si("50 um", "m"), si("0.05 mm", "m"));
  EXPECT_EQ(si("-1.5E+2 mm", "m"), -0.15);
  EXPECT_EQ(si("-8mm", "m"), -8e-3);
  EXPECT_EQ(si("10 us", "s"), 10e-6);
  EXPECT_EQ(si("10 \xC2\xB5s", "s"), 10e-6);
  EXPECT_EQ(si("5 km/s", "m/s"), 5000);
  EXPECT_DOUBLE_EQ(si("5.328 mm/us", "m/s"), 5328);
  EXPECT_EQ(si("124 GPa", "Pa"), 124e9);
  EXPECT_DOUBLE_EQ(si("1.2 Mbar", "Pa"), 120e9);
  EXPECT_DOUBLE_EQ(si("8.93 g/cm3", "kg/m3"), 8930);
  EXPECT_EQ(si("383.5 J/(kg K)", "J/(kg K)"), 383.5);
  EXPECT_DOUBLE_EQ(si("10 deg", "rad"), 10 * std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(si("60 rpm", "rad/s"), 2 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(si("25 degC", "K"), 298.15);
  EXPECT_EQ(si("+1e3 1/s", "1/s"), 1000);
  EXPECT_EQ(si("0.5", ""), 0.5);
  EXPECT_EQ(si("3 %", "1"), 0.03);
}

void expect_problem(const char* text, const char* unit, const char* problem, const char* help) {
  const Quantity q = parse_quantity(text, unit, "finest");
  EXPECT_NE(q.problem.find(problem), std::string::npos) << text << ": " << q.problem;
  EXPECT_NE(q.help.find(help), std::string::npos) << text << ": " << q.help;
}

TEST(Units, RefusesWhatIsNoQuantityOfItsDimension) {
  expect_problem("2 us", "m", "'2 us' has dimension [time], but 'finest' needs [length]", "mm");
  expect_problem("5", "m", "has no unit", "0.5 mm");
  expect_problem("mm", "m", "is not a quantity", "0.5 mm");
  expect_problem("", "m", "is not a quantity", "");
  expect_problem("nan mm", "m", "must be finite", "0.5 mm");
  expect_problem("inf mm", "m", "must be finite", "0.5 mm");
  expect_problem("1e999 mm", "m", "must be finite", "0.5 mm");
  expect_problem("1e307 km", "m", "beyond the range of numbers", "0.5 mm");
  expect_problem("5 mps", "m/s", "unknown unit 'mps'", "did you mean 'm/s'?");
  expect_problem("5 kms", "m/s", "unknown unit 'kms'", "did you mean 'km/s'?");
  expect_problem("5 kph", "m/s", "unknown unit 'kph'", "did you mean 'km/h'?");
  expect_problem("0,05 mm", "m", "decimal comma", "point");
  expect_problem("5 mm 3", "m", "unknown unit", "");
  expect_problem("5 m @ 3", "m", "unknown unit", "");
  expect_problem("5 Gpa", "Pa", "unknown unit 'Gpa'", "did you mean 'GPa'?");
  expect_problem("5 kmm/s", "m/s", "unknown unit", "km/s");
  expect_problem("5 J/kg K", "J/(kg K)", "has dimension", "J/(kg K)");
  expect_problem("500 C", "K", "has dimension", "C is the coulomb; did you mean 'degC'?");
  expect_problem("500 F", "K", "has dimension", "'degF'");
}

TEST(Units, AnglesAreNotPureNumbers) {
  expect_problem("100 Hz", "rad/s", "[rate]", "");
  expect_problem("3 %", "rad", "[none]", "deg");
  expect_problem("3 deg", "1", "[angle]", "");
}

TEST(Units, ReadsAnyDimension) {
  const Quantity q = parse_any_quantity("0.695 us", "value");
  EXPECT_EQ(q.value, 0.695e-6);
  EXPECT_EQ(q.unit, "us");
  EXPECT_EQ(parse_any_quantity("5", "value").value, 5);
  EXPECT_FALSE(parse_any_quantity("5 foo", "value").ok());
  EXPECT_FALSE(parse_any_quantity("5 m7", "value").ok());
}

TEST(Units, PrintsInAUnit) {
  EXPECT_EQ(format_quantity(5.0838e9, "GPa", 4), "5.084 GPa");
  EXPECT_EQ(format_quantity(0.5, "1"), "0.5");
  EXPECT_DOUBLE_EQ(in_unit(298.15, "degC"), 25);
  EXPECT_DOUBLE_EQ(unit_size("degC"), 1);
  EXPECT_DOUBLE_EQ(unit_size("mm"), 1e-3);
  EXPECT_EQ(si_unit_of("mm/us"), "m/s");
  EXPECT_EQ(dimension_name("g/cc"), "density");
  EXPECT_THROW(in_unit(1, "foo"), InputError);
}

TEST(Units, OnlyZeroNeedsNoneToBeCompared) {
  EXPECT_TRUE(is_comparable(1, "us", "s"));
  EXPECT_TRUE(is_comparable(1, "%", "1"));
  EXPECT_TRUE(is_comparable(1, "", "1"));
  EXPECT_TRUE(is_comparable(0, "", "GPa"));
  EXPECT_FALSE(is_comparable(1, "", "GPa"));
  EXPECT_FALSE(is_comparable(1, "um", "us"));
  EXPECT_FALSE(is_comparable(0, "um", "us"));
  EXPECT_FALSE(is_comparable(1, "J", "J/m2"));
}

TEST(Units, RoundTrips) {
  for (const char* unit : {"mm", "us", "km/s", "GPa", "g/cm3", "deg", "degC", "J/(kg K)", "%",
                           // sums of a planar run and of a 1d one, per metre of depth and per area
                           "kg/m", "kg/s", "kN/m", "J/m", "kg/m2", "kg/(m s)", "N/m2", "J/m2", "kg m2/s"}) {
    const Quantity q = parse_any_quantity("0.37 " + std::string(unit), "value");
    ASSERT_TRUE(q.ok()) << unit;
    EXPECT_NEAR(in_unit(q.value, unit), 0.37, 1e-13) << unit;
  }
}

}  // namespace
}  // namespace recoil::config::units_test
