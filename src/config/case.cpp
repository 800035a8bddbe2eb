#include "config/case.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "config/declare/kinds.hpp"
#include "config/declare/part.hpp"

namespace recoil::config {

namespace {

void read_domain_of(Case& c, const Node& node, CaseReading& in) { read_domain(node, c.domain, in); }

Part<Case> part_of_domain() {
  Part<Case> part = part_of<&Case::domain>();
  part.read = read_domain_of;
  return part;
}

/// Tables with names of their own, one for each element of a member of the case. @tparam read reads all of
/// them, where what they speak of is `known`.
template <auto member, auto read, bool CaseReading::*known>
Part<Case> part_of_named() {
  using One = typename MemberOf<decltype(member)>::Value::value_type;
  return {[](Case& c, const Node& node, CaseReading& in) {
            if (in.*known) read(node, c.*member, in);
          },
          [](const std::string& path, std::vector<Section>& all) { add_sections<One>(path + ".*", all); },
          [](const Case& c, const std::string& path, const Writing& how, std::vector<WrittenTable>& all) {
            for (const One& one : c.*member) write_tables(one, path + '.' + one.name, how, all);
          }};
}

Part<Case> part_of_gauges() {
  return {[](Case& c, const Node& node, CaseReading& in) {
            if (in.knows_bodies) read_gauges(node, c.gauges, in);
          },
          [](const std::string& path, std::vector<Section>& all) { add_gauge_sections(path + ".*", all); },
          [](const Case& c, const std::string& path, const Writing& how, std::vector<WrittenTable>& all) {
            for (const Gauge& g : c.gauges) all.push_back({path + '.' + g.name, written_kind(g.kind, how)});
          }};
}

Part<Case> part_of_contact() {
  return {[](Case& c, const Node& node, CaseReading& in) {
            if (in.knows_bodies) read_contact(node, c.contact, in);
          },
          add_contact_sections,
          [](const Case& c, const std::string& path, const Writing& how, std::vector<WrittenTable>& all) {
            write_contact(c.contact, path, how, all);
          }};
}

Part<Case> part_of_expect() {
  return {
      [](Case& c, const Node& node, CaseReading& in) { c.expect = read_expectations(node, in.out); },
      [](const std::string& path, std::vector<Section>& all) { add_sections<Expectation>(path + ".*", all); },
      [](const Case& c, const std::string&, const Writing&, std::vector<WrittenTable>& all) {
        if (!c.expect.empty()) all.push_back(write_expectations(c.expect, c.file));
      }};
}

/// Read by material/library, with sections of its own.
Part<Case> part_of_materials() {
  return {[](Case&, const Node&, CaseReading&) {}, [](const std::string&, std::vector<Section>&) {},
          [](const Case&, const std::string&, const Writing&, std::vector<WrittenTable>&) {}};
}

}  // namespace

Entries<Case> Case::keys() {
  return {
      {.name = "format",
       .member = &Case::format,
       .least = 1,
       .doc = "version of the case format",
       .example = "1"},
      {.name = "title",
       .member = &Case::title,
       .doc = "one line that names the case in reports",
       .example = R"("Aluminium on copper")"},
      {.name = "cite",
       .member = &Case::cite,
       .doc = "what to cite with results of this case",
       .example = R"(["marsh1980"])"},
      {.name = "domain", .member = part_of_domain(), .required = true, .doc = "the space that is computed"},
      {.name = "mesh", .member = part_of<&Case::mesh>(), .required = true, .doc = "the cells"},
      {.name = "refine",
       .member = part_of_named<&Case::regions, read_regions, &CaseReading::knows_domain>(),
       .doc = "parts of the domain with the finest cells, one [refine.NAME] each"},
      {.name = "time",
       .member = part_of<&Case::time>(),
       .required = true,
       .doc = "how long, and in which steps"},
      {.name = "body",
       .member = part_of_named<&Case::bodies, read_bodies, &CaseReading::knows_domain>(),
       .required = true,
       .doc = "the bodies, one [body.NAME] each"},
      {.name = "load",
       .member = part_of_named<&Case::loads, read_loads, &CaseReading::knows_bodies>(),
       .doc = "pressures from outside on surfaces, one [load.NAME] each"},
      {.name = "material",
       .member = part_of_materials(),
       .doc = "materials of this case alone, one [material.NAME] each"},
      {.name = "gauge", .member = part_of_gauges(), .doc = "records over time, one [gauge.NAME] each"},
      {.name = "contact", .member = part_of_contact(), .doc = "what happens where bodies meet"},
      {.name = "method", .member = part_of<&Case::method>(), .doc = "the numerical method"},
      {.name = "limits", .member = part_of<&Case::limits>(), .doc = "what makes a run doubtful, or stops it"},
      {.name = "output", .member = part_of<&Case::output>(), .doc = "what is written, and how often"},
      {.name = "expect", .member = part_of_expect(), .doc = "what the results are checked against"}};
}

const std::vector<Section>& case_sections() {
  static const std::vector<Section> all = [] {
    std::vector<Section> sections;
    add_sections<Case>("", sections);
    return sections;
  }();
  return all;
}

std::vector<WrittenTable> written_tables(const Case& c) {
  std::vector<WrittenTable> all;
  write_tables(c, "", {c.domain.geometry, axes_of(c.domain.geometry)}, all);
  return all;
}

namespace {

/// The largest speed that a body can have by itself at the start, besides its velocity [m/s]; not that of its
/// turning.
double own_speed(const Body& body, const Domain& domain) {
  Bounds b = bounds_of(body.shape, domain);
  for (std::size_t d = 0; d < 3; ++d) {
    b.lo[d] = std::clamp(b.lo[d], domain.lo[d], domain.hi[d]);
    b.hi[d] = std::clamp(b.hi[d], domain.lo[d], domain.hi[d]);
  }
  return std::abs(body.radial_velocity) + fastest_in(body.velocity_field, domain.geometry, b.lo, b.hi);
}

}  // namespace

double largest_closing_speed(const Case& c) {
  const auto velocities_of = [](const Body& body) {
    std::vector<Vector> all{body.velocity};
    for (const TimedVelocity& at : body.velocity_history) all.push_back(at.velocity);
    return all;
  };
  double largest = 0;
  for (const Body& a : c.bodies)
    for (const Body& b : c.bodies) {
      if (a.takes_up_fragments() || b.takes_up_fragments()) continue;  // they begin empty
      for (const Vector& u : velocities_of(a))
        for (const Vector& v : velocities_of(b))
          largest = std::max(largest, std::hypot(u[0] - v[0], u[1] - v[1], u[2] - v[2]) +
                                          own_speed(a, c.domain) + own_speed(b, c.domain));
    }
  return largest;
}

}  // namespace recoil::config
