#include "config/read_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "../support/sanitized.hpp"
#include "../support/scratch_folder.hpp"

namespace recoil::config::read_case_test {
namespace {

const std::string flyer = R"(format = 1
title = "Aluminium on copper"
cite = ["marsh1980"]
[domain]
geometry = "axisymmetric"
r = ["0 mm", "80 mm"]
z = ["-8 mm", "22 mm"]
[mesh]
finest = "0.05 mm"
offset = 0.37
[time]
end = "10 us"
[body.flyer]
material = "aluminium/6061-t6"
shape = { kind = "cylinder", radius = "60 mm", z = ["-2 mm", "0 mm"] }
velocity = { z = "450 m/s" }
[body.target]
material = "mine"
shape = { kind = "cylinder", radius = "60 mm", z = ["0 mm", "15 mm"] }
[material.mine]
base = "copper/seed"
[contact]
default = "separable"
[method]
scheme = "conservative"
[gauge.rear]
kind = "surface-velocity"
body = "target"
at = { r = "10 mm", z = "15 mm" }
every = "5 ns"
[gauge.touch]
kind = "contact"
pair = "flyer-target"
[output]
fields = { every = "0.1 us", variables = ["pressure"] }
[expect]
"contact.flyer-target.opens" = { value = "0.695 us", within = "3 %", source = "README" }
"contact.flyer-target.recloses" = false
"gauge.rear.velocity@3.8us" = { value = "155.7 m/s", within = "2 m/s", why = "spread" }
"budget.energy" = { at-most = 1e-10 }
)";

Case read(const std::string& text) {
  Diagnostics out;
  const Document doc = parse_document(text, "case.toml", out);
  Case c = read_case(doc, out);
  EXPECT_FALSE(out.has_errors()) << out.text();
  return c;
}

/// A case of one body; the domain's coordinates and the body's keys are given.
std::string one_body(const std::string& domain, const std::string& body) {
  return "[domain]\n" + domain +
         "\n[mesh]\nfinest = \"0.1 mm\"\n[time]\nend = \"1 us\"\n[body.rod]\nmaterial = \"m\"\n" + body +
         "\n";
}

TEST(ReadCase, Axisymmetric) {
  const Case c = read(flyer);
  EXPECT_EQ(c.title, "Aluminium on copper");
  EXPECT_EQ(c.domain.geometry, Geometry::axisymmetric);
  EXPECT_EQ(c.domain.hi[0], 80e-3);
  EXPECT_EQ(c.domain.lo[1], -8e-3);
  EXPECT_EQ(c.domain.boundary[0][0], Boundary::axis);
  EXPECT_EQ(c.domain.boundary[1][0], Boundary::outflow);
  EXPECT_EQ(c.mesh.finest, 0.05e-3);
  EXPECT_EQ(c.mesh.offset, 0.37);
  EXPECT_EQ(c.time.end, 10e-6);
  EXPECT_EQ(c.time.cfl, 0.9);
  EXPECT_FALSE(c.time.fixed_dt.has_value());
  ASSERT_EQ(c.bodies.size(), 2U);
  EXPECT_EQ(c.bodies[0].name, "flyer") << "in file order";
  EXPECT_EQ(c.bodies[0].velocity[1], 450);
  const auto& cylinder = std::get<Cylinder>(c.bodies[0].shape.form);
  EXPECT_EQ(cylinder.radius, 60e-3);
  EXPECT_EQ(cylinder.length[0], -2e-3);
  EXPECT_EQ(c.bodies[1].material, "mine");
  EXPECT_EQ(c.bodies[1].material_place.line, 18);
  ASSERT_EQ(c.gauges.size(), 2U);
  EXPECT_EQ(std::get<SurfaceVelocityGauge>(c.gauges[0].kind).at[0], 10e-3);
  EXPECT_EQ(std::get<SurfaceVelocityGauge>(c.gauges[0].kind).every, 5e-9);
  EXPECT_EQ(std::get<ContactGauge>(c.gauges[1].kind).pair[1], "target");
  EXPECT_EQ(c.output.fields.every, 0.1e-6);
  EXPECT_EQ(c.output.history.every, 0);
}

TEST(ReadCase, Expectations) {
  const Case c = read(flyer);
  ASSERT_EQ(c.expect.size(), 4U);
  EXPECT_EQ(c.expect[0].quantity, "contact.flyer-target.opens");
  EXPECT_DOUBLE_EQ(c.expect[0].tolerance, 0.03 * 0.695e-6);
  EXPECT_EQ(c.expect[0].unit, "us");
  EXPECT_TRUE(c.expect[1].is_flag);
  EXPECT_FALSE(c.expect[1].flag);
  EXPECT_DOUBLE_EQ(c.expect[2].tolerance, 2);
  EXPECT_TRUE(c.expect[3].at_most);
  EXPECT_EQ(c.expect[3].value, 1e-10);
}

TEST(ReadCase, ExpectationsOfAFileOfTheirOwn) {
  Diagnostics out;
  const Document doc =
      parse_document("contact.a-b.opens = { at-least = \"1 us\" }\n\"x.y\" = true\n", "expected.toml", out);
  const auto found = read_expectations(doc, out);
  ASSERT_FALSE(out.has_errors()) << out.text();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].quantity, "contact.a-b.opens") << "dots without quotes mean the same";
  EXPECT_TRUE(found[0].at_least);
}

TEST(ReadCase, OneDimension) {
  const Case c = read(
      one_body("geometry = \"1d\"\nx = [\"0 mm\", \"2 mm\"]\nboundary = { x = [\"symmetry\", \"outflow\"] }",
               "shape = { kind = \"box\", x = [\"0 mm\", \"1 mm\"] }"));
  EXPECT_EQ(dimension(c.domain.geometry), 1);
  EXPECT_EQ(c.domain.boundary[0][0], Boundary::symmetry);
  EXPECT_EQ(std::get<Box>(c.bodies[0].shape.form).hi[0], 1e-3);
}

TEST(ReadCase, Planar) {
  const Case c =
      read(one_body("geometry = \"planar\"\nx = [\"0 mm\", \"20 mm\"]\ny = [\"0 mm\", \"20 mm\"]\nboundary = "
                    "{ x = \"periodic\" }",
                    "velocity = { speed = \"1 km/s\", angle = \"-10 deg\" }\nspin = \"60 rpm\"\nspin-centre "
                    "= { x = \"1 mm\" }\n"
                    "shape = { kind = \"difference\", parts = [{ kind = \"rectangle\", x = [\"0 mm\", \"4 "
                    "mm\"], y = [\"0 mm\", \"2 "
                    "mm\"], rotation = \"30 deg\" }, { kind = \"disc\", radius = \"0.5 mm\", centre = { x = "
                    "\"2 mm\", y = \"1 mm\" } }, "
                    "{ kind = \"half-space\", point = { x = \"0 mm\" }, normal = { x = 3, y = 4 } }, { kind "
                    "= \"polygon\", vertices = "
                    "[[\"0 mm\", \"0 mm\"], [\"1 mm\", \"0 mm\"], [\"0 mm\", \"1 mm\"]] }] }"));
  EXPECT_EQ(c.domain.boundary[0][1], Boundary::periodic);
  const Body& rod = c.bodies[0];
  EXPECT_DOUBLE_EQ(rod.velocity[1], -1000 * std::sin(std::numbers::pi / 18));
  EXPECT_DOUBLE_EQ(rod.spin[2], 2 * std::numbers::pi);
  EXPECT_EQ(rod.spin_centre[0], 1e-3);
  const std::vector<Shape>& parts = std::get<Difference>(rod.shape.form).parts;
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_DOUBLE_EQ(std::get<Box>(parts[0].form).rotation, std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(std::get<Box>(parts[0].form).centre[0], 2e-3) << "turns about its middle";
  EXPECT_EQ(std::get<Cylinder>(parts[1].form).radius, 0.5e-3);
  EXPECT_DOUBLE_EQ(std::get<HalfSpace>(parts[2].form).normal[1], 0.8) << "normals have length 1";
  EXPECT_EQ(std::get<Polygon>(parts[3].form).vertices.size(), 3U);
}

TEST(ReadCase, Space) {
  const Case c = read(one_body(
      "geometry = \"3d\"\nx = [\"0 mm\", \"20 mm\"]\ny = [\"0 mm\", \"20 mm\"]\nz = [\"0 mm\", \"20 mm\"]",
      "spin = { z = \"10 rad/s\" }\nspin-centre = { x = \"1 mm\" }\nshape = { kind = \"union\", parts = [{ "
      "kind = "
      "\"cylinder\", radius = \"2 mm\", along = [\"0 mm\", \"9 mm\"], axis = { x = 2 } }, { kind = "
      "\"sphere\", radius = \"1 "
      "mm\", centre = { z = \"3 mm\" } }] }"));
  const std::vector<Shape>& parts = std::get<Union>(c.bodies[0].shape.form).parts;
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(std::get<Cylinder>(parts[0].form).axis[0], 1);
  EXPECT_EQ(std::get<Cylinder>(parts[0].form).length[1], 9e-3);
  EXPECT_EQ(std::get<Sphere>(parts[1].form).centre[2], 3e-3);
  EXPECT_EQ(c.bodies[0].spin[2], 10);
}

TEST(ReadCase, OverridesFromTheCommandLine) {
  const ScratchFolder folder;
  const std::string path = (folder / "case.toml").string();
  std::ofstream(path) << flyer;
  Document doc;
  Diagnostics out;
  const Case c = read_case(path, doc, out,
                           {"mesh.finest=0.1mm", "body.flyer.velocity.z = 500 m/s", "time.cfl=0.5",
                            "output.history.every=1 ns", "expect.\"budget.energy\"={ at-most = 1 }"});
  EXPECT_FALSE(out.has_errors()) << out.text();
  EXPECT_EQ(c.mesh.finest, 0.1e-3);
  EXPECT_EQ(c.bodies[0].velocity[1], 500);
  EXPECT_EQ(c.time.cfl, 0.5);
  EXPECT_EQ(c.output.history.every, 1e-9);
  EXPECT_EQ(c.expect[3].value, 1);
  EXPECT_NE(doc.find("material.mine.base"), nullptr);
}

TEST(ReadCase, ACutOffFileNeverCrashes) {
  const std::size_t first_body = flyer.find("\nvelocity");
  for (std::size_t n = 0; n <= flyer.size(); ++n) {
    Diagnostics out;
    const Document doc = parse_document(flyer.substr(0, n), "case.toml", out);
    read_case(doc, out);
    EXPECT_TRUE(out.has_errors() || n >= first_body) << "the first " << n << " bytes are no whole case";
    out.text();
  }
}

TEST(ReadCase, ADamagedFileNeverCrashes) {
  for (std::size_t n = 0; n < flyer.size(); n += sanitized ? 7 : 1) {
    for (const char c : {'"', '[', '\xFF', '9'}) {
      std::string text = flyer;
      text[n] = c;
      Diagnostics out;
      const Document doc = parse_document(text, "case.toml", out);
      read_case(doc, out);
      out.text();
    }
  }
}

}  // namespace
}  // namespace recoil::config::read_case_test
