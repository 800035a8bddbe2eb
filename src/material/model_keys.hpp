#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "config/keys.hpp"
#include "config/table.hpp"
#include "material/parameter.hpp"

/// From the models' parameter lists to the keys of a file, and back.
namespace recoil::model_keys {

using config::Key;
using config::Node;
using config::Record;

/// The shortest text that reads back as the same number.
inline std::string shortest(double x) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x);
  return std::string(buffer, end.ptr);
}

inline bool pure(const char* unit) { return std::string_view(unit) == "1"; }

template <class Model>
std::string written(const Parameter<Model>& p, double value) {
  return pure(p.unit) ? shortest(value) : "\"" + shortest(value) + " " + p.unit + "\"";
}

template <class Model>
Key key_of(const Parameter<Model>& p, bool required) {
  Key key{.name = p.name, .type = Key::Type::quantity, .unit = p.unit, .doc = p.doc};
  key.minimum = p.minimum;
  key.maximum = p.maximum;
  key.required = required;
  if (!p.required()) {
    key.default_text = shortest(p.fallback());
    if (!pure(p.unit)) key.default_text += std::string(" ") + p.unit;
  }
  return key;
}

template <class Model>
std::vector<Key> keys_of_model(bool may_require = true) {
  std::vector<Key> keys;
  if constexpr (requires { Model::texts(); })
    for (const auto& t : Model::texts()) {
      Key key{.name = t.name, .type = Key::Type::text, .doc = t.doc, .example = t.example};
      key.required = true;
      keys.push_back(std::move(key));
    }
  for (const auto& p : Model::parameters()) keys.push_back(key_of(p, may_require && p.required()));
  if constexpr (requires(Model m) { m.solid; }) {
    const char* doc = "equation of state of the solid: a table with its kind";
    keys.push_back({.name = "solid", .type = Key::Type::table, .required = may_require, .doc = doc});
  }
  return keys;
}

template <class Model>
void take(Model& model, const Record& record) {
  for (const auto& p : Model::parameters())
    if (record.good(p.name)) model.*p.member = record.number(p.name);
  if constexpr (requires { Model::texts(); })
    for (const auto& t : Model::texts())
      if (record.good(t.name)) model.*t.member = record.text(t.name);
}

/// Calls f(model) with a default-constructed model of each kind in the list.
template <class Variant, class F>
void for_each_model(const F& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) { (f(std::variant_alternative_t<I, Variant>{}), ...); }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
}

template <class Variant>
Key kind_key(const char* doc) {
  Key key{.name = "kind", .type = Key::Type::choice, .required = true, .doc = doc};
  for_each_model<Variant>([&](const auto& model) { key.choices.push_back(model.kind); });
  return key;
}

/// A table reduced to the children that `keep` accepts.
template <class F>
Node reduced(Node table, const F& keep) {
  std::erase_if(table.children, [&](const Node& child) { return !keep(child.key); });
  return table;
}

/// The kind of a part of a material; empty: it says none.
inline std::string kind_of(const Node& material, const char* part) {
  const Node* table = material.find(part);
  const Node* kind = table ? table->find("kind") : nullptr;
  return kind && kind->is_text() ? kind->text : std::string();
}

}  // namespace recoil::model_keys
