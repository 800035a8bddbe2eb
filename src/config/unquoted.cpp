#include "config/unquoted.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>

#include "core/characters.hpp"

namespace recoil::config {

namespace {

int characters(std::string_view s) {
  return static_cast<int>(std::count_if(s.begin(), s.end(), starts_character));
}

std::size_t byte_of(std::string_view line, int column) {
  int at = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (starts_character(line[i])) ++at;
    if (at == column) return i;
  }
  return line.size();
}

/// "5 km/s", "0.05mm", "3 %": a number and something that begins like a unit.
bool is_quantity(std::string_view s) {
  if (s.starts_with('+')) s.remove_prefix(1);
  if (s.empty() || !(is_digit(s[0]) || s[0] == '-' || s[0] == '.')) return false;
  double value = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
  if (error != std::errc()) return false;
  s.remove_prefix(static_cast<std::size_t>(end - s.data()));
  while (s.starts_with(' ')) s.remove_prefix(1);
  return !s.empty() && (is_letter(s[0]) || s[0] == '%' || static_cast<unsigned char>(s[0]) >= 0x80U);
}

/// planar, aluminium/6061-t6: what is meant as a text.
bool is_word(std::string_view s) {
  const auto fits = [](char c) { return is_letter(c) || is_digit(c) || c == '-' || c == '_' || c == '/'; };
  return !s.empty() && is_letter(s[0]) && std::all_of(s.begin(), s.end(), fits);
}

}  // namespace

std::optional<Unquoted> QuoteRepairs::repair(std::string& text, int line, int column) {
  std::size_t begin = 0;
  for (int n = 1; n < line; ++n) {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return {};
    ++begin;
  }
  const std::string_view row = std::string_view(text).substr(begin, text.find('\n', begin) - begin);
  const std::size_t stop = std::min(byte_of(row, column), row.size());
  // The value lies between the last separator before the place and the first one after it.
  const std::size_t before = stop == 0 ? std::string_view::npos : row.find_last_of("=[,{\"'", stop - 1);
  std::size_t first = before == std::string_view::npos ? 0 : before + 1;
  while (first < row.size() && (row[first] == ' ' || row[first] == '\t')) ++first;
  std::size_t last = std::min(row.find_first_of(",]}#\"'=\r", first), row.size());
  while (last > first && (row[last - 1] == ' ' || row[last - 1] == '\t')) --last;
  const std::string_view value = row.substr(first, last - first);
  const bool after_equals =
      before != std::string_view::npos && row.substr(0, first).find('=') != std::string_view::npos;
  const bool quantity = is_quantity(value);
  if (!quantity && !(after_equals && is_word(value))) return {};

  Unquoted found;
  found.text = std::string(value);
  found.why = quantity ? "a number with its unit is a text" : "a name is a text";
  const int column_first = characters(row.substr(0, first)) + 1;
  found.length = characters(value);
  found.column = original_column(line, column_first);
  repairs_.push_back({line, column_first, column_first + found.length + 1});
  text.insert(begin + last, 1, '"');
  text.insert(begin + first, 1, '"');
  return found;
}

int QuoteRepairs::original_column(int line, int column) const {
  for (auto r = repairs_.rbegin(); r != repairs_.rend(); ++r)
    if (r->line == line) column -= (column > r->last ? 2 : column > r->first ? 1 : 0);
  return column;
}

}  // namespace recoil::config
