#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/characters.hpp"

namespace recoil {

/// The characters of a line. What a terminal would obey or could not show (control characters, bytes that are
/// no UTF-8) is a question mark.
inline std::vector<std::string> printable_characters(std::string_view line) {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < line.size();) {
    std::size_t end = k + 1;
    while (end < line.size() && !starts_character(line[end])) ++end;
    const auto lead = static_cast<unsigned char>(line[k]);
    const std::size_t bytes = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    const bool good = starts_character(line[k]) && lead < 0xF8 && end - k == bytes &&
                      (lead >= 0x20 || lead == '\t') && lead != 0x7F;
    if (starts_character(line[k])) all.push_back(good ? std::string(line.substr(k, end - k)) : "?");
    k = end;
  }
  return all;
}

/// A text of several lines in such characters.
inline std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    for (const std::string& c : printable_characters(text.substr(at, end - at))) out += c;
    if (end < text.size()) out += '\n';
    at = end + 1;
  }
  return out;
}

}  // namespace recoil
