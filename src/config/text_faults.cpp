#include "config/text_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "core/characters.hpp"

namespace recoil::config {

namespace {

/// Places of a byte for people.
struct LineColumn {
  int line = 1, column = 1;
};

LineColumn place_of(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t newline = before.rfind('\n');
  const std::string_view row = newline == std::string_view::npos ? before : before.substr(newline + 1);
  return {static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(std::count_if(row.begin(), row.end(), starts_character)) + 1};
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// The end of a text in three quotes that opens at `at`; npos: it has none.
std::size_t end_of_long_text(std::string_view text, std::size_t at) {
  const std::string_view mark = text.substr(at, 3);
  for (std::size_t i = at + 3; i < text.size(); ++i) {
    if (mark[0] == '"' && text[i] == '\\') {
      ++i;
    } else if (text.substr(i, 3) == mark) {
      i += 3;
      while (i < text.size() && text[i] == mark[0]) ++i;  // up to two quotes may stand before the mark
      return i;
    }
  }
  return std::string_view::npos;
}

/// The same of a text in single quotes of either kind, which ends on its line.
std::size_t end_of_short_text(std::string_view text, std::size_t at) {
  for (std::size_t i = at + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[at] == '"' && text[i] == '\\') {
      ++i;
      if (i < text.size() && text[i] == '\n') break;
    } else if (text[i] == text[at]) {
      return i + 1;
    }
  }
  return std::string_view::npos;
}

TextFault quote_fault(std::string_view text, std::size_t at) {
  const LineColumn place = place_of(text, at);
  if (at > 0 && is_word(text[at - 1]))
    return {place.line, place.column, "this quote closes what was never opened",
            "write a quote before the text as well"};
  return {place.line, place.column, "this quote is never closed", "write a quote behind the text as well"};
}

/// The length of the UTF-8 character at `at`; 0: there is none (RFC 3629).
std::size_t length_of_character(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
  };
  const auto follows = [&](std::size_t i, unsigned lo = 0x80, unsigned hi = 0xBF) {
    return byte(i) >= lo && byte(i) <= hi;
  };
  const unsigned b = byte(0);
  if (b < 0x80) return 1;
  if (b >= 0xC2 && b <= 0xDF) return follows(1) ? 2 : 0;
  if (b >= 0xE0 && b <= 0xEF)
    return follows(1, b == 0xE0 ? 0xA0 : 0x80, b == 0xED ? 0x9F : 0xBF) && follows(2) ? 3 : 0;
  if (b >= 0xF0 && b <= 0xF4)
    return follows(1, b == 0xF0 ? 0x90 : 0x80, b == 0xF4 ? 0x8F : 0xBF) && follows(2) && follows(3) ? 4 : 0;
  return 0;
}

}  // namespace

std::optional<TextFault> find_open_quote(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    if (text[i] == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (text[i] != '"' && text[i] != '\'') {
      ++i;
      continue;
    }
    const bool is_long = text.substr(i, 3) == "\"\"\"" || text.substr(i, 3) == "'''";
    const std::size_t end = is_long ? end_of_long_text(text, i) : end_of_short_text(text, i);
    // "-4 mm, "17 mm": the quote before 17 was to open a text.
    if (end == std::string_view::npos || (!is_long && end < text.size() && is_word(text[end])))
      return quote_fault(text, i);
    i = end;
  }
  return std::nullopt;
}

std::optional<TextFault> find_foreign_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = length_of_character(text, i);
    if (n == 0) {
      const LineColumn place = place_of(text, i);
      return TextFault{place.line, place.column,
                       fmt::format("the byte 0x{:02X} is no UTF-8", static_cast<unsigned char>(text[i])),
                       "save the file as UTF-8"};
    }
    i += n;
  }
  return std::nullopt;
}

std::string shown(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = length_of_character(text, i);
    out += n == 0 ? std::string("\xEF\xBF\xBD") : std::string(text.substr(i, n));
    i += std::max<std::size_t>(n, 1);
  }
  return out;
}

std::string_view line_of(std::string_view text, int line) {
  for (int n = 1; n < line; ++n) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

}  // namespace recoil::config
