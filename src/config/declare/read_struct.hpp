#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "config/declare/declared.hpp"
#include "config/declare/reading.hpp"

/// Reads tables into structs that declare their keys (entry.hpp).
namespace recoil::config {

/// A key as it is in this case: its unit and example in this geometry and with these bodies.
void adapt(Key& key, Rule rule, const char* unit, const CaseReading& in);

/// Reports coordinates that the geometry does not have, and those that are not given.
/// @param d its place among the axes. @return whether it is one of them.
bool check_coordinate(const TableReading& reading, const std::string& name, std::size_t& d);

/// Reports a key that does not apply in this geometry. @return whether it applies.
bool check_geometry(const TableReading& reading, const Key& key);

/// Checks a vector by its rule. @return it, of length 1 where it is a direction.
Vector checked(const TableReading& reading, const std::string& name, Rule rule, const Vector& v);

/// Puts the value of one key of a table into its member; a wrong or missing one leaves the default.
template <class T>
void take(const TableReading& reading, const Entry<T>& e, const Key& key, T& value) {
  const Record& r = reading.record;
  const std::string name = e.name;
  if (const auto* extents = std::get_if<Extents<T>>(&e.member)) {
    std::size_t d = 0;
    if (!check_coordinate(reading, name, d)) return;
    (value.*extents->lo)[d] = r.range(name)[0];
    (value.*extents->hi)[d] = r.range(name)[1];
    return;
  }
  if (!check_geometry(reading, key) || !r.good(name)) return;
  std::visit(Cases{[&](double T::*m) { value.*m = r.number(name); },
                   [&](std::optional<double> T::*m) { value.*m = r.number(name); },
                   [&](int T::*m) { value.*m = static_cast<int>(r.integer(name)); },
                   [&](bool T::*m) { value.*m = r.flag(name); },
                   [&](std::string T::*m) {
                     value.*m = r.text(name);
                     if (e.rule == Rule::body) check_body(value.*m, r.place(name), reading.in);
                   },
                   [&](std::vector<std::string> T::*m) { value.*m = r.texts(name); },
                   [&](std::array<std::string, 2> T::*m) {
                     value.*m = read_pair(r.text(name), r.place(name), reading.in.bodies, reading.in.out);
                   },
                   [&](std::array<double, 2> T::*m) { value.*m = r.range(name); },
                   [&](Vector T::*m) { value.*m = checked(reading, name, e.rule, r.vector3(name)); },
                   [&](const Choice<T>& c) {
                     const auto found = std::find(e.choices.begin(), e.choices.end(), r.text(name));
                     c.set(value, static_cast<int>(found - e.choices.begin()));
                   },
                   [&](const Custom<T>& c) { c.read(value, reading, key); }, [](const Part<T>&) {},
                   [](const Extents<T>&) {}},
             e.member);
}

/// Reads a table into a struct, all but its parts. @return what the table holds.
template <class T>
Record read_struct(const Node& node, T& value, const CaseReading& in, const Owner& owner = {},
                   const Entries<T>& entries = T::keys()) {
  std::vector<Key> keys = keys_of<T>(entries);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    adapt(keys[k], entries[k].rule, entries[k].unit_in[static_cast<std::size_t>(in.geometry)], in);
    // Values with a reader of their own are read there.
    if (const auto* own = std::get_if<Custom<T>>(&entries[k].member); own && !own->typed)
      keys[k].type = Key::Type::any;
  }
  Record record = read_record(node, keys, in.out, in.axes, owner);
  const TableReading reading{node, record, in, keys, owner};
  for (std::size_t k = 0; k < keys.size(); ++k) take(reading, entries[k], keys[k], value);
  if constexpr (requires { value.check(reading); }) value.check(reading);
  return record;
}

/// Reads the tables below a table that has been read.
template <class T>
void read_parts(const Node& node, T& value, CaseReading& in, const Record& record) {
  for (const Entry<T>& e : T::keys())
    if (const auto* part = std::get_if<Part<T>>(&e.member); part && record.good(e.name))
      part->read(value, *node.find(e.name), in);
}

}  // namespace recoil::config
