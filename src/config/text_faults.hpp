#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace recoil::config {

/// Something in a text that keeps it from being read at all. Line and column count from 1, columns in
/// characters.
struct TextFault {
  int line = 1, column = 1;
  std::string message, help;
};

/// The first quote that is never closed, or that closes what was never opened. A parser would go on inside
/// of it and report what follows from it.
std::optional<TextFault> find_open_quote(std::string_view text);

/// The first byte that is no UTF-8.
std::optional<TextFault> find_foreign_byte(std::string_view text);

/// The text with every byte that is no UTF-8 replaced by U+FFFD, so that it can be shown.
std::string shown(std::string_view text);

/// The line of this number without its end; empty beyond the last.
std::string_view line_of(std::string_view text, int line);

}  // namespace recoil::config
