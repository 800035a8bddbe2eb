#include "config/section/expect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "config/declare/read_struct.hpp"
#include "config/declare/write_struct.hpp"
#include "config/units.hpp"

namespace recoil::config {

namespace {

/// A value of any dimension; a bare number is a ratio or a count.
Quantity read_any(const Node& node, const std::string& name, Diagnostics& out) {
  Quantity q;
  if (node.is_number() && std::isfinite(node.number)) {
    q.value = q.written = node.number;
    return q;
  }
  if (node.is_text()) {
    q = parse_any_quantity(node.text, name);
  } else {
    q.problem = fmt::format("'{}' needs a number or a quantity, but is {}", name, describe(node));
    q.help = "a finite number, or a text with a unit such as \"0.695 us\"";
  }
  if (!q.ok()) out.error(node.place, q.problem, q.help);
  return q;
}

/// How far off the value may be, in SI and absolute.
double read_tolerance(const Node& node, const Quantity& value, Diagnostics& out) {
  const Quantity q = read_any(node, "within", out);
  if (!q.ok()) return 0;
  if (q.value < 0) {
    out.error(node.place, "'within' must be at least 0", "it is how far off the value may be");
    return 0;
  }
  if (q.unit == "%" && value.unit != "%") {
    if (value.value == 0) {
      out.error(node.place, "a percentage of the value 0 is not a tolerance",
                "give 'within' in the unit of the value");
    }
    return q.value * std::abs(value.value);
  }
  const std::string needed = dimension_name(value.unit), given = dimension_name(q.unit);
  if (needed != given) {
    out.error(node.place, fmt::format("'within' has dimension [{}], but the value has [{}]", given, needed),
              "give a percentage, or the unit of the value");
    return 0;
  }
  // A tolerance is a difference: 2 degC are 2 K.
  return q.unit.empty() ? q.value : q.written * unit_size(q.unit);
}

void read_limits(const Node& node, const Record& record, Expectation& e, Diagnostics& out) {
  const char* name = record.has("at-most") ? "at-most" : record.has("at-least") ? "at-least" : "value";
  const int given = record.has("at-most") + record.has("at-least") + record.has("value");
  if (given != 1) {
    out.error(node.key_place, fmt::format("'{}' needs one of value, at-most, at-least", e.quantity),
              R"(e.g. { value = "0.695 us", within = "3 %" })");
    return;
  }
  const Quantity q = read_any(*record.node(name), name, out);
  e.value = q.value;
  e.unit = q.unit;
  e.at_most = record.has("at-most");
  e.at_least = record.has("at-least");
  const bool two_sided = record.has("value");
  if (record.has("within") && !two_sided)
    out.error(record.key_place("within"), fmt::format("'within' goes with 'value', not with '{}'", name),
              "remove it: a limit has no tolerance");
  if (two_sided && !record.has("within"))
    out.error(node.key_place, fmt::format("'{}' has a value, but 'within' is missing", e.quantity),
              "give a tolerance: within = \"3 %\"");
  if (two_sided && record.has("within") && q.ok())
    e.tolerance = read_tolerance(*record.node("within"), q, out);
}

/// The unit of an expectation is any, so its values stay in the unit that they were written in.
std::string in_own_unit(const Expectation& e, double value, bool difference) {
  if (e.unit.empty()) return written_number(value);
  const double scaled = difference ? value / unit_size(e.unit) : in_unit(value, e.unit);
  return written_text(fmt::format("{:.15g} {}", scaled, e.unit));  // without the round-off of the unit
}

std::string write_value(const Expectation& e, const char* /*name*/, const Writing& /*how*/) {
  return in_own_unit(e, e.value, false);
}
std::string write_tolerance(const Expectation& e, const char* /*name*/, const Writing& /*how*/) {
  return in_own_unit(e, e.tolerance, true);
}

/// The values depend on each other: Expectation::check() reads them.
void read_later(Expectation& /*e*/, const TableReading& /*reading*/, const Key& /*key*/) {}

bool two_sided(const Expectation& e) { return !e.at_most && !e.at_least; }

/// A name with dots that was written without quotes comes as tables in tables.
bool is_part_of_a_name(const Node& node) {
  const auto deeper = [](const Node& child) { return child.is_table() || child.is_flag(); };
  return node.is_table() && !node.children.empty() &&
         std::all_of(node.children.begin(), node.children.end(), deeper);
}

void read_entry(const Node& node, const std::string& quantity, Diagnostics& out,
                std::vector<Expectation>& found) {
  if (is_part_of_a_name(node)) {
    for (const Node& child : node.children) read_entry(child, quantity + '.' + child.key, out, found);
    return;
  }
  Expectation e;
  e.quantity = quantity;
  e.place = node.key_place;
  if (node.is_flag()) {
    e.is_flag = true;
    e.flag = node.flag;
  } else if (node.is_table()) {
    read_struct(node, e, {Geometry::line, axes_of(Geometry::line), out});
  } else {
    out.error(node.place,
              fmt::format("'{}' needs a table, true or false, but is {}", quantity, describe(node)),
              R"(e.g. { value = "0.695 us", within = "3 %" })");
    return;
  }
  found.push_back(std::move(e));
}

}  // namespace

Entries<Expectation> Expectation::keys() {
  const Custom<Expectation> amount{Key::Type::any, false, read_later, write_value};
  return {{.name = "value",
           .member = amount,
           .doc = "the expected value",
           .example = R"("0.695 us")",
           .when = two_sided},
          {.name = "within",
           .member = Custom<Expectation>{Key::Type::any, false, read_later, write_tolerance},
           .doc = "how far off it may be: a percentage or a quantity",
           .example = R"("3 %")",
           .when = two_sided},
          {.name = "at-most",
           .member = amount,
           .doc = "an upper limit",
           .example = R"("0.695 us")",
           .when = [](const Expectation& e) { return e.at_most; }},
          {.name = "at-least",
           .member = amount,
           .doc = "a lower limit",
           .example = R"("0.695 us")",
           .when = [](const Expectation& e) { return e.at_least; }},
          {.name = "source",
           .member = &Expectation::source,
           .optional = true,
           .doc = "where the value comes from",
           .example = R"("marsh1980")"},
          {.name = "why",
           .member = &Expectation::why,
           .optional = true,
           .doc = "why the limit is what it is",
           .example = R"("first-order spike")"}};
}

void Expectation::check(const TableReading& reading) {
  read_limits(reading.node, reading.record, *this, reading.in.out);
}

WrittenTable write_expectations(const std::vector<Expectation>& all, const std::string& file) {
  WrittenTable table{"expect", {}};
  const Writing how{Geometry::line, axes_of(Geometry::line)};
  for (const Expectation& e : all) {
    const std::string source =
        fmt::format("{}line {}", e.place.file == file ? "" : "expected.toml, ", e.place.line);
    const std::string value =
        e.is_flag ? std::string(e.flag ? "true" : "false") : inline_table(written_keys(e, how));
    table.keys.push_back({written_text(e.quantity), value, source});
  }
  return table;
}

std::vector<Expectation> read_expectations(const Node& table, Diagnostics& out) {
  std::vector<Expectation> found;
  for (const Node& child : table.children) read_entry(child, child.key, out, found);
  return found;
}

std::vector<Expectation> read_expectations(const Document& document, Diagnostics& out) {
  const Node* table = document.find("expect");
  return read_expectations(table ? *table : document.root, out);
}

}  // namespace recoil::config
