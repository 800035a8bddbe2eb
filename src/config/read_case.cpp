#include "config/read_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "config/declare/read_struct.hpp"
#include "config/expected_columns.hpp"
#include "config/overrides.hpp"
#include "core/closest.hpp"

namespace recoil::config {

namespace {

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

/// The ghost-fluid schemes support frictionless separable contact only.
void check_contact_of_scheme(const Case& c, const Node& root, Diagnostics& out) {
  using enum ContactChoice::Mode;
  bool other = c.contact.usual.mode != separable;
  for (const Contact::Pair& p : c.contact.pairs) other = other || p.choice.mode != separable;
  if (!other || c.method.scheme == "conservative") return;
  out.error(root.find("contact")->key_place,
            fmt::format("scheme = \"{}\" supports frictionless separable contact only", c.method.scheme),
            "use scheme = \"conservative\"");
}

/// Between a body that takes up fragments and others holds what the case says of the two; else what it says
/// of the body that breaks.
void follow_contact_of_sources(Case& c) {
  const auto source = [&c](const Body& b) { return b.takes_up_fragments() ? b.fragments_of : b.name; };
  const std::vector<Contact::Pair> given = c.contact.pairs;
  const auto same = [](const Contact::Pair& p, const std::string& a, const std::string& b) {
    return (p.bodies[0] == a && p.bodies[1] == b) || (p.bodies[0] == b && p.bodies[1] == a);
  };
  for (std::size_t a = 0; a < c.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < c.bodies.size(); ++b) {
      const Body &first = c.bodies[a], &second = c.bodies[b];
      const auto named = [&](const Contact::Pair& p) { return same(p, first.name, second.name); };
      const auto of_sources = [&](const Contact::Pair& p) { return same(p, source(first), source(second)); };
      if (std::ranges::any_of(given, named)) continue;
      const auto from = std::ranges::find_if(given, of_sources);
      if (from != given.end()) c.contact.pairs.push_back({{first.name, second.name}, from->choice});
    }
}

}  // namespace

Case read_case(const Document& document, Diagnostics& out) {
  Case c;
  c.file = document.name;
  c.text = document.text;
  if (!document.complete || !check_format(document, out)) return c;
  // Of a case without a domain the bodies are not read: their coordinates are not known.
  const Node* domain = document.root.find("domain");
  const Node* body = document.root.find("body");
  const bool knows_domain = domain && domain->is_table();
  const Geometry geometry = knows_domain ? geometry_of(*domain) : Geometry::space;
  CaseReading in{geometry, axes_of(geometry), out};
  in.folder = std::filesystem::path(document.name).parent_path();
  in.files = &c.files;
  in.knows_domain = knows_domain;
  in.knows_bodies = knows_domain && body && body->is_table();
  const Record top = read_struct(document.root, c, in);
  read_parts(document.root, c, in, top);
  if (!in.knows_bodies) return c;
  follow_contact_of_sources(c);
  check_contact_of_scheme(c, document.root, out);
  check_expected_names(c.expect, c.bodies, c.gauges, out);
  return c;
}

void check_expected_names(const std::vector<Expectation>& expect, const std::vector<Body>& bodies,
                          const std::vector<Gauge>& gauges, Diagnostics& out) {
  CaseReading in{Geometry::space, {}, out};
  for (const Body& body : bodies) in.bodies.push_back(body.name);
  static const std::vector<std::string> kinds{"body",  "budget",    "contact", "event", "failure",
                                              "floor", "fragments", "gauge",   "run"};
  std::vector<std::string> gauge_names;
  for (const Gauge& gauge : gauges) gauge_names.push_back(gauge.name);
  for (const Expectation& e : expect) {
    const std::size_t dot = e.quantity.find('.');
    const std::string first = e.quantity.substr(0, dot);
    if (std::ranges::find(kinds, first) == kinds.end() || dot == std::string::npos) {
      const std::string near = did_you_mean(first, kinds);
      out.error(e.place, fmt::format("there is no quantity '{}'", e.quantity),
                !near.empty() && near.find('\'' + first + '\'') == std::string::npos
                    ? near
                    : fmt::format("quantities begin with {}., e.g. gauge.NAME.COLUMN.max",
                                  fmt::join(kinds, "., ")));
      continue;
    }
    const std::string name = e.quantity.substr(dot + 1, e.quantity.find('.', dot + 1) - dot - 1);
    if (first == "contact") {
      read_pair(name, e.place, in.bodies, out);
    } else if (first == "body" && name != "total") {
      check_body(name, e.place, in);
    } else if (first == "gauge") {
      const auto gauge = std::ranges::find(gauges, name, &Gauge::name);
      const std::string near = did_you_mean(name, gauge_names);
      if (gauge != gauges.end())
        check_expected_column(e, *gauge, out);
      else
        out.error(e.place, fmt::format("there is no gauge '{}'", name),
                  !near.empty() ? near : "write a [gauge." + name + "]");
    }
  }
}

Case read_case(const std::string& path, Document& document, Diagnostics& out,
               const std::vector<std::string>& overrides) {
  document = read_document(path, out);
  if (document.complete) apply_overrides(document, overrides, out);
  return read_case(document, out);
}

}  // namespace recoil::config
