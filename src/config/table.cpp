#include "config/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "config/habits/choice_habits.hpp"
#include "config/units.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"

namespace recoil::config {

namespace {

bool dimensionless(const std::string& unit) { return unit.empty() || unit == "1"; }

/// The unit of an example such as "0.05 mm" or { x = "450 m/s" }, or the SI unit.
std::string usual_unit(const std::string& example, const std::string& si) {
  const std::size_t blank = example.find(' ', example.find_first_of("0123456789"));
  if (blank == std::string::npos) return si;
  return example.substr(blank + 1, example.find_first_of("\",", blank) - blank - 1);
}

std::string in_table(const Node& table) { return table.path.empty() ? "" : " in [" + table.path + "]"; }

std::string help_for(const Key& key) {
  return key.example.empty() ? key.doc
                             : key.name + " = " + key.example + (key.doc.empty() ? "" : ": " + key.doc);
}

/// How a key is written whose value is one quantity; examples of pairs and vectors show more than that.
std::string help_for_quantity(const std::string& name, const std::string& unit, const std::string& example) {
  if (!example.empty() && example.find_first_of("[{") == std::string::npos)
    return fmt::format("write {} = {}", name, example);
  return dimensionless(unit) ? "write a number" : parse_quantity("", unit, name).help;
}

}  // namespace

void report_missing(const Node& table, const Key& key, const Owner& owner, Diagnostics& out) {
  out.error(table.key_place, fmt::format("'{}' is missing{}", key.name, in_table(table)),
            owner.what.empty() ? help_for(key)
                               : fmt::format("{} needs it, e.g. {} = {}", owner.what, key.name, key.example));
}

double read_quantity(const Node& node, const std::string& name, const std::string& unit, Diagnostics& out,
                     const std::string& example) {
  if (node.is_number() && !std::isfinite(node.number)) {
    out.error(node.place, fmt::format("'{}' must be finite, but is {}", name, node.text),
              help_for_quantity(name, unit, example));
    return 0;
  }
  if (node.is_number() && dimensionless(unit)) return node.number;
  if (node.is_number()) {
    out.error(node.place,
              fmt::format("'{}' is a bare number, but needs a unit of [{}]", name, dimension_name(unit)),
              fmt::format("write {} = \"{} {}\"", name, node.text, usual_unit(example, unit)));
    return 0;
  }
  if (!node.is_text()) {
    const std::string what =
        dimensionless(unit) ? "a number" : "a quantity of [" + dimension_name(unit) + "]";
    out.error(node.place, fmt::format("'{}' needs {}, but is {}", name, what, describe(node)),
              help_for_quantity(name, unit, example));
    return 0;
  }
  const Quantity q = parse_quantity(node.text, unit, name);
  if (!q.ok()) out.error(node.place, q.problem, q.help);
  return q.ok() ? q.value : 0;
}

/// Reads the value of one key of a table.
struct ValueReader {
  const Key& key;
  const Node& table;
  Diagnostics& out;
  std::span<const std::string> axes;
  const Owner& owner;

  void wrong_type(const Node& node, const char* needed) const {
    out.error(node.place, fmt::format("'{}' needs {}, but is {}", key.name, needed, describe(node)),
              help_for(key));
  }

  double quantity(const Node& node) const {
    const int before = out.error_count();
    const double v = read_quantity(node, key.name, key.unit, out, key.example);
    if (out.error_count() == before) check_range(node, v);
    return v;
  }

  void check_range(const Node& node, double v) const {
    const bool high = v > key.maximum;
    if (v >= key.minimum && !high && !(key.positive && v <= 0)) return;
    const double limit = high ? key.maximum : key.positive && v <= 0 ? 0 : key.minimum;
    const std::string unit =
        usual_unit(node.is_text() ? node.text : "", dimensionless(key.unit) ? "" : key.unit);
    const char* relation = high ? "at most" : key.positive && v <= 0 ? "more than" : "at least";
    out.error(node.place,
              fmt::format("'{}' must be {} {}, but is {}", key.name, relation,
                          format_quantity(limit, unit == "%" ? "" : unit), node.text),
              help_for(key));
  }

  void choice(const Node& node) const {
    if (key.choices.empty() ||
        std::find(key.choices.begin(), key.choices.end(), node.text) != key.choices.end())
      return;
    std::string help(help_for_choice(node.text, key.choices));
    if (help.empty()) help = did_you_mean(node.text, key.choices);
    const std::string all = fmt::format("one of: {}", fmt::join(key.choices, ", "));
    if (std::find(key.not_yet.begin(), key.not_yet.end(), node.text) != key.not_yet.end()) {
      out.error(node.place,
                fmt::format("'{}' = \"{}\" is not available in this version", key.name, node.text), all);
      return;
    }
    out.error(node.place, fmt::format("'{}' is not a valid '{}'", node.text, key.name),
              help.empty() ? all : help + " (" + all + ")");
  }

  void read_texts(const Node& node, Record::Value& v) const {
    if (node.is_text()) {  // one text means a list of one
      choice(node);
      v.texts.push_back(node.text);
      return;
    }
    if (!node.is_array()) return wrong_type(node, "a list of texts");
    for (const Node& one : node.children) {
      if (!one.is_text()) {
        wrong_type(one, "a list of texts");
        continue;
      }
      choice(one);
      v.texts.push_back(one.text);
    }
  }

  void read_range(const Node& node, Record::Value& v) const {
    if (!node.is_array() || node.children.size() != 2) return wrong_type(node, "a pair [low, high]");
    const int before = out.error_count();
    v.numbers[0] = quantity(node.children[0]);
    v.numbers[1] = quantity(node.children[1]);
    if (out.error_count() == before && v.numbers[0] >= v.numbers[1])
      out.error(node.place,
                fmt::format("'{}' needs its low end first: {} is not below {}", key.name,
                            node.children[0].text, node.children[1].text),
                "swap the two, or give them some distance");
  }

  void read_components(const Node& node, Record::Value& v) const {
    if (!node.is_table()) return wrong_type(node, "a table of components");
    for (const Node& one : node.children) {
      const auto axis = std::find(axes.begin(), axes.end(), one.key);
      if (axis == axes.end()) {
        out.error(one.key_place, fmt::format("'{}' is not a component of '{}' here", one.key, key.name),
                  fmt::format("this geometry has {}", fmt::join(axes, ", ")));
        continue;
      }
      const int before = out.error_count();
      const double c = read_quantity(one, one.key, key.unit, out, key.example);
      if (out.error_count() == before) v.numbers[axis - axes.begin()] = c;
    }
  }

  /// By components, or by angles where there is an x axis and a plane or space about it.
  void read_direction(const Node& node, Record::Value& v) const {
    static const std::vector<Key> angles{
        {.name = "angle", .type = Key::Type::quantity, .unit = "rad", .example = R"("30 deg")"},
        {.name = "elevation", .type = Key::Type::quantity, .unit = "rad", .example = R"("10 deg")"}};
    if (!node.find("angle") && !node.find("elevation")) return read_components(node, v);
    if (axes.size() < 2 || axes[0] != "x") {
      out.error(node.place, fmt::format("'{}' cannot be given by angles in this geometry", key.name),
                fmt::format("give its components {}", fmt::join(axes, ", ")));
      return;
    }
    const Record r = read_record(node, std::span(angles).first(axes.size() - 1), out);
    v.numbers = pointing(r.number("angle"), axes.size() == 3 ? r.number("elevation") : 0);
  }

  void read(const Node& node, Record::Value& v) const {
    switch (key.type) {
      case Key::Type::quantity:
        v.numbers[0] = quantity(node);
        return;
      case Key::Type::integer:
        if (node.kind != Node::Kind::integer) return wrong_type(node, "a whole number");
        v.integer = node.integer;
        v.numbers[0] = node.number;
        return check_range(node, node.number);
      case Key::Type::flag:
        if (!node.is_flag()) return wrong_type(node, "true or false");
        v.flag = node.flag;
        return;
      case Key::Type::text:
      case Key::Type::choice:
        if (!node.is_text()) return wrong_type(node, "a text");
        v.text = node.text;
        return choice(node);
      case Key::Type::texts:
        return read_texts(node, v);
      case Key::Type::range:
        return read_range(node, v);
      case Key::Type::vector:
        return read_components(node, v);
      case Key::Type::direction:
        return read_direction(node, v);
      case Key::Type::turn:
        if (axes.size() == 3) return read_components(node, v);
        v.numbers[2] = quantity(node);
        return;
      case Key::Type::table:
        if (!node.is_table()) return wrong_type(node, "a table");
        return;
      case Key::Type::any:
        return;
    }
  }

  Record::Value default_value() const {
    Record::Value v;
    if (key.default_text.empty()) return v;
    Diagnostics none;
    const Node node = parse_value(key.default_text, {});
    ValueReader{key, table, none, axes, owner}.read(node, v);
    require(!none.has_errors(), "the default of a key is right");
    return v;
  }

  Record::Value value(const Node* node) const {
    if (!node) {
      if (key.required) report_missing(table, key, owner, out);
      return default_value();
    }
    Record::Value v;
    const int before = out.error_count();
    read(*node, v);
    const bool good = out.error_count() == before;
    if (!good) v = default_value();
    v.node = node;
    v.good = good;
    return v;
  }
};

std::array<double, 3> read_vector(const Node& node, const Key& key, Diagnostics& out,
                                  std::span<const std::string> axes) {
  Record::Value v;
  ValueReader{key, node, out, axes, {}}.read_components(node, v);
  return v.numbers;
}

namespace {

void report_unknown(const Node& table, std::span<const Key> keys, const Owner& owner, Diagnostics& out) {
  std::vector<std::string> names;
  if (!owner.what.empty()) names.emplace_back("kind");
  for (const Key& key : keys) names.push_back(key.name);
  for (const Node& child : table.children) {
    if (std::find(names.begin(), names.end(), child.key) != names.end()) continue;
    if (std::find(owner.elsewhere.begin(), owner.elsewhere.end(), child.key) != owner.elsewhere.end()) {
      out.error(child.key_place, fmt::format("'{}' does not apply to {}", child.key, owner.what),
                fmt::format("known here: {}", fmt::join(names, ", ")));
      continue;
    }
    std::string help = did_you_mean(child.key, names);
    if (help.empty()) help = fmt::format("known here: {}", fmt::join(names, ", "));
    out.error(child.key_place, fmt::format("unknown key '{}'{}", child.key, in_table(table)), help);
  }
}

}  // namespace

Record read_record(const Node& table, std::span<const Key> keys, Diagnostics& out,
                   std::span<const std::string> axes, const Owner& owner) {
  static const std::vector<std::string> cartesian{"x", "y", "z"};
  Record record;
  record.place_ = table.key_place;
  if (!table.is_table())
    out.error(table.place, fmt::format("'{}' needs a table, but is {}", table.key, describe(table)));
  if (table.is_table()) report_unknown(table, keys, owner, out);
  for (const Key& key : keys) {
    const Node* node = table.find(key.name);
    const ValueReader reader{key, table, out, axes.empty() ? std::span<const std::string>(cartesian) : axes,
                             owner};
    record.values_.emplace(key.name, table.is_table() ? reader.value(node) : reader.default_value());
  }
  return record;
}

const Record::Value& Record::value(std::string_view name) const {
  const auto found = values_.find(name);
  if (found == values_.end())
    throw InternalError(fmt::format("internal error: no key '{}' in this record", name));
  return found->second;
}

bool Record::has(std::string_view name) const { return value(name).node != nullptr; }
bool Record::good(std::string_view name) const { return value(name).good; }
double Record::number(std::string_view name) const { return value(name).numbers[0]; }
std::int64_t Record::integer(std::string_view name) const { return value(name).integer; }
bool Record::flag(std::string_view name) const { return value(name).flag; }
const std::string& Record::text(std::string_view name) const { return value(name).text; }
const std::vector<std::string>& Record::texts(std::string_view name) const { return value(name).texts; }
std::array<double, 3> Record::vector3(std::string_view name) const { return value(name).numbers; }
const Node* Record::node(std::string_view name) const { return value(name).node; }

std::array<double, 2> Record::range(std::string_view name) const {
  const Value& v = value(name);
  return {v.numbers[0], v.numbers[1]};
}

Place Record::place(std::string_view name) const {
  const Value& v = value(name);
  return v.node ? v.node->place : place_;
}

Place Record::key_place(std::string_view name) const {
  const Value& v = value(name);
  return v.node ? v.node->key_place : place_;
}

}  // namespace recoil::config
