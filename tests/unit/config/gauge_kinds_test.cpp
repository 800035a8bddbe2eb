#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "config/read_case.hpp"

namespace recoil::config::gauge_kinds_test {
namespace {

/// A case with a bar, a wall and one gauge of these keys.
Case with_gauge(const std::string& geometry, const std::string& keys, Diagnostics& out) {
  const bool round = geometry == "axisymmetric", flat = geometry == "planar";
  const std::string second = round ? "z" : flat ? "y" : "";
  std::string text = "format = 1\n[domain]\ngeometry = \"" + geometry + "\"\n" + (round ? "r" : "x") +
                     " = [\"0 mm\", \"20 mm\"]\n";
  if (!second.empty()) text += second + " = [\"0 mm\", \"20 mm\"]\n";
  text += "[mesh]\nfinest = \"1 mm\"\n[time]\nend = \"1 us\"\n";
  for (const char* body : {"bar", "wall"})
    text += std::string("[body.") + body + "]\nrigid = true\nshape = { kind = \"box\", " +
            (round ? "r" : "x") + " = [\"1 mm\", \"2 mm\"]" +
            (second.empty() ? "" : ", " + second + " = [\"1 mm\", \"2 mm\"]") + " }\n";
  return read_case(parse_document(text + "[gauge.g]\n" + keys, "case.toml", out), out);
}

std::string complaints(const std::string& geometry, const std::string& keys) {
  Diagnostics out;
  with_gauge(geometry, keys, out);
  return out.text();
}

TEST(GaugeKinds, AreRead) {
  Diagnostics out;
  const Case bar =
      with_gauge("axisymmetric", "kind = \"bar\"\nbody = \"bar\"\nwall = \"wall\"\nevery = \"1 us\"\n", out);
  const Case line = with_gauge(
      "1d",
      "kind = \"peak-stress\"\nbody = \"bar\"\nat = { x = \"1 mm\" }\nto = { x = \"9 mm\" }\nstations = 8\n",
      out);
  const Case attitude = with_gauge("planar", "kind = \"attitude\"\nbody = \"bar\"\n", out);
  ASSERT_EQ(out.text(), "");
  EXPECT_EQ(std::get<BarGauge>(bar.gauges[0].kind).wall, "wall");
  EXPECT_EQ(std::get<PeakStressGauge>(line.gauges[0].kind).stations, 8);
  EXPECT_DOUBLE_EQ(std::get<PeakStressGauge>(line.gauges[0].kind).to[0], 9e-3);
  EXPECT_EQ(std::get<AttitudeGauge>(attitude.gauges[0].kind).body, "bar");
}

TEST(GaugeKinds, OfWhatBreaksAreRead) {
  Diagnostics out;
  const Case crater = with_gauge("axisymmetric",
                                 "kind = \"crater\"\nbody = \"bar\"\nat = { z = \"1 mm\" }\n"
                                 "direction = { z = -2 }\nradius = \"3 mm\"\n",
                                 out);
  const Case pieces =
      with_gauge("1d", "kind = \"fragments\"\nbody = \"bar\"\nsmaller-than = \"2 mm\"\n", out);
  const Case signal = with_gauge("1d", "kind = \"pullback\"\nbody = \"bar\"\nat = { x = \"2 mm\" }\n", out);
  const Case behind = with_gauge(
      "1d", "kind = \"residual\"\nbody = \"bar\"\nat = { x = \"9 mm\" }\ndirection = { x = 1 }\n", out);
  ASSERT_EQ(out.text(), "");
  EXPECT_EQ(std::get<CraterGauge>(crater.gauges[0].kind).direction, (Vector{0, -1, 0}));
  EXPECT_DOUBLE_EQ(std::get<FragmentsGauge>(pieces.gauges[0].kind).smaller_than, 2e-3);
  EXPECT_DOUBLE_EQ(std::get<PullbackGauge>(signal.gauges[0].kind).at[0], 2e-3);
  EXPECT_DOUBLE_EQ(std::get<ResidualGauge>(behind.gauges[0].kind).direction[0], 1);
  const std::string pit = "kind = \"crater\"\nbody = \"bar\"\nradius = \"3 mm\"\n";
  const auto says = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(says(complaints("planar", pit + "at = { x = \"1 mm\" }\ndirection = { x = 1, y = 1 }\n"),
                   "normal to an axis"));
  EXPECT_TRUE(says(complaints("axisymmetric", pit + "at = { z = \"1 mm\" }\ndirection = { r = 1 }\n"),
                   "normal to z"));
  EXPECT_TRUE(says(complaints("axisymmetric", pit + "at = { r = \"1 mm\" }\ndirection = { z = 1 }\n"),
                   "on the axis"));
  EXPECT_TRUE(says(complaints("1d", pit + "at = { x = \"1 mm\" }\ndirection = { x = 1 }\n"),
                   "does not exist in geometry \"1d\""));
}

TEST(GaugeKinds, SomeColumnsAreSwitchedOnByAKey) {
  const auto has = [](const Gauge& gauge, const std::string& name) {
    const std::vector<Column> columns = written_columns(gauge);
    return std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  };
  PointGauge point;
  EXPECT_FALSE(has({"p", point}, "position"));
  EXPECT_TRUE(has({"p", point}, "molten"));
  point.follows = true;
  EXPECT_TRUE(has({"p", point}, "position"));
  ContactGauge contact;
  EXPECT_FALSE(has({"c", contact}, "force.along"));
  EXPECT_TRUE(has({"c", contact}, "traction-scatter"));
  contact.direction = {1, 0, 0};
  EXPECT_TRUE(has({"c", contact}, "impulse.along"));
}

TEST(GaugeKinds, MistakesGetACure) {
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(complaints("axisymmetric", "kind = \"bar\"\nbody = \"bar\"\n"), "'wall' is missing"));
  EXPECT_TRUE(has(complaints("axisymmetric", "kind = \"bar\"\nbody = \"bar\"\nwall = \"wal\"\n"),
                  "did you mean 'wall'"));
  EXPECT_TRUE(has(complaints("axisymmetric", "kind = \"bar\"\nbody = \"bar\"\nwall = \"bar\"\n"),
                  "cannot stand on itself"));
  EXPECT_TRUE(has(complaints("planar", "kind = \"bar\"\nbody = \"bar\"\nwall = \"wall\"\n"),
                  "does not exist in geometry \"planar\""));
  EXPECT_TRUE(has(complaints("axisymmetric", "kind = \"attitude\"\nbody = \"bar\"\n"), "planar, 3d"));
  const std::string line = "kind = \"peak-stress\"\nbody = \"bar\"\nat = { x = \"1 mm\" }\n";
  EXPECT_TRUE(has(complaints("1d", line), "'to' is missing"));
  EXPECT_TRUE(has(complaints("1d", line + "to = { x = \"1 mm\" }\n"), "has no length"));
  EXPECT_TRUE(has(complaints("1d", line + "to = { x = \"30 mm\" }\n"), "outside the domain"));
  EXPECT_TRUE(
      has(complaints("1d", line + "to = { x = \"3 mm\" }\nevery = \"1 us\"\n"), "'every' does not apply"));
  EXPECT_TRUE(
      has(complaints("1d", "kind = \"body\"\nbody = \"bar\"\nstations = 3\n"), "'stations' does not apply"));
}

}  // namespace
}  // namespace recoil::config::gauge_kinds_test
