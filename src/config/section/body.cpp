#include "config/section/body.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "config/declare/kinds.hpp"
#include "config/section/velocity.hpp"

namespace recoil::config {

namespace {

Custom<Body> custom_shape() {
  return {Key::Type::table, true,
          [](Body& body, const TableReading& reading, const Key& key) {
            body.shape = read_shape(*reading.record.node(key.name), reading.in);
          },
          [](const Body& body, const char*, const Writing& how) {
            return inline_table(written_kind(body.shape.form, how));
          },
          [](const std::string& path, std::vector<Section>& all) {
            add_kind_sections<ShapeKind>(path, shape_kind_doc, all);
          }};
}

/// A member that is a table of keys.
template <auto M>
Custom<Body> custom_table() {
  return {Key::Type::table, true,
          [](Body& body, const TableReading& reading, const Key& key) {
            read_struct(*reading.record.node(key.name), body.*M, reading.in);
          },
          [](const Body& body, const char*, const Writing& how) {
            return inline_table(written_keys(body.*M, how));
          },
          [](const std::string& path, std::vector<Section>& all) {
            add_sections<typename MemberOf<decltype(M)>::Value>(path, all);
          }};
}

/// A velocity over time is that of a rigid body that nothing else moves.
void check_history(const Body& body, const TableReading& reading) {
  if (!reading.has("velocity-history")) return;
  if (!body.rigid)
    reading.refuse("velocity-history", "'velocity-history' is for rigid bodies",
                   "matter moves by its own laws; a rigid body can push it");
  for (const char* key : {"velocity", "mass"})
    if (reading.has(key))
      reading.refuse(key, fmt::format("'{}' and 'velocity-history' do not go together", key),
                     "the history says all of the velocity");
}

void check_material(const Body& body, const TableReading& reading) {
  if (body.rigid && reading.has("material"))
    reading.refuse("material", fmt::format("rigid body '{}' has a material", body.name),
                   "remove 'material' or 'rigid'");
  if (!body.rigid && !reading.has("material") && !reading.has("fragments-of"))
    reading.in.out.error(reading.node.key_place,
                         fmt::format("'material' is missing in [{}]", reading.node.path),
                         "e.g. material = \"copper/ofhc-johnson-cook\", or rigid = true");
  if (reading.good("material") && reading.has("material") && body.material.empty())
    reading.wrong("material", "the material has no name", "`recoil material list` lists all");
}

/// A body has either a shape, or takes up fragments; then all else is that of the body that breaks.
void check_shape(Body& body, const TableReading& reading) {
  if (!reading.has("fragments-of")) {
    if (!reading.has("shape")) reading.missing("shape");
    return;
  }
  body.shape.form = Union{};
  if (reading.good("fragments-of") && body.fragments_of.empty())
    reading.wrong("fragments-of", "the body that breaks has no name", R"(e.g. fragments-of = "target")");
  for (const Key& key : reading.keys)
    if (key.name != "fragments-of" && reading.has(key.name))
      reading.refuse(
          key.name, fmt::format("'{}' and 'fragments-of' do not go together", key.name),
          "a body that takes up fragments begins empty, and has the material of the body that breaks");
}

/// The mass of a rigid body and how it turns go together.
void check_free_body(const Body& body, const TableReading& reading) {
  for (const char* key : {"mass", "inertia", "centre-of-mass"})
    if (reading.has(key) && !body.rigid)
      reading.refuse(key, fmt::format("'{}' is for rigid bodies", key),
                     "a deformable body has the mass of its material; or add rigid = true");
  for (const char* key : {"inertia", "centre-of-mass"})
    if (body.rigid && reading.has(key) && !reading.has("mass"))
      reading.refuse(key, fmt::format("'{}' needs 'mass'", key),
                     "a rigid body without a mass keeps its velocity");
  if (!body.rigid || !reading.has("mass") || !reading.has("inertia")) return;
  for (const double moment : body.inertia)
    if (moment < 0) reading.wrong("inertia", "a moment of inertia is negative");
  if (!reading.has("centre-of-mass"))
    reading.refuse("inertia", "'inertia' needs 'centre-of-mass', the point about which the body turns",
                   "e.g. centre-of-mass = { x = \"0 mm\", y = \"0 mm\" }");
}

void check_spin(const Body& body, const TableReading& reading) {
  if (body.mass > 0 && reading.has("spin-centre"))
    reading.refuse("spin-centre", "a free rigid body turns about its centre of mass",
                   "remove 'spin-centre', and give 'centre-of-mass'");
  if (reading.has("spin-centre") && !reading.has("spin"))
    reading.refuse("spin-centre", "'spin-centre' needs 'spin'");
  if (reading.has("spin") && !reading.has("spin-centre") && !(body.mass > 0))
    reading.refuse("spin", "'spin' needs 'spin-centre', the point about which the body turns",
                   "e.g. spin-centre = { x = \"0 mm\", y = \"0 mm\" }");
}

void check_radial(Body& body, const TableReading& reading) {
  const bool centre = reading.has("radial-centre"), speed = reading.has("radial-velocity");
  if (speed && body.rigid)
    reading.refuse("radial-velocity", "a rigid body cannot fly apart", "give it a 'velocity'");
  if (centre && !speed) reading.refuse("radial-centre", "'radial-centre' needs 'radial-velocity'");
  if (centre && reading.in.geometry == Geometry::spherical && body.radial_centre[0] != 0)
    reading.refuse("radial-centre", "'radial-centre' must be r = 0, the centre of symmetry", "leave it out");
  if (reading.has("radial-falls-from") && !speed)
    reading.refuse("radial-falls-from", "'radial-falls-from' needs 'radial-velocity'",
                   "e.g. radial-velocity = \"100 m/s\"");
  body.radial_from_axis = speed && !centre && has_radius(reading.in.geometry);
  if (speed && !centre && !body.radial_from_axis)
    reading.refuse("radial-velocity",
                   "'radial-velocity' needs 'radial-centre', the point that the body flies away from",
                   "e.g. radial-centre = { x = \"0 mm\" }");
}

void check_field(const Body& body, const TableReading& reading) {
  if (reading.has("velocity-field") && body.rigid)
    reading.refuse("velocity-field", "a rigid body cannot bend or stretch",
                   "give it a 'velocity' and a 'spin'");
}

void check_state(const Body& body, const TableReading& reading) {
  for (const char* key : {"pressure", "temperature"})
    if (body.rigid && reading.has(key))
      reading.refuse(key, fmt::format("a rigid body has no {}", key),
                     "remove it, or give the body a material");
}

bool turns(const Body& b) { return b.spin != Vector{}; }
bool is_free(const Body& b) { return b.mass > 0; }
bool has_start(const Body& b) { return !b.takes_up_fragments(); }

/// The geometries in which bodies turn.
std::vector<Geometry> turning() { return {Geometry::planar, Geometry::space}; }

std::vector<Geometry> beyond_1d() {
  return {Geometry::spherical, Geometry::planar, Geometry::axisymmetric, Geometry::space};
}

/// What the body is made of: a material, or a mass.
Entries<Body> keys_of_matter() {
  return {{.name = "material",
           .member = &Body::material,
           .doc = "a material of the library, or a [material.NAME] of this case",
           .example = R"("copper/ofhc-johnson-cook")",
           .when = [](const Body& b) { return !b.rigid && !b.takes_up_fragments(); }},
          {.name = "rigid",
           .member = &Body::rigid,
           .doc = "a rigid body: it has no material, and keeps its velocity unless it has a mass",
           .example = "true",
           .when = [](const Body& b) { return b.rigid; }},
          {.name = "mass",
           .member = &Body::mass,
           .unit = "kg",
           .positive = true,
           .optional = true,
           .doc = "of a rigid body that its contacts push (planar: per depth, kg/m; 1d: per area, kg/m2)",
           .example = R"("0.2 kg")",
           .only_in = {Geometry::line, Geometry::planar, Geometry::axisymmetric, Geometry::space},
           .unit_in = {"kg/m2", "kg", "kg/m", "kg", "kg"}},
          {.name = "inertia",
           .member = &Body::inertia,
           .unit = "kg m2",
           .optional = true,
           .rule = Rule::turn,
           .doc = "moment of inertia of a free rigid body about its centre of mass: planar a quantity per "
                  "depth (kg m); 3d { x = ..., y = ..., z = ... }, principal moments; without it the body "
                  "does not turn",
           .example = R"({ x = "2 kg m2", y = "2 kg m2", z = "1 kg m2" })",
           .only_in = turning(),
           .unit_in = {nullptr, nullptr, "kg m", nullptr, nullptr}},
          {.name = "centre-of-mass",
           .member = &Body::centre_of_mass,
           .unit = "m",
           .doc = "of a free rigid body, which turns about it; without it the centroid of its shape",
           .example = R"({ x = "1 mm" })",
           .when = [](const Body& b) { return b.has_centre_of_mass; }}};
}

/// How it flies apart, or together, at the start.
Entries<Body> keys_of_radial_motion() {
  return {
      {.name = "radial-velocity",
       .member = &Body::radial_velocity,
       .unit = "m/s",
       .optional = true,
       .doc = "at the start, away from radial-centre; without it away from r = 0 (axisymmetric, spherical)",
       .example = R"("100 m/s")"},
      {.name = "radial-centre",
       .member = &Body::radial_centre,
       .unit = "m",
       .doc = "the point that it flies away from",
       .example = R"({ x = "0 mm", y = "0 mm" })",
       .when = [](const Body& b) { return b.radial_velocity != 0 && !b.radial_from_axis; }},
      {.name = "radial-falls-from",
       .member = &Body::radial_falls_from,
       .unit = "m",
       .positive = true,
       .optional = true,
       .doc =
           "the distance from which radial-velocity falls as in matter of constant density: with the inverse "
           "of the distance (planar, from the axis) or of its square (3d, spherical, axisymmetric from a "
           "centre); "
           "without it, it is the same everywhere",
       .example = R"("80 mm")",
       .only_in = beyond_1d(),
       .when = [](const Body& b) { return b.radial_falls_from > 0; }}};
}

/// The state of its matter at the start, and what lights it.
Entries<Body> keys_of_state() {
  return {
      {.name = "pressure",
       .member = &Body::pressure,
       .unit = "Pa",
       .optional = true,
       .doc =
           "at the start, uniform, without shear stress; of a gas measured from that at rest; without it 0",
       .example = R"("1 GPa")",
       .when = [](const Body& b) { return b.pressure && has_start(b); }},
      {.name = "temperature",
       .member = &Body::temperature,
       .unit = "K",
       .positive = true,
       .optional = true,
       .doc = "at the start, uniform: density and energy are those of matter of this temperature at the "
              "pressure of the start; without it the material's initial-temperature",
       .example = R"("500 K")",
       .when = [](const Body& b) { return b.temperature && has_start(b); }},
      {.name = "detonation",
       .member = custom_table<&Body::detonation>(),
       .doc = "lights an explosive, a material with an equation of state of kind \"jwl\"",
       .example = R"({ points = [{ x = "0 mm" }] })",
       .when = [](const Body& b) { return !b.detonation.points.empty(); }}};
}

/// Where it is at the start, and how it moves.
Entries<Body> keys_of_start() {
  return {
      {.name = "shape",
       .member = custom_shape(),
       .doc = "where it is at the start; every body needs one but those with fragments-of",
       .example = R"({ kind = "sphere", radius = "5 mm" })",
       .when = has_start},
      {.name = "fragments-of",
       .member = &Body::fragments_of,
       .optional = true,
       .doc =
           "the name of a body that may break: this one begins empty and takes up fragments of it, so that "
           "fragments which come near each other touch and slide instead of welding",
       .example = R"("target")"},
      {.name = "velocity",
       .member = custom_velocity(),
       .unit = "m/s",
       .doc =
           "at the start; planar also { speed = \"1 km/s\", angle = \"-10 deg\" } from the x axis; 3d with "
           "elevation = \"30 deg\" as well, out of the plane of x and y",
       .example = R"({ x = "450 m/s" })",
       .when = [](const Body& b) { return b.velocity_history.empty() && !b.takes_up_fragments(); }},
      {.name = "spin",
       .member = &Body::spin,
       .unit = "rad/s",
       .optional = true,
       .rule = Rule::turn,
       .doc = "turning at the start: planar a quantity, counter-clockwise; 3d { x = ..., y = ..., z = ... }",
       .example = R"("1000 rad/s")",
       .only_in = turning()},
      {.name = "spin-centre",
       .member = &Body::spin_centre,
       .unit = "m",
       .doc = "the point about which it turns",
       .example = R"({ x = "1 mm" })",
       .when = [](const Body& b) { return turns(b) && !is_free(b); }},
      {.name = "velocity-field",
       .member = custom_table<&Body::velocity_field>(),
       .doc = "at the start, by formulas of the coordinates: bending, stretching, waves; added to 'velocity'",
       .example = "{ y = \"20*m/s * sin(pi*x/(60*mm))\" }",
       .when = [](const Body& b) { return b.velocity_field.is_given(); }},
      {.name = "velocity-history",
       .member = custom_velocity_history(),
       .unit = "m/s",
       .doc = "of a rigid body, over time: pairs of a time and a velocity; straight lines between them, "
              "constant before the first and after the last",
       .example = R"([["0 us", { x = "0 m/s" }], ["2 us", { x = "100 m/s" }]])",
       .when = [](const Body& b) { return !b.velocity_history.empty(); }}};
}

}  // namespace

Entries<Body> Body::keys() {
  Entries<Body> keys = keys_of_matter();
  for (const auto& more : {keys_of_start(), keys_of_radial_motion(), keys_of_state()})
    keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

void Body::check(const TableReading& reading) {
  check_shape(*this, reading);
  check_material(*this, reading);
  check_free_body(*this, reading);
  check_spin(*this, reading);
  check_radial(*this, reading);
  check_field(*this, reading);
  check_history(*this, reading);
  check_state(*this, reading);
  has_centre_of_mass = reading.has("centre-of-mass");
  if (is_free(*this)) spin_centre = centre_of_mass;
}

namespace {

/// Gives a body that takes up fragments what those are made of.
void follow_source(Body& body, const std::vector<Body>& bodies, const CaseReading& in) {
  if (!check_body(body.fragments_of, body.fragments_place, in)) return;
  const Body& source = *std::ranges::find(bodies, body.fragments_of, &Body::name);
  const char* fault = nullptr;
  if (source.rigid) fault = "a rigid body does not break";
  if (source.takes_up_fragments()) fault = "it takes up fragments itself: name the body that breaks";
  if (!source.detonation.points.empty()) fault = "an explosive that is lit leaves no fragments";
  if (fault)
    return in.out.error(body.fragments_place,
                        fmt::format("'{}' cannot take up fragments of '{}'", body.name, source.name), fault);
  body.material = source.material;
  body.material_place = source.material_place;
  body.pressure = source.pressure;
  body.temperature = source.temperature;
}

}  // namespace

void read_bodies(const Node& table, std::vector<Body>& bodies, CaseReading& in) {
  for (const Node& node : table.children) {
    if (!check_is_table(node, "body", in.out) || !check_name(node, "body", in.out)) continue;
    Body& body = bodies.emplace_back();
    body.name = node.key;
    body.place = node.key_place;
    const Record read = read_struct(node, body, in);
    body.material_place = read.place("material");
    body.fragments_place = read.place("fragments-of");
    in.bodies.push_back(body.name);
    if (body.rigid) in.rigid_bodies.push_back(body.name);
  }
  for (Body& body : bodies)
    if (body.takes_up_fragments()) follow_source(body, bodies, in);
  if (table.children.empty())
    in.out.error(table.key_place, "the case has no body",
                 "write [body.NAME] and give it a material and a shape");
}

}  // namespace recoil::config
