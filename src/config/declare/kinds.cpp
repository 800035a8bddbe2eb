#include "config/declare/kinds.hpp"

#include <fmt/ranges.h>

#include <algorithm>

namespace recoil::config {

const KindName* find_kind(const Node& node, const char* noun, const Key& kind_key,
                          const std::vector<KindName>& kinds, const CaseReading& in) {
  const Node* kind_node = node.find("kind");
  if (!node.is_table() || !kind_node) {
    // Of a header [gauge.rear] the name is meant, not the bracket.
    const bool header = node.place.line == node.key_place.line && node.place.column < node.key_place.column;
    in.out.error(
        header ? node.key_place : node.place,
        fmt::format("a {} needs its kind, but [{}] has none", noun, node.path),
        fmt::format("e.g. kind = {}, one of: {}", kind_key.example, fmt::join(kind_key.choices, ", ")));
    return nullptr;
  }
  // The kind alone first: it decides which other keys there may be.
  Node only_kind = node;
  only_kind.children = {*kind_node};
  if (!read_record(only_kind, {&kind_key, 1}, in.out).good("kind")) return nullptr;
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const KindName& k) { return k.name == kind_node->text; });
  if (exists_in(kind->only_in, in.geometry)) return &*kind;
  in.out.error(kind_node->place,
               fmt::format("a {} of kind \"{}\" does not exist in geometry \"{}\"", noun, kind->name,
                           name_of(in.geometry)),
               fmt::format("it does in: {}", names_of(kind->only_in)));
  return nullptr;
}

}  // namespace recoil::config
