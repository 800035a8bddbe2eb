#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "config/declare/read_struct.hpp"
#include "config/declare/write_struct.hpp"

/// Tables of several kinds: a std::variant of structs that declare their keys, each with `kind` (as a case
/// file has it), `doc`, and where it does not exist everywhere `only_in()`. The variant is the only list of
/// them.
namespace recoil::config {

/// One kind, by one of its names.
struct KindName {
  std::string name, doc;
  std::vector<Geometry> only_in;  // empty: in every geometry
  std::size_t index;              // in the variant
};

/// Calls f with a default-constructed struct of each kind in the list, and its place there.
template <class Variant, class F>
void for_each_kind(const F& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) { (f(std::variant_alternative_t<I, Variant>{}, I), ...); }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
}

template <class Variant>
std::vector<KindName> kinds_of() {
  std::vector<KindName> all;
  for_each_kind<Variant>([&]<class T>(const T&, std::size_t index) {
    KindName own{T::kind, T::doc, {}, index};
    if constexpr (requires { T::only_in(); }) own.only_in = T::only_in();
    all.push_back(std::move(own));
    if constexpr (requires { T::aliases(); })
      for (const Alias& a : T::aliases()) all.push_back({a.kind, a.doc, a.only_in, index});
  });
  return all;
}

/// The keys of a kind that exist where this name of it does.
template <class T>
Entries<T> entries_of(const KindName& kind) {
  Entries<T> entries = T::keys();
  std::erase_if(entries, [&](const Entry<T>& e) { return !can_meet(e.only_in, kind.only_in); });
  return entries;
}

template <class Variant>
Key kind_key(const char* doc) {
  Key key{.name = "kind", .type = Key::Type::choice, .required = true, .doc = doc};
  for (const KindName& k : kinds_of<Variant>()) key.choices.push_back(k.name);
  key.example = written_text(key.choices.front());
  return key;
}

/// One section for each name of each kind.
template <class Variant>
void add_kind_sections(const std::string& path, const char* kind_doc, std::vector<Section>& all) {
  const Key kind = kind_key<Variant>(kind_doc);
  for (const KindName& name : kinds_of<Variant>())
    for_each_kind<Variant>([&]<class T>(const T&, std::size_t index) {
      if (index != name.index) return;
      Section section{path, name.doc, keys_of<T>(entries_of<T>(name)), name.name};
      section.keys.insert(section.keys.begin(), kind);
      if constexpr (requires { T::columns(); }) section.columns = T::columns();
      all.push_back(std::move(section));
    });
}

/// Finds the kind that a table names; what is wrong with it is reported. @return null after an error.
/// @param noun "shape", for messages.
const KindName* find_kind(const Node& node, const char* noun, const Key& kind_key,
                          const std::vector<KindName>& kinds, const CaseReading& in);

/// Reads a table of one of the kinds.
template <class Variant>
void read_kind(const Node& node, Variant& into, const char* noun, const char* kind_doc,
               const CaseReading& in) {
  const std::vector<KindName> kinds = kinds_of<Variant>();
  const Key kind_key = config::kind_key<Variant>(kind_doc);
  const KindName* name = find_kind(node, noun, kind_key, kinds, in);
  if (!name) return;
  Owner owner{fmt::format("a {} of kind \"{}\"", noun, name->name), {}};
  for_each_kind<Variant>([&]<class T>(const T&, std::size_t index) {
    for (const Entry<T>& e : T::keys())
      if (index != name->index) owner.elsewhere.push_back(e.name);
  });
  Node rest = node;
  std::erase_if(rest.children, [](const Node& child) { return child.key == "kind"; });
  for_each_kind<Variant>([&]<class T>(T value, std::size_t index) {
    if (index != name->index) return;
    read_struct(rest, value, in, owner, entries_of<T>(*name));
    into = std::move(value);
  });
}

/// The keys of the kind that the variant holds, `kind` first.
template <class Variant>
std::vector<WrittenKey> written_kind(const Variant& variant, const Writing& how) {
  return std::visit(
      [&]<class T>(const T& value) {
        std::vector<WrittenKey> keys = written_keys(value, how);
        keys.insert(keys.begin(), {"kind", written_text(T::kind)});
        return keys;
      },
      variant);
}

}  // namespace recoil::config
