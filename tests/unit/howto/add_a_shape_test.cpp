// What docs/how-to/add-a-shape.md shows, compiled and tried. Its blocks of C++ stand here word for word.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "config/declare/kinds.hpp"
#include "config/shape/shape.hpp"

namespace recoil::config {

/// All within `radius` of the line from one end to the other.
struct Capsule {
  Vector from{}, to{};  // m
  double radius = 0;    // m

  static constexpr const char* kind = "capsule";
  static constexpr const char* doc = "All that lies near a line: a rod with round ends.";
  static std::vector<Geometry> only_in() { return {Geometry::planar, Geometry::space}; }
  static Entries<Capsule> keys() {
    return {{.name = "from",
             .member = &Capsule::from,
             .unit = "m",
             .required = true,
             .doc = "one end of the line",
             .example = R"({ x = "1 mm" })"},
            {.name = "to",
             .member = &Capsule::to,
             .unit = "m",
             .required = true,
             .doc = "the other end",
             .example = R"({ x = "9 mm" })"},
            {.name = "radius",
             .member = &Capsule::radius,
             .unit = "m",
             .positive = true,
             .required = true,
             .doc = "distance of the surface from the line",
             .example = R"("2 mm")"}};
  }
  void check(const TableReading& reading) const {
    if (reading.good("to") && from == to)
      reading.wrong("to", "the line of a capsule has no length", "for a ball use a sphere");
  }

  template <int Dim>
  double distance(const Vec<Dim>& x, const Domain& /*domain*/) const {
    const Vec<Dim> a = first_components<Dim>(from), along = first_components<Dim>(to) - a;
    const double t = std::clamp(dot(x - a, along) / dot(along, along), 0.0, 1.0);
    return norm(x - a - t * along) - radius;
  }
  double thickness(const Domain& /*domain*/) const { return 2 * radius; }
};

namespace {

using WithCapsule = std::variant<Box, Capsule>;

/// Reads a shape in geometry "planar".
WithCapsule read(const std::string& text, Diagnostics& out) {
  const Document document = parse_document("shape = " + text + "\n", "case.toml", out);
  WithCapsule shape;
  read_kind(*document.root.find("shape"), shape, "shape", "the kind of shape",
            {Geometry::planar, axes_of(Geometry::planar), out});
  return shape;
}

TEST(HowToAddAShape, TheCapsuleIsReadWrittenAndMeasured) {
  Diagnostics out;
  const WithCapsule shape =
      read(R"({ kind = "capsule", from = { x = "1 mm" }, to = { x = "9 mm" }, radius = "2 mm" })", out);
  ASSERT_EQ(out.text(), "");
  const auto& capsule = std::get<Capsule>(shape);
  EXPECT_NEAR(capsule.distance<2>({{5e-3, 5e-3}}, {}), 3e-3, 1e-15);
  EXPECT_NEAR(capsule.distance<2>({{0, 0}}, {}), -1e-3, 1e-15);
  EXPECT_EQ(inline_table(written_kind(shape, {Geometry::planar, axes_of(Geometry::planar)})),
            R"({ kind = "capsule", from = { x = "0.001 m", y = "0 m" }, to = { x = "0.009 m", y = "0 m" }, )"
            R"(radius = "0.002 m" })");
}

TEST(HowToAddAShape, MistakesGetACure) {
  for (const auto& [text, message] :
       {std::pair{R"({ kind = "capsule", from = {}, to = {}, radius = "2 mm" })", "for a ball use a sphere"},
        std::pair{R"({ kind = "capsule", from = {}, to = { x = "1 mm" } })", "'radius' is missing"},
        std::pair{R"({ kind = "capsul" })", "did you mean 'capsule'?"}}) {
    Diagnostics out;
    read(text, out);
    EXPECT_NE(out.text().find(message), std::string::npos) << out.text();
  }
}

}  // namespace
}  // namespace recoil::config
