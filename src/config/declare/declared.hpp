#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "config/declare/entry.hpp"
#include "config/declare/write.hpp"
#include "config/document.hpp"

/// From declarations (entry.hpp) to the keys of tables.
namespace recoil::config {

template <class... F>
struct Cases : F... {
  using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;  // clang 14 does not deduce it of aggregates

inline bool exists_in(const std::vector<Geometry>& only_in, Geometry geometry) {
  return only_in.empty() || std::find(only_in.begin(), only_in.end(), geometry) != only_in.end();
}

/// Whether two such lists have a geometry in common.
inline bool can_meet(const std::vector<Geometry>& a, const std::vector<Geometry>& b) {
  return a.empty() || b.empty() ||
         std::any_of(a.begin(), a.end(), [&](Geometry g) { return exists_in(b, g); });
}

template <class T>
Key::Type type_of(const Entry<T>& e) {
  using enum Key::Type;
  if (e.rule == Rule::turn) return turn;
  if (e.rule == Rule::direction) return direction;
  const Key::Type texts_or_choice = e.choices.empty() ? text : choice;
  return std::visit(
      Cases{[](double T::*) { return quantity; }, [](std::optional<double> T::*) { return quantity; },
            [](int T::*) { return integer; }, [](bool T::*) { return flag; },
            [&](std::string T::*) { return texts_or_choice; },
            [](std::vector<std::string> T::*) { return texts; },
            [](std::array<std::string, 2> T::*) { return text; },
            [](std::array<double, 2> T::*) { return range; }, [](Vector T::*) { return vector; },
            [](const Extents<T>&) { return range; }, [](const Choice<T>&) { return choice; },
            [](const Custom<T>& c) { return c.type; }, [](const Part<T>&) { return table; }},
      e.member);
}

/// The default as one would write it: what a default-constructed struct holds.
template <class T>
std::string default_of(const Entry<T>& e) {
  if (e.required || e.optional) return {};
  const T fresh{};
  const auto amount = [&](double value) {
    const std::string number = written_number(value);
    return std::string(e.unit) == "1" ? number : number + " " + e.unit;
  };
  return std::visit(Cases{[&](double T::*m) { return amount(fresh.*m); },
                          [&](int T::*m) { return std::to_string(fresh.*m); },
                          [&](bool T::*m) { return std::string(fresh.*m ? "true" : "false"); },
                          [&](std::string T::*m) { return e.choices.empty() ? std::string() : fresh.*m; },
                          [&](const Choice<T>& c) { return e.choices[c.get(fresh)]; },
                          [](const auto&) { return std::string(); }},
                    e.member);
}

template <class T>
Key key_of(const Entry<T>& e) {
  const bool coordinate = std::holds_alternative<Extents<T>>(e.member);
  Key key{.name = e.name, .type = type_of(e), .unit = e.unit, .doc = e.doc};
  if (key.type != Key::Type::quantity && key.unit == "1" && key.type != Key::Type::vector) key.unit.clear();
  key.minimum = e.least;
  key.maximum = e.most;
  key.positive = e.positive;
  key.required = e.required && !coordinate;
  key.default_text = default_of(e);
  key.choices = e.choices;
  key.example = e.example;
  key.only_in = e.only_in;
  return key;
}

/// All keys of a struct, as help and the schema show them.
template <class T>
std::vector<Key> keys_of(const Entries<T>& entries = T::keys()) {
  std::vector<Key> keys;
  for (const Entry<T>& e : entries) keys.push_back(key_of(e));
  return keys;
}

/// The section of a struct and those below it.
template <class T>
void add_sections(const std::string& path, std::vector<Section>& all, const Entries<T>& entries = T::keys()) {
  all.push_back({path, T::doc, keys_of<T>(entries)});
  for (const Entry<T>& e : entries) {
    const std::string below = path.empty() ? e.name : path + '.' + e.name;
    if (const auto* part = std::get_if<Part<T>>(&e.member)) part->sections(below, all);
    if (const auto* own = std::get_if<Custom<T>>(&e.member); own && own->sections) own->sections(below, all);
  }
}

}  // namespace recoil::config
