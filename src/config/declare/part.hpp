#pragma once

#include <string>
#include <vector>

#include "config/declare/read_struct.hpp"
#include "config/declare/write_struct.hpp"

namespace recoil::config {

/// The member of an entry that is a table of its own with declared keys: part_of<&Case::mesh>().
template <auto M>
constexpr auto part_of() {
  using T = typename MemberOf<decltype(M)>::Struct;
  using V = typename MemberOf<decltype(M)>::Value;
  return Part<T>{[](T& t, const Node& node, CaseReading& in) {
                   const Record record = read_struct(node, t.*M, in);
                   read_parts(node, t.*M, in, record);
                 },
                 [](const std::string& path, std::vector<Section>& all) { add_sections<V>(path, all); },
                 [](const T& t, const std::string& path, const Writing& how, std::vector<WrittenTable>& all) {
                   write_tables(t.*M, path, how, all);
                 }};
}

}  // namespace recoil::config
