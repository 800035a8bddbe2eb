#include "config/read_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/overrides.hpp"
#include "config/read_body.hpp"
#include "config/read_contact.hpp"
#include "config/read_expect.hpp"
#include "config/read_shape.hpp"
#include "config/table.hpp"

namespace recoil::config {

namespace {

const Node& table_or_empty(const Node& parent, const char* name) {
  static const Node empty = [] {
    Node n;
    n.kind = Node::Kind::table;
    return n;
  }();
  const Node* node = parent.find(name);
  return node && node->is_table() ? *node : empty;
}

/// The geometry that the keys of a domain suggest: for reading on after a wrong or missing `geometry`.
Geometry guess_geometry(const Node& domain) {
  if (domain.find("r")) return Geometry::axisymmetric;
  if (domain.find("z")) return Geometry::space;
  return domain.find("y") ? Geometry::planar : Geometry::line;
}

Geometry geometry_of(const Record& domain, const Node& node) {
  const std::string& name = domain.text("geometry");
  for (const Geometry g : {Geometry::line, Geometry::planar, Geometry::axisymmetric, Geometry::space})
    if (name_of(g) == name) return g;
  return guess_geometry(node);
}

Boundary boundary_of(const std::string& name) {
  return name == "symmetry"   ? Boundary::symmetry
         : name == "periodic" ? Boundary::periodic
         : name == "axis"     ? Boundary::axis
                              : Boundary::outflow;
}

void check_boundary(const Record& record, const std::string& axis, const std::array<Boundary, 2>& ends,
                    bool at_axis, Diagnostics& out) {
  const Place place = record.place(axis);
  if ((ends[0] == Boundary::periodic) != (ends[1] == Boundary::periodic))
    out.error(place, fmt::format("only one end of {} is periodic", axis), "write \"periodic\" for both");
  if (ends[1] == Boundary::axis || (ends[0] == Boundary::axis && !at_axis))
    out.error(place,
              fmt::format("'axis' is only the low end of r, where r starts at 0, not an end of {}", axis),
              "use symmetry");
  if (at_axis && (ends[0] == Boundary::outflow || ends[0] == Boundary::periodic))
    out.error(place, "the low end of r is the axis r = 0, nothing flows out there", "write \"axis\"");
}

void read_boundaries(const Node& node, Domain& domain, const CaseReading& in) {
  const Record record = read_record(node, keys_of("domain.boundary"), in.out);
  for (const char* name : {"x", "y", "r", "z"}) {
    const auto axis = std::find(in.axes.begin(), in.axes.end(), name);
    if (axis == in.axes.end()) {
      if (record.has(name))
        in.out.error(record.key_place(name), fmt::format("'{}' is no coordinate of this geometry", name),
                     fmt::format("its coordinates are {}", fmt::join(in.axes, ", ")));
      continue;
    }
    const auto d = static_cast<std::size_t>(axis - in.axes.begin());
    const bool at_axis = *axis == "r" && domain.lo[0] == 0;
    domain.boundary[d] = {at_axis ? Boundary::axis : Boundary::outflow, Boundary::outflow};
    const std::vector<std::string>& kinds = record.texts(name);
    if (!record.good(name)) continue;
    if (kinds.empty() || kinds.size() > 2) {
      in.out.error(record.place(name),
                   fmt::format("'{}' needs one kind of boundary or two, [low, high]", name));
      continue;
    }
    domain.boundary[d] = {boundary_of(kinds.front()), boundary_of(kinds.back())};
    if (at_axis && kinds.size() == 1) domain.boundary[d][0] = Boundary::axis;
    if (at_axis && domain.boundary[d][0] == Boundary::symmetry) domain.boundary[d][0] = Boundary::axis;
    check_boundary(record, name, domain.boundary[d], at_axis, in.out);
  }
}

void read_domain(const Node& node, const Record& record, Domain& domain, const CaseReading& in) {
  domain.geometry = in.geometry;
  if (!node.path.empty() && read_extents(record, "domain", in, domain.lo, domain.hi) &&
      in.geometry == Geometry::axisymmetric && domain.lo[0] < 0)
    in.out.error(record.place("r"), "r begins below 0",
                 "an axisymmetric domain begins at the axis: r = [\"0 mm\", ...]");
  Node none;
  none.kind = Node::Kind::table;
  read_boundaries(record.good("boundary") ? *record.node("boundary") : none, domain, in);
}

void check_cells(const Domain& domain, const MeshChoice& mesh, const Record& record, const CaseReading& in) {
  for (std::size_t d = 0; d < in.axes.size(); ++d) {
    const double extent = domain.hi[d] - domain.lo[d];
    if (!(extent > 0) || !(mesh.finest > 0) || extent >= 3.999 * mesh.finest) continue;
    in.out.error(record.place("finest"),
                 fmt::format("the domain is {:.3g} cells wide along {}; at least 4 are needed",
                             extent / mesh.finest, in.axes[d]),
                 fmt::format("finest = \"{:.4g} mm\" gives 40", 1e3 * extent / 40));
  }
}

void read_mesh(const Node& node, const Domain& domain, MeshChoice& mesh, const CaseReading& in) {
  const Record record = read_record(node, keys_of("mesh"), in.out);
  mesh.finest = record.number("finest");
  mesh.offset = record.number("offset");
  mesh.block = static_cast<int>(record.integer("block"));
  if (record.good("finest")) check_cells(domain, mesh, record, in);
}

TimeChoice read_time(const Node& node, Diagnostics& out) {
  const Record record = read_record(node, keys_of("time"), out);
  TimeChoice time;
  time.end = record.number("end");
  time.cfl = record.number("cfl");
  if (record.good("fixed-dt")) time.fixed_dt = record.number("fixed-dt");
  if (record.has("fixed-dt") && record.has("cfl"))
    out.error(record.key_place("fixed-dt"), "'fixed-dt' and 'cfl' exclude each other",
              "take one of them out");
  return time;
}

Output read_output(const Node& node, Diagnostics& out) {
  read_record(node, keys_of("output"), out);
  const Record fields = read_record(table_or_empty(node, "fields"), keys_of("output.fields"), out);
  const Record history = read_record(table_or_empty(node, "history"), keys_of("output.history"), out);
  return {fields.number("every"), fields.texts("variables"), history.number("every")};
}

Method read_method(const Node& node, Diagnostics& out) {
  const Record record = read_record(node, keys_of("method"), out);
  const Method method{record.text("scheme"), record.number("kappa")};
  if (record.has("kappa") && method.scheme != "seed")
    out.error(record.key_place("kappa"),
              fmt::format("'kappa' has no meaning for scheme = \"{}\"", method.scheme),
              "take it out, or use scheme = \"seed\": the other schemes close gaps without a tolerance");
  return method;
}

/// A newer file may hold anything, so it is not read any further.
bool check_format(const Document& document, Diagnostics& out) {
  const Node* node = document.root.find("format");
  if (!node || node->kind != Node::Kind::integer || node->integer <= case_format) return true;
  out.error(node->place,
            fmt::format("this case has format {}, but this recoil reads formats up to {}", node->integer,
                        case_format),
            "use a newer recoil");
  return false;
}

/// The ghost-fluid schemes know frictionless contact that parts, and nothing else.
void check_contact_of_scheme(const Case& c, const Node& root, Diagnostics& out) {
  using enum ContactChoice::Mode;
  bool other = c.contact.usual.mode != separable;
  for (const Contact::Pair& p : c.contact.pairs) other = other || p.choice.mode != separable;
  if (!other || c.method.scheme == "conservative") return;
  out.error(root.find("contact")->key_place,
            fmt::format("scheme = \"{}\" knows separable contact without friction only", c.method.scheme),
            "use scheme = \"conservative\"");
}

void read_sections(const Node& root, const Record& top, Case& c, Diagnostics& out) {
  const Node& domain_node = table_or_empty(root, "domain");
  Record domain;
  if (top.good("domain")) domain = read_record(domain_node, keys_of("domain"), out);
  const Geometry geometry = top.good("domain") ? geometry_of(domain, domain_node) : Geometry::space;
  const CaseReading in{geometry, axes_of(geometry), out};
  if (top.good("domain")) read_domain(domain_node, domain, c.domain, in);
  if (top.good("mesh")) read_mesh(*root.find("mesh"), c.domain, c.mesh, in);
  if (top.good("time")) c.time = read_time(*root.find("time"), out);
  c.output = read_output(table_or_empty(root, "output"), out);
  c.method = read_method(table_or_empty(root, "method"), out);
  c.expect = read_expectations(table_or_empty(root, "expect"), out);
  // Without a domain the coordinates are not known: bodies would only give errors that follow from that one.
  if (!top.good("domain") || !top.good("body")) return;
  c.bodies = read_bodies(*root.find("body"), in);
  c.contact = read_contact(table_or_empty(root, "contact"), c.bodies, out);
  check_contact_of_scheme(c, root, out);
  c.gauges = read_gauges(table_or_empty(root, "gauge"), c.bodies, c.domain, in);
  check_expected_names(c.expect, c.bodies, c.gauges, out);
}

}  // namespace

Case read_case(const Document& document, Diagnostics& out) {
  Case c;
  c.file = document.name;
  c.text = document.text;
  if (!document.complete || !check_format(document, out)) return c;
  const Record top = read_record(document.root, keys_of(""), out);
  c.format = static_cast<int>(top.integer("format"));
  c.title = top.text("title");
  c.cite = top.texts("cite");
  read_sections(document.root, top, c, out);
  return c;
}

Case read_case(const std::string& path, Document& document, Diagnostics& out,
               const std::vector<std::string>& overrides) {
  document = read_document(path, out);
  if (document.complete) apply_overrides(document, overrides, out);
  return read_case(document, out);
}

}  // namespace recoil::config
