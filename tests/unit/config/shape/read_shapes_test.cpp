#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../../support/scratch_folder.hpp"
#include "../../support/stl_bodies.hpp"
#include "config/declare/kinds.hpp"
#include "config/document.hpp"
#include "config/shape/shape.hpp"

namespace recoil::config::read_shapes_test {
namespace {

struct Read {
  Shape shape;
  std::string said;  // what was wrong with it
  std::vector<std::filesystem::path> files;
};

Read read(Geometry geometry, const std::string& text, const std::filesystem::path& folder = {}) {
  Read r;
  Diagnostics out;
  const Document document = parse_document("shape = " + text + "\n", "case.toml", out);
  CaseReading in{geometry, axes_of(geometry), out};
  in.folder = folder;
  in.files = &r.files;
  r.shape = read_shape(*document.root.find("shape"), in);
  r.said = out.text();
  return r;
}

/// What a shape becomes in a resolved case, which must read back the same.
std::string again(Geometry geometry, const Shape& shape) {
  const Writing how{geometry, axes_of(geometry)};
  std::string text = inline_table(written_kind(shape.form, how));
  const Read second = read(geometry, text);
  EXPECT_EQ(second.said, "");
  EXPECT_EQ(inline_table(written_kind(second.shape.form, how)), text);
  return text;
}

void expect_near(const Vector& v, double x, double y, double z) {
  EXPECT_NEAR(v[0], x, 1e-12);
  EXPECT_NEAR(v[1], y, 1e-12);
  EXPECT_NEAR(v[2], z, 1e-12);
}

TEST(ReadShapes, TheAxisByItsEndsOrByOneAndADirection) {
  const auto line_of = [](Geometry geometry, const std::string& keys) {
    const Read r = read(geometry, "{ kind = \"cone\", radius = \"1 mm\", " + keys + " }");
    EXPECT_EQ(r.said, "");
    again(geometry, r.shape);
    return std::get<Cone>(r.shape.form);
  };
  const std::string tip = R"(to = { x = "3 mm", y = "4 mm" }, )";
  expect_near(line_of(Geometry::space, tip + R"(from = { z = "1 mm" })").from, 0, 0, 1e-3);
  expect_near(line_of(Geometry::space, tip + R"(axis = { x = 3, y = 4 }, length = "10 mm")").from, -3e-3,
              -4e-3, 0);
  expect_near(line_of(Geometry::planar, tip + R"(axis = { angle = "90 deg" }, length = "1 mm")").from, 3e-3,
              3e-3, 0);
  expect_near(line_of(Geometry::space,
                      R"(from = {}, axis = { angle = "90 deg", elevation = "30 deg" }, length = "2 mm")")
                  .to,
              0, 2e-3 * std::cos(M_PI / 6), 1e-3);
  expect_near(
      line_of(Geometry::axisymmetric, R"(from = { z = "1 mm" }, axis = { z = -1 }, length = "4 mm")").to, 0,
      -3e-3, 0);
}

TEST(ReadShapes, EveryKindReadsBack) {
  for (
      const auto& [geometry, text] : std::vector<std::pair<Geometry, std::string>>{
          {Geometry::line,
           R"({ kind = "lattice", shape = { kind = "box", x = ["0 mm", "1 mm"] }, count = { x = 3 }, pitch = { x = "2 mm" } })"},
          {Geometry::line,
           R"({ kind = "moved", shape = { kind = "box", x = ["0 mm", "1 mm"] }, shift = { x = "2 mm" } })"},
          {Geometry::planar,
           R"({ kind = "ogive", to = {}, axis = { angle = "-20 deg" }, length = "20 mm", radius = "2 mm", calibre-radius = 3 })"},
          {Geometry::planar,
           R"({ kind = "moved", shape = { kind = "disc", radius = "1 mm" }, angle = "20 deg", centre = { x = "1 mm" } })"},
          {Geometry::planar,
           R"({ kind = "intersection", parts = [{ kind = "disc", radius = "2 mm" }, { kind = "half-space", point = {}, normal = { angle = "30 deg" } }] })"},
          {Geometry::axisymmetric,
           R"({ kind = "frustum", from = {}, to = { z = "2 mm" }, from-radius = "1 mm", to-radius = "2 mm" })"},
          {Geometry::axisymmetric,
           R"({ kind = "torus", radius = "3 mm", tube = "1 mm", centre = { z = "1 mm" } })"},
          {Geometry::axisymmetric,
           R"({ kind = "revolution", profile = [["1 mm", "0 mm"], ["2 mm", "4 mm"]] })"},
          {Geometry::space,
           R"({ kind = "revolution", profile = [["1 mm", "0 mm"], ["2 mm", "4 mm"], ["2 mm", "0 mm"], ["1 mm", "0 mm"]], axis = { x = 1 } })"},
          {Geometry::space,
           R"({ kind = "torus", radius = "3 mm", tube = "1 mm", axis = { angle = "10 deg", elevation = "20 deg" } })"},
          {Geometry::space,
           R"({ kind = "cylinder", radius = "3 mm", from = { x = "1 mm" }, to = { y = "2 mm", z = "3 mm" } })"},
          {Geometry::space,
           R"({ kind = "extrusion", y = ["1 mm", "2 mm"], vertices = [["0 mm", "0 mm"], ["4 mm", "0 mm"], ["0 mm", "3 mm"]] })"},
          {Geometry::space,
           R"({ kind = "moved", shape = { kind = "box", x = ["0 mm", "1 mm"], y = ["0 mm", "1 mm"], z = ["0 mm", "1 mm"] }, turn-from = { z = 1 }, turn-to = { x = 1, y = 2, z = 3 }, shift = { z = "1 mm" } })"},
      }) {
    const Read r = read(geometry, text);
    EXPECT_EQ(r.said, "");
    if (r.said.empty()) again(geometry, r.shape);
  }
}

TEST(ReadShapes, ADirectionTurnedToAnother) {
  const auto moved = [](const std::string& from, const std::string& to) {
    return std::get<Moved>(
        read(Geometry::space,
             "{ kind = \"moved\", shape = { kind = \"sphere\", radius = \"1 mm\" }, turn-from = " + from +
                 ", turn-to = " + to + " }")
            .shape.form);
  };
  const Moved quarter = moved("{ z = 2 }", "{ x = 3 }");
  EXPECT_DOUBLE_EQ(quarter.angle, M_PI / 2);
  expect_near(quarter.axis, 0, 1, 0);
  EXPECT_EQ(moved("{ x = 1 }", "{ x = 2 }").angle, 0);
  const Moved back = moved("{ x = 1 }", "{ x = -1 }");
  EXPECT_DOUBLE_EQ(back.angle, M_PI);
  EXPECT_EQ(back.axis[0], 0);
  EXPECT_DOUBLE_EQ(std::hypot(back.axis[1], back.axis[2]), 1);
}

TEST(ReadShapes, StlFilesAreFoundBesideTheCaseAndInARun) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "parts");
  std::ofstream(folder / "parts/cube.stl", std::ios::binary) << stl_binary(cube(0, 2));
  const auto text = [](const char* file) {
    return std::string(R"({ kind = "stl", scale = "0.5 mm", file = ")") + file + "\" }";
  };
  const Read r = read(Geometry::space, text("parts/cube.stl"), folder.path());
  ASSERT_EQ(r.said, "");
  ASSERT_EQ(r.files.size(), 1U);
  EXPECT_NEAR(std::get<Stl>(r.shape.form).distance(Vec<3>{{3e-3, 0.5e-3, 0.5e-3}}, {}), 2e-3, 1e-15);
  EXPECT_NE(read(Geometry::space, text("cube.stl"), folder.path()).said.find("there is no file"),
            std::string::npos);
  // A run has a copy in its own folder, and two of one name would be one there.
  std::filesystem::copy(folder / "parts/cube.stl", folder / "cube.stl");
  const std::string two =
      R"({ kind = "union", parts = [)" + text("cube.stl") + ", " + text("parts/cube.stl") + "] }";
  EXPECT_NE(read(Geometry::space, two, folder.path()).said.find("two files of this case are called cube.stl"),
            std::string::npos);
  std::ofstream(folder / "case.resolved.toml") << "";
  std::filesystem::remove_all(folder / "parts");
  EXPECT_EQ(read(Geometry::space, text("parts/cube.stl"), folder.path()).said, "");
  // Resolved, the case knows the file by its bytes.
  const std::string resolved =
      inline_table(written_kind(r.shape.form, {Geometry::space, axes_of(Geometry::space)}));
  EXPECT_EQ(read(Geometry::space, resolved, folder.path()).said, "");
  std::ofstream(folder / "cube.stl", std::ios::binary) << stl_binary(cube(0, 2.5));
  EXPECT_NE(read(Geometry::space, resolved, folder.path())
                .said.find("is not the file that this case was resolved with"),
            std::string::npos);
}

TEST(ReadShapes, AnOpenStlFileNamesItsOpenEdges) {
  const ScratchFolder folder;
  Triangles open = cube(0, 2);
  open.corners.pop_back();
  std::ofstream(folder / "cup.stl") << stl_text(open);
  const std::string said =
      read(Geometry::space, R"({ kind = "stl", scale = "1 mm", file = "cup.stl" })", folder.path()).said;
  EXPECT_NE(said.find("cup.stl: the surface is not closed: 3 of 18 edges are open"), std::string::npos)
      << said;
  EXPECT_NE(said.find("at (0, 0, 2) mm"), std::string::npos) << said;
}

const std::string cone = R"({ kind = "cone", radius = "1 mm", )",
                  ogive = R"({ kind = "ogive", from = {}, to = { z = "20 mm" }, radius = "4 mm")",
                  ball = R"({ kind = "sphere", radius = "1 mm" })",
                  box = R"({ kind = "box", x = ["0 mm", "1 mm"] })";
const std::vector<std::tuple<Geometry, std::string, std::string>> mistakes{
    {Geometry::space, cone + "from = {} }", "needs both ends of its axis"},
    {Geometry::space, cone + R"(from = {}, length = "1 mm" })", "or one of them with 'axis' and 'length'"},
    {Geometry::space, cone + R"(from = {}, to = {} })", "its axis has no length"},
    {Geometry::space, cone + R"(from = {}, to = { x = "1 mm" }, length = "1 mm" })",
     "say already where the axis lies"},
    {Geometry::axisymmetric, cone + R"(from = {}, to = { r = "1 mm" } })", "must be the axis r = 0"},
    {Geometry::axisymmetric, cone + R"(from = {}, axis = { angle = "3 deg" }, length = "1 mm" })",
     "cannot be given by angles"},
    {Geometry::planar,
     cone + R"(from = {}, axis = { angle = "3 deg", elevation = "1 deg" }, length = "1 mm" })",
     "unknown key 'elevation'"},
    {Geometry::line, cone + "from = {} }", "does not exist in geometry \"1d\""},
    {Geometry::space,
     R"({ kind = "frustum", from = {}, to = { x = "1 mm" }, from-radius = "0 mm", to-radius = "0 mm" })",
     "both radii"},
    {Geometry::space, ogive + " }", "'nose' or 'calibre-radius'"},
    {Geometry::space, ogive + R"(, nose = "9 mm", calibre-radius = 3 })", "remove one of"},
    {Geometry::space, ogive + R"(, nose = "3 mm" })", "at least as long as its radius"},
    {Geometry::space, ogive + ", calibre-radius = 9 }", "but the whole body only 20 mm"},
    {Geometry::space, R"({ kind = "torus", radius = "1 mm", tube = "2 mm" })", "reaches across its axis"},
    {Geometry::axisymmetric, R"({ kind = "torus", radius = "2 mm", tube = "1 mm", centre = { r = "2 mm" } })",
     "must lie on the axis"},
    {Geometry::space, R"({ kind = "revolution", profile = [["0 mm", "0 mm"], ["0 mm", "2 mm"]] })",
     "encloses nothing"},
    {Geometry::space, R"({ kind = "revolution", profile = [["1 mm", "0 mm"], ["-1 mm", "2 mm"]] })",
     "below the axis r = 0"},
    {Geometry::space, R"({ kind = "revolution", profile = [["1 mm", "0 mm"]] })", "at least 2 corners"},
    {Geometry::space,
     R"({ kind = "extrusion", vertices = [["0 mm", "0 mm"], ["4 mm", "0 mm"], ["0 mm", "3 mm"]] })",
     "'x', 'y' or 'z'"},
    {Geometry::space, R"({ kind = "cylinder", radius = "1 mm" })",
     "'from' and 'to', or its extent 'along' its axis"},
    {Geometry::space, R"({ kind = "cylinder", radius = "1 mm", from = {}, along = ["0 mm", "1 mm"] })",
     "go together"},
    {Geometry::space, R"({ kind = "moved", shape = )" + ball + ", turn-from = { x = 1 } }", "go together"},
    {Geometry::space,
     R"({ kind = "moved", shape = )" + ball +
         R"(, angle = "3 deg", turn-from = { x = 1 }, turn-to = { z = 1 } })",
     "say already how"},
    {Geometry::space, R"({ kind = "moved", shape = )" + ball + ", axis = { x = 1 } }",
     "'axis' needs 'angle'"},
    {Geometry::axisymmetric, R"({ kind = "moved", shape = )" + ball + R"(, shift = { r = "1 mm" } })",
     "along z only"},
    {Geometry::line, R"({ kind = "moved", shape = )" + box + R"(, angle = "3 deg" })",
     "'angle' does not apply"},
    {Geometry::line,
     R"({ kind = "lattice", shape = )" + box + R"(, count = { x = 2.5 }, pitch = { x = "1 mm" } })",
     "2.5 is no number of copies"},
    {Geometry::line, R"({ kind = "lattice", shape = )" + box + ", count = { x = 2 }, pitch = {} }",
     "'pitch' is 0 along x"},
    {Geometry::space,
     R"({ kind = "lattice", shape = )" + ball +
         R"(, count = { x = 999, y = 999 }, pitch = { x = "1 mm", y = "1 mm" } })",
     "at most 10000"},
    {Geometry::axisymmetric,
     R"({ kind = "lattice", shape = )" + ball + R"(, count = { r = 2 }, pitch = { r = "1 mm" } })",
     "along z only"},
    {Geometry::space, R"({ kind = "stl", file = "nowhere.stl" })", "'scale' is missing"},
    {Geometry::space, R"({ kind = "stl", file = "nowhere.stl", scale = "1 mm" })",
     "there is no file nowhere.stl"},
};

TEST(ReadShapes, MistakesGetACure) {
  for (const auto& [geometry, text, message] : mistakes) {
    const std::string said = read(geometry, text).said;
    EXPECT_NE(said.find(message), std::string::npos) << text << "\n" << said;
    EXPECT_NE(said.find("= help"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace recoil::config::read_shapes_test
