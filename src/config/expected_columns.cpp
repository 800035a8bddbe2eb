#include "config/expected_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "config/units.hpp"
#include "core/closest.hpp"

namespace recoil::config {

namespace {

/// "gauge.NAME.COLUMN.reduction@argument" taken apart.
struct Named {
  std::string column;
  bool has_value = false;
};

Named named_in(const std::string& quantity, const std::string& gauge) {
  const std::size_t at = quantity.find('@'), begin = std::string_view("gauge..").size() + gauge.size();
  Named named;
  if (begin < std::min(at, quantity.size())) named.column = quantity.substr(begin, at - begin);
  const std::size_t dot = named.column.rfind('.');
  const std::string tail = dot == std::string::npos ? "" : named.column.substr(dot + 1);
  const bool reduced = is_reduction(tail);
  named.has_value = at != std::string::npos || reduced;
  if (reduced) named.column.erase(dot);
  return named;
}

}  // namespace

void check_dimension(const Expectation& e, const std::string& unit, Diagnostics& out) {
  if (is_comparable(e.value, e.unit, unit)) return;
  const auto of = [](const std::string& name) { return fmt::format("of [{}]", dimension_name(name)); };
  const bool plain = unit == "1";
  out.error(e.place,
            fmt::format("'{}' is {}, but the expected value is {}", e.quantity,
                        plain ? "a pure number" : of(unit), e.unit.empty() ? "a bare number" : of(e.unit)),
            plain ? "give a number without a unit" : fmt::format("give it in {}, e.g. \"1 {}\"", unit, unit));
}

void check_expected_column(const Expectation& expected, const Gauge& gauge, Diagnostics& out) {
  const Named named = named_in(expected.quantity, gauge.name);
  const std::vector<Column> columns = written_columns(gauge);
  std::vector<std::string> names;
  for (const Column& c : columns) names.emplace_back(c.name);
  const auto is_named = [&](const Column& c) {
    const std::string_view name = c.name;
    return named.column == name ||
           (c.each != Column::Each::once && named.column.starts_with(std::string(name) + '.'));
  };
  const auto column = std::ranges::find_if(columns, is_named);
  if (column == columns.end()) {
    const std::string near = did_you_mean(named.column, names);
    out.error(expected.place, fmt::format("gauge '{}' has no column '{}'", gauge.name, named.column),
              !near.empty() ? near : fmt::format("it has {}", fmt::join(names, ", ")));
    return;
  }
  if (!named.has_value && !expected.is_flag)
    out.error(expected.place, fmt::format("'{}' does not say which value of the record", expected.quantity),
              "append @TIME, .peak, .last, .pullback, .max, .min, .mean@FROM..TO, .rms@FROM..TO, "
              ".slope@FROM..TO, .arrival@LEVEL or .until@LEVEL");
}

}  // namespace recoil::config
