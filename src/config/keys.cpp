#include "config/keys.hpp"

#include "core/error.hpp"

namespace recoil::config {

namespace {

using Type = Key::Type;

Key table(std::string name, std::string doc, bool required = false) {
  return {.name = std::move(name), .type = Type::table, .required = required, .doc = std::move(doc)};
}

Key range(std::string name, std::string doc) {
  return {.name = std::move(name),
          .type = Type::range,
          .unit = "m",
          .doc = std::move(doc),
          .example = R"(["0 mm", "10 mm"])"};
}

Key position(std::string name, std::string doc, bool required = false) {
  return {.name = std::move(name),
          .type = Type::vector,
          .unit = "m",
          .required = required,
          .doc = std::move(doc),
          .example = R"({ x = "1 mm" })"};
}

Key every(std::string doc) {
  return {.name = "every",
          .type = Type::quantity,
          .unit = "s",
          .minimum = 0,
          .default_text = "0 s",
          .doc = std::move(doc),
          .example = R"("0.1 us")"};
}

Section top() {
  return {"",
          "The top of the file.",
          {{.name = "format",
            .type = Type::integer,
            .minimum = 1,
            .default_text = "1",
            .doc = "version of the case format",
            .example = "1"},
           {.name = "title",
            .doc = "one line that names the case in reports",
            .example = R"("Aluminium on copper")"},
           {.name = "cite",
            .type = Type::texts,
            .doc = "what to cite with results of this case",
            .example = R"(["marsh1980"])"},
           table("domain", "the space that is computed", true),
           table("mesh", "the cells", true),
           table("time", "how long, and in which steps", true),
           table("body", "the bodies, one [body.NAME] each", true),
           table("material", "materials of this case alone, one [material.NAME] each"),
           table("gauge", "records over time, one [gauge.NAME] each"),
           table("contact", "what happens where bodies meet"),
           table("method", "the numerical method"),
           table("output", "what is written, and how often"),
           table("expect", "what the results are checked against")}};
}

Section domain() {
  return {"domain",
          "The box of space that is computed.",
          {{.name = "geometry",
            .type = Type::choice,
            .required = true,
            .doc = "1d (uniaxial strain), planar (plane strain), axisymmetric (r, z) or 3d",
            .choices = {"1d", "planar", "axisymmetric", "3d"},
            .example = R"("axisymmetric")"},
           range("x", "extent along x: 1d, planar, 3d"),
           range("y", "extent along y: planar, 3d"),
           range("r", "extent along the radius: axisymmetric"),
           range("z", "extent along z: axisymmetric, 3d"),
           table("boundary", "what lies beyond the edges")}};
}

Section boundary() {
  Section s{"domain.boundary",
            "What lies beyond the edges: one kind for both ends of an axis, or [low, high].",
            {}};
  for (const char* axis : {"x", "y", "r", "z"})
    s.keys.push_back({.name = axis,
                      .type = Type::texts,
                      .doc = std::string("ends of ") + axis + "; without it outflow" +
                             (std::string(axis) == "r" ? ", and axis where r starts at 0" : ""),
                      .choices = {"outflow", "symmetry", "periodic", "axis"},
                      .example = R"(["symmetry", "outflow"])"});
  return s;
}

Section mesh() {
  return {"mesh",
          "The cells.",
          {{.name = "finest",
            .type = Type::quantity,
            .unit = "m",
            .positive = true,
            .required = true,
            .doc = "edge of the smallest cells",
            .example = R"("0.05 mm")"},
           {.name = "offset",
            .type = Type::quantity,
            .unit = "1",
            .minimum = 0,
            .maximum = 1,
            .default_text = "0",
            .doc = "shifts the mesh by this fraction of a cell, to see how results depend on it",
            .example = "0.37"},
           {.name = "block",
            .type = Type::integer,
            .minimum = 0,
            .maximum = 256,
            .default_text = "0",
            .doc = "cells of a block along each axis; 0: chosen by the mesh",
            .example = "16"}}};
}

Section time() {
  return {"time",
          "How long, and in which steps.",
          {{.name = "end",
            .type = Type::quantity,
            .unit = "s",
            .positive = true,
            .required = true,
            .doc = "time at which the run ends; it starts at 0",
            .example = R"("10 us")"},
           {.name = "cfl",
            .type = Type::quantity,
            .unit = "1",
            .maximum = 1,
            .positive = true,
            .default_text = "0.9",
            .doc = "length of a step as a fraction of the largest stable one",
            .example = "0.9"},
           {.name = "fixed-dt",
            .type = Type::quantity,
            .unit = "s",
            .positive = true,
            .doc = "the same step all the time, instead of cfl",
            .example = R"("1 ns")"}}};
}

Section body() {
  return {
      "body.*",
      "A body: matter with a surface of its own. Either a material or rigid = true.",
      {{.name = "material",
        .doc = "a material of the library, or a [material.NAME] of this case",
        .example = R"("copper/ofhc-johnson-cook")"},
       {.name = "rigid",
        .type = Type::flag,
        .default_text = "false",
        .doc = "a rigid body: it has no material, and keeps its velocity unless it has a mass",
        .example = "true"},
       {.name = "mass",
        .type = Type::quantity,
        .unit = "kg",
        .positive = true,
        .doc = "of a rigid body that its contacts push (planar: per depth, kg/m; 1d: per area, kg/m2)",
        .example = R"("0.2 kg")"},
       {.name = "inertia",
        .type = Type::any,
        .unit = "kg m2",
        .doc = "moment of inertia of a free rigid body about its centre of mass: planar a quantity per depth "
               "(kg m); "
               "3d { x = ..., y = ..., z = ... }, principal moments; without it the body does not turn",
        .example = R"({ x = "2 kg m2", y = "2 kg m2", z = "1 kg m2" })"},
       position("centre-of-mass", "of a free rigid body that can turn"),
       {.name = "shape",
        .type = Type::table,
        .required = true,
        .doc = "where it is at the start",
        .example = R"({ kind = "sphere", radius = "5 mm" })"},
       {.name = "velocity",
        .type = Type::vector,
        .unit = "m/s",
        .doc = "at the start; planar also { speed = \"1 km/s\", angle = \"-10 deg\" } from the x axis",
        .example = R"({ x = "450 m/s" })"},
       {.name = "spin",
        .type = Type::any,
        .unit = "rad/s",
        .doc = "turning at the start: planar a quantity, counter-clockwise; 3d { x = ..., y = ..., z = ... }",
        .example = R"("1000 rad/s")"},
       position("spin-centre", "the point about which it turns")}};
}

Section polar_velocity() {
  return {"body.*.velocity",
          "A velocity in the plane given by its size and direction.",
          {{.name = "speed",
            .type = Type::quantity,
            .unit = "m/s",
            .minimum = 0,
            .required = true,
            .doc = "size of the velocity",
            .example = R"("1 km/s")"},
           {.name = "angle",
            .type = Type::quantity,
            .unit = "rad",
            .default_text = "0 rad",
            .doc = "from the x axis, counter-clockwise",
            .example = R"("-10 deg")"}},
          "polar"};
}

Key kind_key(std::vector<std::string> kinds) {
  return {.name = "kind",
          .type = Type::choice,
          .required = true,
          .doc = "the kind of shape",
          .choices = std::move(kinds),
          .example = R"("box")"};
}

Key radius() {
  return {.name = "radius",
          .type = Type::quantity,
          .unit = "m",
          .positive = true,
          .required = true,
          .doc = "its radius",
          .example = R"("5 mm")"};
}

Key rotation() {
  return {.name = "rotation",
          .type = Type::quantity,
          .unit = "rad",
          .default_text = "0 rad",
          .doc = "turned by this angle about `centre`, counter-clockwise (planar, axisymmetric)",
          .example = R"("10 deg")"};
}

Key direction(std::string name, std::string doc, bool required) {
  return {.name = std::move(name),
          .type = Type::vector,
          .unit = "1",
          .required = required,
          .doc = std::move(doc),
          .example = "{ x = 1 }"};
}

Key parts(std::string doc) {
  return {.name = "parts",
          .type = Type::any,
          .required = true,
          .doc = std::move(doc),
          .example = R"([{ kind = "box", ... }, { kind = "disc", ... }])"};
}

std::vector<Section> shapes() {
  const Key centre = position("centre", "its centre; without it the origin");
  const std::vector<Key> sides{range("x", "extent along x"),
                               range("y", "extent along y"),
                               range("r", "extent along the radius (axisymmetric)"),
                               range("z", "extent along z"),
                               rotation(),
                               position("centre", "centre of rotation; without it the middle")};
  std::vector<Section> all;
  const auto add = [&](const char* kind, const char* doc, std::vector<Key> keys) {
    all.push_back({"body.*.shape", doc, std::move(keys), kind});
  };
  add("box", "A box along the axes; in 1d an interval, axisymmetric a ring or a round plate.", sides);
  add("rectangle", "Another name of box in the plane.", sides);
  add("disc", "A disc in the plane.", {radius(), centre});
  add("cylinder", "A cylinder: axisymmetric about the axis, 3d anywhere; planar the same as disc.",
      {radius(), range("z", "extent along the axis (axisymmetric)"), centre,
       direction("axis", "direction of its axis (3d); without it z", false),
       range("along", "extent along its axis, from `centre` (3d)")});
  add("sphere", "A ball.", {radius(), centre});
  add("half-space", "All that lies behind a plane.",
      {position("point", "a point of its surface", true),
       direction("normal", "points out of the matter", true)});
  add("polygon", "A polygon in the plane.",
      {{.name = "vertices",
        .type = Type::any,
        .required = true,
        .doc = "its corners in order, each a pair of coordinates",
        .example = R"([["0 mm", "0 mm"], ["4 mm", "0 mm"], ["0 mm", "3 mm"]])"},
       rotation(),
       position("centre", "centre of rotation; without it the origin")});
  add("union", "All that lies in one of several shapes.", {parts("the shapes that make it up")});
  add("difference", "The first of several shapes without the others.",
      {parts("the shape, and what is cut out of it")});
  std::vector<std::string> kinds;
  for (const Section& s : all) kinds.push_back(s.kind);
  for (Section& s : all) s.keys.insert(s.keys.begin(), kind_key(kinds));
  return all;
}

Section gauge() {
  return {
      "gauge.*",
      "A record over time, written to gauges/NAME.csv.",
      {{.name = "kind",
        .type = Type::choice,
        .required = true,
        .doc = "what it records",
        .choices = {"surface-velocity", "point", "body", "contact", "bar", "attitude", "peak-stress"},
        .example = R"("surface-velocity")"},
       {.name = "body", .doc = "the body it watches", .example = R"("target")"},
       {.name = "pair", .doc = "the two bodies of a contact gauge", .example = R"("flyer-target")"},
       position(
           "at",
           "where it is (surface-velocity, point), the middle of what counts (contact), or the begin of the "
           "line (peak-stress)"),
       {.name = "radius",
        .type = Type::quantity,
        .unit = "m",
        .positive = true,
        .doc = "only the contact within this distance of `at` counts, so that its rim can be left out",
        .example = R"("2 mm")"},
       direction("direction", "force and impulse are also given along this direction (contact)", false),
       every("time between two records; 0: every step"),
       {.name = "wall", .doc = "the body that the foot of a bar stands on", .example = R"("wall")"},
       position("to", "end of the line (peak-stress)"),
       {.name = "stations",
        .type = Type::integer,
        .minimum = 1,
        .maximum = 10000,
        .default_text = "100",
        .doc = "points on the line that ride with the matter (peak-stress)",
        .example = "100"}}};
}

Key contact_mode(const std::string& name, const std::string& where) {
  return {.name = name,
          .type = Type::choice,
          .default_text = "separable",
          .doc = where +
                 ". separable: frictionless, pressed together or apart, never pulled; bonded: glued from the "
                 "first touch on; friction: separable, with Coulomb friction",
          .choices = {"separable", "bonded", "friction"},
          .example = R"("separable")"};
}

Key contact_friction() {
  return {.name = "friction",
          .type = Type::quantity,
          .unit = "1",
          .minimum = 0,
          .maximum = 10,
          .doc = "Coulomb's coefficient: largest shear traction over pressure",
          .example = "0.3"};
}

std::vector<Section> settings() {
  return {
      {"contact",
       "What happens where bodies meet.",
       {contact_mode("default", "between all bodies that [contact.pairs] does not name"), contact_friction(),
        table("pairs", "what holds between two bodies: NAME-NAME = { mode = ..., friction = ... }")}},
      {"contact.pairs.*",
       "What happens where two bodies meet.",
       {contact_mode("mode", "between these two"), contact_friction()}},
      {"method",
       "The numerical method.",
       {{.name = "scheme",
         .type = Type::choice,
         .default_text = "conservative",
         .doc = "how surfaces are treated; conservative: cut cells that keep mass, momentum and energy; "
                "ghost-fluid: whole cells and ghost values; seed: the scheme of the contact-separation "
                "paper, to compare with",
         .choices = {"conservative", "ghost-fluid", "seed"},
         .example = R"("conservative")"},
        {.name = "kappa",
         .type = Type::quantity,
         .unit = "1",
         .maximum = 1,
         .positive = true,
         .default_text = "0.5",
         .doc = "scheme = \"seed\" only: bodies meet when this many cells still lie between them",
         .example = "0.5"}}},
      {"output",
       "What is written, and how often.",
       {table("fields", "pictures of the whole domain"), table("history", "sums over each body")}},
      {"output.fields",
       "Pictures of the whole domain.",
       {every("time between two pictures; 0: only the first and the last"),
        {.name = "variables",
         .type = Type::texts,
         .doc = "which fields; without it all",
         .example = R"(["pressure", "velocity", "plastic-strain"])"}}},
      {"output.history",
       "Sums over each body, in history.csv.",
       {every("time between two lines; 0: every step")}}};
}

Section expect() {
  const auto amount = [](const char* name, const char* doc) {
    return Key{.name = name, .type = Type::any, .doc = doc, .example = R"("0.695 us")"};
  };
  return {
      "expect.*",
      "A result, in quotes, and what it shall be: one of value, at-most, at-least; or just true or false.",
      {amount("value", "the expected value"),
       {.name = "within",
        .type = Type::any,
        .doc = "how far off it may be: a percentage or a quantity",
        .example = R"("3 %")"},
       amount("at-most", "an upper limit"),
       amount("at-least", "a lower limit"),
       {.name = "source", .doc = "where the value comes from", .example = R"("marsh1980")"},
       {.name = "why", .doc = "why the limit is what it is", .example = R"("first-order spike")"}}};
}

}  // namespace

const std::vector<Section>& case_sections() {
  static const std::vector<Section> all = [] {
    std::vector<Section> s{top(), domain(), boundary(), mesh(), time(), body(), polar_velocity()};
    for (Section& shape : shapes()) s.push_back(std::move(shape));
    s.push_back(gauge());
    for (Section& one : settings()) s.push_back(std::move(one));
    s.push_back(expect());
    return s;
  }();
  return all;
}

std::span<const Key> keys_of(const std::string& section, const std::string& kind) {
  for (const Section& s : case_sections())
    if (s.name == section && s.kind == kind) return s.keys;
  throw InternalError("internal error: no section '" + section + "' of the case file");
}

}  // namespace recoil::config
