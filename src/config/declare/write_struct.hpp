#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "config/declare/declared.hpp"

/// Writes structs that declare their keys (entry.hpp) back as tables, in SI and with defaults.
namespace recoil::config {

template <class T>
std::string written(const T& value, const Entry<T>& e, const Writing& how) {
  const char* own = e.unit_in[static_cast<std::size_t>(how.geometry)];
  const std::string unit = own ? own : e.unit;
  return std::visit(
      Cases{
          [&](double T::*m) { return written_quantity(value.*m, unit); },
          [&](std::optional<double> T::*m) { return written_quantity((value.*m).value_or(0), unit); },
          [&](int T::*m) { return std::to_string(value.*m); },
          [&](bool T::*m) { return std::string(value.*m ? "true" : "false"); },
          [&](std::string T::*m) { return written_text(value.*m); },
          [&](std::vector<std::string> T::*m) { return written_list(value.*m); },
          [&](std::array<std::string, 2> T::*m) { return written_text((value.*m)[0] + '-' + (value.*m)[1]); },
          [&](std::array<double, 2> T::*m) { return written_range((value.*m)[0], (value.*m)[1], unit); },
          [&](Vector T::*m) {
            const bool number = e.rule == Rule::turn && how.geometry != Geometry::space;
            return number ? written_quantity((value.*m)[2], unit) : how.vector(value.*m, unit);
          },
          [&](const Extents<T>& x) {
            const auto d = std::find(how.axes.begin(), how.axes.end(), e.name) - how.axes.begin();
            return written_range((value.*x.lo)[d], (value.*x.hi)[d], unit);
          },
          [&](const Choice<T>& c) { return written_text(e.choices[c.get(value)]); },
          [&](const Custom<T>& c) { return c.write(value, e.name, how); },
          [](const Part<T>&) { return std::string(); }},
      e.member);
}

/// Whether a key is written to the resolved case: it exists here, and means something with these values.
template <class T>
bool is_written(const T& value, const Entry<T>& e, const Writing& how) {
  if (std::holds_alternative<Part<T>>(e.member) || !exists_in(e.only_in, how.geometry)) return false;
  if (e.when) return e.when(value);
  if (std::holds_alternative<Extents<T>>(e.member))
    return std::find(how.axes.begin(), how.axes.end(), e.name) != how.axes.end();
  if (const auto* m = std::get_if<std::optional<double> T::*>(&e.member)) return (value.**m).has_value();
  return !e.optional || written(value, e, how) != written(T{}, e, how);
}

template <class T>
std::vector<WrittenKey> written_keys(const T& value, const Writing& how,
                                     const Entries<T>& entries = T::keys()) {
  std::vector<WrittenKey> keys;
  for (const Entry<T>& e : entries)
    if (is_written(value, e, how)) keys.push_back({e.name, written(value, e, how)});
  return keys;
}

/// A struct and the parts below it, each a table.
template <class T>
void write_tables(const T& value, const std::string& path, const Writing& how, std::vector<WrittenTable>& all,
                  const Entries<T>& entries = T::keys()) {
  std::vector<WrittenKey> keys = written_keys<T>(value, how, entries);
  if (!keys.empty()) all.push_back({path, std::move(keys)});
  for (const Entry<T>& e : entries)
    if (const auto* part = std::get_if<Part<T>>(&e.member))
      part->write(value, path.empty() ? e.name : path + '.' + e.name, how, all);
}

}  // namespace recoil::config
