#include "config/read_body.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/closest.hpp"
#include "core/error.hpp"

namespace recoil::config {

namespace {

std::vector<std::string> names_of(const std::vector<Body>& bodies) {
  std::vector<std::string> names;
  for (const Body& body : bodies) names.push_back(body.name);
  return names;
}

/// Names become names of files and columns.
bool check_name(const Node& node, const char* what, Diagnostics& out) {
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  const bool good = !node.key.empty() && std::all_of(node.key.begin(), node.key.end(), fits);
  if (!good)
    out.error(node.key_place, fmt::format("'{}' cannot be the name of a {}", node.key, what),
              "use letters, digits, _ and -");
  if (good && node.key == "total") {
    out.error(node.key_place, fmt::format("'total' cannot be the name of a {}", what),
              "history.csv calls the sum over all bodies so");
    return false;
  }
  return good;
}

Vector read_velocity(const Node& node, const Key& key, const CaseReading& in) {
  if (!node.find("speed") && !node.find("angle")) return read_vector(node, key, in.out, in.axes);
  const Record polar = read_record(node, keys_of("body.*.velocity", "polar"), in.out);
  if (in.geometry != Geometry::planar) {
    in.out.error(node.place,
                 fmt::format("a velocity by speed and angle exists in geometry \"planar\" only, not \"{}\"",
                             name_of(in.geometry)),
                 fmt::format("give its components {}", fmt::join(in.axes, ", ")));
    return {};
  }
  const double speed = polar.number("speed"), angle = polar.number("angle");
  return {speed * std::cos(angle), speed * std::sin(angle), 0};
}

Vector read_spin(const Node& node, const Key& key, const CaseReading& in) {
  if (in.geometry == Geometry::space) return read_vector(node, key, in.out, in.axes);
  if (in.geometry == Geometry::planar)
    return {0, 0, read_quantity(node, key.name, key.unit, in.out, key.example)};
  in.out.error(node.key_place,
               fmt::format("'{}' means nothing for geometry \"{}\"", key.name, name_of(in.geometry)),
               "it exists in planar and 3d cases");
  return {};
}

const char* mass_unit(Geometry geometry) {
  return geometry == Geometry::line ? "kg/m2" : geometry == Geometry::planar ? "kg/m" : "kg";
}

/// The mass of a rigid body and how it turns; what goes together is checked.
void read_free_body(const Record& record, const Key& inertia, Body& body, const CaseReading& in) {
  for (const char* key : {"mass", "inertia", "centre-of-mass"})
    if (record.has(key) && !body.rigid)
      in.out.error(record.key_place(key), fmt::format("'{}' is for rigid bodies", key),
                   "a deformable body has the mass of its material; or add rigid = true");
  for (const char* key : {"inertia", "centre-of-mass"})
    if (body.rigid && record.has(key) && !record.has("mass"))
      in.out.error(record.key_place(key), fmt::format("'{}' without 'mass' means nothing", key),
                   "a rigid body without a mass keeps its velocity");
  if (!body.rigid || !record.has("mass")) return;
  body.mass = record.number("mass");
  body.centre_of_mass = record.vector3("centre-of-mass");
  if (const Node* i = record.node("inertia")) {
    Key key = inertia;
    if (in.geometry == Geometry::planar) key.unit = "kg m";
    body.inertia = read_spin(*i, key, in);
    for (const double moment : body.inertia)
      if (moment < 0) in.out.error(record.place("inertia"), "a moment of inertia is negative");
    if (!record.has("centre-of-mass"))
      in.out.error(record.key_place("inertia"),
                   "'inertia' needs 'centre-of-mass', the point about which the body turns",
                   "e.g. centre-of-mass = { x = \"0 mm\", y = \"0 mm\" }");
  }
}

Body read_body(const Node& node, const CaseReading& in) {
  std::vector<Key> keys(keys_of("body.*").begin(), keys_of("body.*").end());
  const Key velocity =
      *std::find_if(keys.begin(), keys.end(), [](const Key& k) { return k.name == "velocity"; });
  const Key spin = *std::find_if(keys.begin(), keys.end(), [](const Key& k) { return k.name == "spin"; });
  const Key inertia =
      *std::find_if(keys.begin(), keys.end(), [](const Key& k) { return k.name == "inertia"; });
  for (Key& key : keys) {
    if (key.name == "velocity") key.type = Key::Type::any;  // has two forms: read below
    if (key.name == "mass") key.unit = mass_unit(in.geometry);
  }
  const Record record = read_record(node, keys, in.out, in.axes);
  Body body;
  body.name = node.key;
  body.place = node.key_place;
  body.material = record.text("material");
  body.material_place = record.place("material");
  body.rigid = record.flag("rigid");
  if (body.rigid && record.has("material"))
    in.out.error(record.key_place("material"), fmt::format("rigid body '{}' has a material", body.name),
                 "take out 'material' or 'rigid'");
  if (!body.rigid && !record.has("material"))
    in.out.error(node.key_place, fmt::format("'material' is missing in [{}]", node.path),
                 "e.g. material = \"copper/ofhc-johnson-cook\", or rigid = true");
  if (record.good("shape")) body.shape = read_shape(*record.node("shape"), in);
  if (const Node* v = record.node("velocity")) body.velocity = read_velocity(*v, velocity, in);
  if (const Node* s = record.node("spin")) body.spin = read_spin(*s, spin, in);
  read_free_body(record, inertia, body, in);
  body.spin_centre = body.mass > 0 ? body.centre_of_mass : record.vector3("spin-centre");
  if (body.mass > 0 && record.has("spin-centre"))
    in.out.error(record.key_place("spin-centre"), "a free rigid body turns about its centre of mass",
                 "take out 'spin-centre', and give 'centre-of-mass'");
  if (record.has("spin-centre") && !record.has("spin"))
    in.out.error(record.key_place("spin-centre"), "'spin-centre' without 'spin' means nothing");
  if (record.has("spin") && !record.has("spin-centre") && !(body.mass > 0))
    in.out.error(record.key_place("spin"), "'spin' needs 'spin-centre', the point about which the body turns",
                 "e.g. spin-centre = { x = \"0 mm\", y = \"0 mm\" }");
  return body;
}

/// The table of tables must hold tables only.
bool check_is_table(const Node& node, const char* what, Diagnostics& out) {
  if (node.is_table()) return true;
  out.error(node.key_place, fmt::format("'{}' is no {}, but {}", node.key, what, describe(node)),
            fmt::format("write [{}.NAME] above the keys of a {}", what, what));
  return false;
}

void report_unknown_body(const Place& place, const std::string& name, const std::vector<std::string>& names,
                         Diagnostics& out) {
  const std::string near = did_you_mean(name, names);
  out.error(place, fmt::format("there is no body '{}'", name),
            !near.empty() ? near : fmt::format("the bodies are: {}", fmt::join(names, ", ")));
}

void check_inside(const Gauge& gauge, const Vector& at, const Place& place, const Domain& domain,
                  const CaseReading& in) {
  for (std::size_t d = 0; d < in.axes.size(); ++d) {
    if (domain.lo[d] >= domain.hi[d]) continue;  // reported already
    if (at[d] >= domain.lo[d] && at[d] <= domain.hi[d]) continue;
    in.out.error(
        place,
        fmt::format("gauge '{}' lies outside the domain: {} = {:.6g} mm, the domain reaches from {:.6g} "
                    "to {:.6g} mm",
                    gauge.name, in.axes[d], 1e3 * at[d], 1e3 * domain.lo[d], 1e3 * domain.hi[d]),
        "move it, or make the domain larger");
  }
}

/// A unit vector; in 1d there is only one direction.
Vector read_direction(const Record& record, const CaseReading& in) {
  const Vector v = record.vector3("direction");
  if (in.geometry == Geometry::line)
    in.out.error(record.key_place("direction"), "'direction' means nothing for geometry \"1d\"",
                 "take it out: force.x and impulse.x say it all");
  else if (v == Vector{})
    in.out.error(record.key_place("direction"), "'direction' has no direction: all its components are 0",
                 "e.g. direction = { x = 1, y = 1 }");
  return normalised(v);
}

Gauge::Kind kind_of_gauge(const std::string& name) {
  using enum Gauge::Kind;
  constexpr std::pair<const char*, Gauge::Kind> kinds[] = {{"surface-velocity", surface_velocity},
                                                           {"point", point},
                                                           {"body", body},
                                                           {"contact", contact},
                                                           {"bar", bar},
                                                           {"attitude", attitude},
                                                           {"peak-stress", peak_stress}};
  for (const auto& [word, kind] : kinds)
    if (name == word) return kind;
  throw InternalError("internal error: no gauge of kind '" + name + "'");
}

/// A bar has an axis and a radius; a body turns and points somewhere in a plane.
void check_geometry(const Gauge& gauge, const std::string& kind, const CaseReading& in) {
  const bool bar = gauge.kind == Gauge::Kind::bar, attitude = gauge.kind == Gauge::Kind::attitude;
  const bool round = in.geometry == Geometry::axisymmetric || in.geometry == Geometry::space;
  const bool turns = in.geometry == Geometry::planar || in.geometry == Geometry::space;
  if ((bar && !round) || (attitude && !turns))
    in.out.error(
        gauge.place,
        fmt::format("a gauge of kind \"{}\" has no meaning in {} geometry", kind, name_of(in.geometry)),
        bar ? "it needs axisymmetric or 3d" : "it needs planar or 3d");
}

Gauge read_gauge(const Node& node, const std::vector<std::string>& names, const Domain& domain,
                 const CaseReading& in) {
  const Record record = read_record(node, keys_of("gauge.*"), in.out, in.axes);
  Gauge gauge;
  gauge.name = node.key;
  gauge.place = node.key_place;
  gauge.every = record.number("every");
  if (!record.good("kind")) return gauge;
  const std::string& kind = record.text("kind");
  using enum Gauge::Kind;
  gauge.kind = kind_of_gauge(kind);
  const bool has_line = gauge.kind == peak_stress;
  const bool needs_at = gauge.kind == surface_velocity || gauge.kind == point || has_line;
  const auto check_use = [&](const char* key, bool used, const std::string& example) {
    if (used && !record.has(key))
      in.out.error(node.key_place, fmt::format("'{}' is missing in [{}]", key, node.path),
                   fmt::format("a gauge of kind \"{}\" needs it, e.g. {} = {}", kind, key, example));
    if (!used && record.has(key))
      in.out.error(record.key_place(key),
                   fmt::format("'{}' means nothing for a gauge of kind \"{}\"", key, kind));
    return used && record.good(key);
  };
  const std::string body_name = names.empty() ? "target" : names.back();
  if (check_use("body", gauge.kind != contact, '"' + body_name + '"')) {
    gauge.body = record.text("body");
    if (std::find(names.begin(), names.end(), gauge.body) == names.end())
      report_unknown_body(record.place("body"), gauge.body, names, in.out);
  }
  if (check_use("pair", gauge.kind == contact, "\"flyer-target\""))
    gauge.pair = read_pair(record.text("pair"), record.place("pair"), names, in.out);
  const bool part = gauge.kind == contact && (record.has("at") || record.has("radius"));
  if (check_use("at", needs_at || part, fmt::format("{{ {} = \"1 mm\" }}", in.axes.front()))) {
    gauge.at = record.vector3("at");
    check_inside(gauge, gauge.at, record.place("at"), domain, in);
  }
  if (check_use("radius", part, "\"2 mm\"")) gauge.radius = record.number("radius");
  if (record.has("direction") && check_use("direction", gauge.kind == contact, ""))
    gauge.direction = read_direction(record, in);
  if (check_use("wall", gauge.kind == bar, "\"wall\"")) {
    gauge.wall = record.text("wall");
    if (std::find(names.begin(), names.end(), gauge.wall) == names.end())
      report_unknown_body(record.place("wall"), gauge.wall, names, in.out);
    else if (gauge.wall == gauge.body)
      in.out.error(record.place("wall"), fmt::format("'{}' cannot stand on itself", gauge.body),
                   "name the other body of the impact");
  }
  if (check_use("to", has_line, fmt::format("{{ {} = \"10 mm\" }}", in.axes.front()))) {
    gauge.to = record.vector3("to");
    check_inside(gauge, gauge.to, record.place("to"), domain, in);
    if (gauge.to == gauge.at)
      in.out.error(record.place("to"), "the line from 'at' to 'to' has no length", "move its end");
  }
  if (has_line) gauge.stations = static_cast<int>(record.integer("stations"));
  for (const char* key : {"stations", "every"})
    if (record.has(key) && has_line == (std::string_view(key) == "every")) check_use(key, false, "");
  check_geometry(gauge, kind, in);
  return gauge;
}

}  // namespace

std::vector<Body> read_bodies(const Node& table, const CaseReading& in) {
  std::vector<Body> bodies;
  for (const Node& node : table.children)
    if (check_is_table(node, "body", in.out) && check_name(node, "body", in.out))
      bodies.push_back(read_body(node, in));
  if (table.children.empty())
    in.out.error(table.key_place, "the case has no body",
                 "write [body.NAME] and give it a material and a shape");
  return bodies;
}

std::vector<Gauge> read_gauges(const Node& table, const std::vector<Body>& bodies, const Domain& domain,
                               const CaseReading& in) {
  std::vector<Gauge> gauges;
  const std::vector<std::string> names = names_of(bodies);
  for (const Node& node : table.children)
    if (check_is_table(node, "gauge", in.out) && check_name(node, "gauge", in.out))
      gauges.push_back(read_gauge(node, names, domain, in));
  return gauges;
}

std::vector<std::array<std::string, 2>> pairs_named(std::string_view pair,
                                                    const std::vector<std::string>& names) {
  std::vector<std::array<std::string, 2>> found;
  const auto known = [&](std::string_view s) {
    return std::find(names.begin(), names.end(), s) != names.end();
  };
  for (std::size_t i = 1; i + 1 < pair.size(); ++i) {
    const std::string_view a = pair.substr(0, i), b = pair.substr(i + 1);
    if (pair[i] == '-' && known(a) && known(b)) found.push_back({std::string(a), std::string(b)});
  }
  return found;
}

std::array<std::string, 2> read_pair(const std::string& pair, const Place& place,
                                     const std::vector<std::string>& names, Diagnostics& out) {
  const auto found = pairs_named(pair, names);
  if (found.size() == 1 && found[0][0] != found[0][1]) return found[0];
  if (found.size() > 1) {
    out.error(place, fmt::format("'{}' can be read as more than one pair of bodies", pair), "rename a body");
    return {};
  }
  std::vector<std::string> all;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i + 1; j < names.size(); ++j) all.push_back(names[i] + '-' + names[j]);
  const std::string near = did_you_mean(pair, all);
  out.error(place, fmt::format("'{}' is no pair of two bodies", pair),
            !near.empty() ? near : fmt::format("the pairs are: {}", fmt::join(all, ", ")));
  return {};
}

void check_expected_names(const std::vector<Expectation>& expect, const std::vector<Body>& bodies,
                          const std::vector<Gauge>& gauges, Diagnostics& out) {
  const std::vector<std::string> names = names_of(bodies);
  std::vector<std::string> gauge_names;
  for (const Gauge& gauge : gauges) gauge_names.push_back(gauge.name);
  for (const Expectation& e : expect) {
    const std::size_t dot = e.quantity.find('.');
    if (dot == std::string::npos) continue;
    const std::string first = e.quantity.substr(0, dot);
    const std::string name = e.quantity.substr(dot + 1, e.quantity.find('.', dot + 1) - dot - 1);
    if (first == "contact") {
      read_pair(name, e.place, names, out);
    } else if (first == "body" && name != "total" &&
               std::find(names.begin(), names.end(), name) == names.end()) {
      report_unknown_body(e.place, name, names, out);
    } else if (first == "gauge" &&
               std::find(gauge_names.begin(), gauge_names.end(), name) == gauge_names.end()) {
      const std::string near = did_you_mean(name, gauge_names);
      out.error(e.place, fmt::format("there is no gauge '{}'", name),
                !near.empty() ? near : "write a [gauge." + name + "]");
    }
  }
}

}  // namespace recoil::config
