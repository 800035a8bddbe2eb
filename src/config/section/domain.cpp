#include "config/section/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "config/declare/extents.hpp"
#include "config/declare/part.hpp"

namespace recoil::config {

namespace {

const std::vector<std::string> boundary_names{"outflow", "symmetry", "periodic", "axis"};

std::size_t axis_number(const std::vector<std::string>& axes, const std::string& name) {
  return static_cast<std::size_t>(std::find(axes.begin(), axes.end(), name) - axes.begin());
}

bool starts_at_axis(const CaseReading& in, const std::string& axis) { return axis == "r" && in.lo[0] == 0; }

void check_ends(const TableReading& reading, const std::string& axis, const std::array<Boundary, 2>& ends,
                bool at_axis) {
  if (axis == "r" && (ends[0] == Boundary::periodic || ends[1] == Boundary::periodic))
    return reading.wrong(axis, "a radius has no period", "write \"outflow\", or \"symmetry\" for a wall");
  if ((ends[0] == Boundary::periodic) != (ends[1] == Boundary::periodic))
    reading.wrong(axis, fmt::format("only one end of {} is periodic", axis), "write \"periodic\" for both");
  if (ends[1] == Boundary::axis || (ends[0] == Boundary::axis && !at_axis))
    reading.wrong(axis,
                  fmt::format("'axis' is only the low end of r, where r starts at 0, not an end of {}", axis),
                  at_axis ? "e.g. r = [\"axis\", \"outflow\"]" : "use symmetry");
  if (at_axis && (ends[0] == Boundary::outflow || ends[0] == Boundary::periodic))
    reading.wrong(axis, "the low end of r is the axis r = 0, nothing flows out there", "write \"axis\"");
}

void read_ends(Boundaries& boundary, const TableReading& reading, const Key& key) {
  const std::vector<std::string>& kinds = reading.record.texts(key.name);
  if (kinds.empty() || kinds.size() > 2)
    return reading.wrong(key.name,
                         fmt::format("'{}' needs one kind of boundary or two, [low, high]", key.name),
                         fmt::format("e.g. {} = [\"symmetry\", \"outflow\"]", key.name));
  const auto named = [](const std::string& kind) {
    return static_cast<Boundary>(axis_number(boundary_names, kind));
  };
  std::array<Boundary, 2>& ends = boundary[axis_number(reading.in.axes, key.name)];
  const bool at_axis = starts_at_axis(reading.in, key.name);
  ends = {named(kinds.front()), named(kinds.back())};
  if (at_axis && (kinds.size() == 1 || ends[0] == Boundary::symmetry)) ends[0] = Boundary::axis;
  check_ends(reading, key.name, ends, at_axis);
}

std::string write_ends(const Boundaries& boundary, const char* name, const Writing& how) {
  const auto& [low, high] = boundary[axis_number(how.axes, name)];
  return written_list(
      {boundary_names[static_cast<std::size_t>(low)], boundary_names[static_cast<std::size_t>(high)]});
}

Entry<Boundaries> ends(const char* axis, const char* doc, std::vector<Geometry> only_in) {
  return {.name = axis,
          .member = Custom<Boundaries>{Key::Type::texts, true, read_ends, write_ends},
          .doc = doc,
          .example = R"(["symmetry", "outflow"])",
          .choices = boundary_names,
          .only_in = std::move(only_in)};
}

}  // namespace

Entries<Boundaries> Boundaries::keys() {
  using enum Geometry;
  return {ends("x", "ends of x; without it outflow", {line, planar, space}),
          ends("y", "ends of y; without it outflow", {planar, space}),
          ends("r", "ends of r; without it outflow, and axis where r starts at 0", {axisymmetric, spherical}),
          ends("z", "ends of z; without it outflow", {axisymmetric, space})};
}

Entries<Domain> Domain::keys() {
  const auto extent = extent_along<Domain>;
  return {
      {.name = "geometry",
       .member = choice_of<&Domain::geometry>(),
       .required = true,
       .doc = "1d (uniaxial strain), spherical (r alone), planar (plane strain), axisymmetric (r, z) or 3d",
       .example = R"("axisymmetric")",
       .choices = {geometry_names.begin(), geometry_names.end()}},
      extent("x", "extent along x: 1d, planar, 3d"),
      extent("y", "extent along y: planar, 3d"),
      extent("r", "extent along the radius: axisymmetric, spherical"),
      extent("z", "extent along z: axisymmetric, 3d"),
      {.name = "boundary", .member = part_of<&Domain::boundary>(), .doc = "what lies beyond the edges"}};
}

void Domain::check(const TableReading& reading) const {
  if (has_radius(reading.in.geometry) && lo[0] < 0)
    reading.wrong("r", "r begins below 0",
                  reading.in.geometry == Geometry::spherical
                      ? "a spherical domain begins at the centre: r = [\"0 mm\", ...]"
                      : "an axisymmetric domain begins at the axis: r = [\"0 mm\", ...]");
}

Geometry geometry_of(const Node& domain) {
  const Node* named = domain.find("geometry");
  for (std::size_t g = 0; g < geometry_names.size(); ++g)
    if (named && named->is_text() && named->text == geometry_names[g]) return static_cast<Geometry>(g);
  if (domain.find("r")) return domain.find("z") ? Geometry::axisymmetric : Geometry::spherical;
  if (domain.find("z")) return Geometry::space;
  return domain.find("y") ? Geometry::planar : Geometry::line;
}

void read_domain(const Node& node, Domain& domain, CaseReading& in) {
  const Record record = read_struct(node, domain, in);
  domain.geometry = in.geometry;
  in.lo = domain.lo;
  in.hi = domain.hi;
  if (starts_at_axis(in, in.axes.front())) domain.boundary[0][0] = Boundary::axis;
  read_parts(node, domain, in, record);
}

}  // namespace recoil::config
