#include "record/quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "../support/scratch_folder.hpp"
#include "core/error.hpp"

namespace recoil::quantities_test {
namespace {

Quantities sample() {
  Quantities q;
  q.numbers = {{"contact.a-b.opens", 0.7e-6}, {"contact.a-c.opens", NAN}, {"budget.total.mass", 1e-14}};
  q.flags = {{"contact.a-b.opens", true}, {"contact.a-b.recloses", false}};
  q.gauges.push_back({"rear",
                      {{"velocity", "m/s"}, {"velocity.x", "m/s"}, {"stress.xx", "GPa", 1e-9}},
                      {0, 1e-6, 2e-6, 4e-6},
                      {{0, 100, 200, 200}, {0, 1, 2, 2}, {0, -2e9, 0, 0}}});
  return q;
}

double value(const std::string& name) { return measure(sample(), name).value; }

TEST(Quantities, OfGauges) {
  EXPECT_DOUBLE_EQ(value("gauge.rear.velocity@1.5us"), 150);
  EXPECT_DOUBLE_EQ(value("gauge.rear.velocity.at@1500 ns"), 150);
  EXPECT_DOUBLE_EQ(value("gauge.rear.velocity.x@1us"), 1);
  EXPECT_DOUBLE_EQ(value("gauge.rear.velocity.peak"), 200);
  EXPECT_DOUBLE_EQ(value("gauge.rear.stress.xx.peak"), -2e9);
  EXPECT_DOUBLE_EQ(value("gauge.rear.velocity.x.last"), 2);
  EXPECT_DOUBLE_EQ(value("gauge.rear.velocity.mean@1us..2us"), 150);
  EXPECT_NEAR(value("gauge.rear.velocity.rms@2us..4us"), 0, 1e-9);
  EXPECT_DOUBLE_EQ(value("gauge.rear.velocity.arrival@150m/s"), 1.5e-6);
  EXPECT_DOUBLE_EQ(value("gauge.rear.stress.xx.arrival@-1GPa"), 0.5e-6);
  EXPECT_DOUBLE_EQ(value("gauge.rear.stress.xx.until@-1GPa"), 1.5e-6) << "the last crossing";
  EXPECT_DOUBLE_EQ(value("gauge.rear.stress.xx.max"), 0) << "not the largest magnitude";
  EXPECT_DOUBLE_EQ(value("gauge.rear.stress.xx.min"), -2e9);
  EXPECT_DOUBLE_EQ(value("gauge.rear.velocity.max@0.5us..1.5us"), 150) << "between records, at the end";
  EXPECT_DOUBLE_EQ(value("gauge.rear.velocity.min@0.5us..1.5us"), 50);
  EXPECT_TRUE(std::isnan(value("gauge.rear.velocity.until@300m/s")));
  EXPECT_TRUE(std::isnan(value("gauge.rear.velocity.max@3us..5us"))) << "the record ends at 4 us";
}

TEST(Quantities, AgainstAReferenceCurve) {
  const ScratchFolder folder;
  std::ofstream(folder / "curve.csv") << "# from elsewhere\ntime [us],speed [km/s]\n1,0.11\n4,0.21\n";
  Quantities q = sample();
  q.folder = folder.path();
  // Reference 110 + 33.33 (t - 1): 143.3 at 2 us, 210 at 4 us; it crosses the level 200 at 3.7 us.
  const double d = measure(q, "gauge.rear.velocity.error@2us..3us:curve.csv:speed").value;
  EXPECT_NEAR(d, 200 - (143.3333333 + 176.6666667) / 2, 1e-4);
  q.gauges[0].values[0] = {10, 110, 143.3333333333333, 210};
  EXPECT_NEAR(measure(q, "gauge.rear.velocity.error@1us..4us:curve.csv:speed").value, 0, 1e-9);
  EXPECT_THROW(measure(q, "gauge.rear.velocity.error@2us..4us:none.csv:speed"), InputError);
  EXPECT_THROW(measure(q, "gauge.rear.velocity.error@2us..4us:curve.csv:sped"), InputError);
  EXPECT_THROW(measure(q, "gauge.rear.velocity.error@2us..4us"), InputError);
}

void expect_complaint(const std::string& name, const std::string& part) {
  try {
    measure(sample(), name);
    FAIL() << name << " was understood";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Quantities, ComplainAboutWhatCannotBe) {
  expect_complaint("gauge.raer.velocity.peak", "did you mean 'rear'");
  expect_complaint("gauge.rear.velosity.peak", "did you mean 'velocity'");
  expect_complaint("gauge.rear.velocity", "which value");
  expect_complaint("gauge.rear.velocity.mean", "needs an argument");
  expect_complaint("gauge.rear.velocity.peak@1us", "takes nothing");
  expect_complaint("gauge.rear.velocity.mean@1us", "is not a span");
  expect_complaint("gauge.rear.velocity@3mm", "time");
  expect_complaint("gauge.rear.velocity.max@3us", "is not a span");
  expect_complaint("gauge.rear.velocity.until", "needs an argument");
  expect_complaint("contact.a-b.open", "contact.a-b.opens");
  EXPECT_THROW(measure(sample(), "contact.a-b.reclose", true), InputError);
}

config::Expectation expected(const std::string& name, double v, double tolerance) {
  config::Expectation e;
  e.quantity = name;
  e.value = v;
  e.tolerance = tolerance;
  return e;
}

TEST(Quantities, Checks) {
  const Quantities q = sample();
  EXPECT_TRUE(check(q, expected("contact.a-b.opens", 0.71e-6, 0.02e-6)).pass);
  EXPECT_FALSE(check(q, expected("contact.a-b.opens", 0.71e-6, 0.005e-6)).pass);
  const CheckResult never = check(q, expected("contact.a-c.opens", 0, 1));
  EXPECT_FALSE(never.pass);
  EXPECT_EQ(never.measured.problem, "it did not happen");
  const CheckResult unknown = check(q, expected("contact.x-y.opens", 0, 1));
  EXPECT_FALSE(unknown.pass);
  EXPECT_FALSE(unknown.measured.problem.empty());

  config::Expectation most = expected("budget.total.mass", 1e-13, 0);
  most.at_most = true;
  EXPECT_TRUE(check(q, most).pass);
  most.at_most = false, most.at_least = true;
  EXPECT_FALSE(check(q, most).pass);

  config::Expectation flag = expected("contact.a-b.recloses", 0, 0);
  flag.is_flag = true;
  EXPECT_TRUE(check(q, flag).pass);
  flag.flag = true;
  EXPECT_FALSE(check(q, flag).pass);
}

TEST(Quantities, NameTheirReferenceCurve) {
  const auto curve = reference_curve_of("gauge.rear.velocity.x.error@3us..5us:other/reference.csv:speed");
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->gauge, "rear");
  EXPECT_EQ(curve->column, "velocity.x");
  EXPECT_EQ(curve->file, "other/reference.csv");
  EXPECT_EQ(curve->file_column, "speed");
  EXPECT_FALSE(reference_curve_of("gauge.rear.velocity@3us"));
  EXPECT_FALSE(reference_curve_of("body.flyer.mass"));
  EXPECT_FALSE(reference_curve_of("gauge.rear.velocity.error@3us..5us"));
}

}  // namespace
}  // namespace recoil::quantities_test
