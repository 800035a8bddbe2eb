#include "config/expected_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/units.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"

namespace recoil::config {

namespace {

/// Units that depend on the geometry; gauges declare them by these names.
constexpr std::array<std::string_view, 6> sums{"mass", "energy", "area", "force", "momentum", "volume"};

/// "gauge.NAME.COLUMN.reduction@argument" taken apart.
struct Named {
  std::string column;
  bool has_value = false, keeps_unit = false;
};

Named named_in(const std::string& quantity, const std::string& gauge) {
  const std::size_t at = quantity.find('@'), begin = std::string_view("gauge..").size() + gauge.size();
  Named named;
  if (begin < std::min(at, quantity.size())) named.column = quantity.substr(begin, at - begin);
  const std::size_t dot = named.column.rfind('.');
  const std::string tail = dot == std::string::npos ? "" : named.column.substr(dot + 1);
  const Reduction* found = find_reduction(tail);
  named.has_value = at != std::string::npos || found;
  named.keeps_unit = !found || found->keeps_unit;
  if (found) named.column.erase(dot);
  return named;
}

/// An empty name is that of pure numbers.
std::string dimension_of(const std::string& unit) { return dimension_name(unit == "1" ? "" : unit); }

bool is_known(const std::string& unit) {
  try {
    dimension_of(unit);
    return true;
  } catch (const InputError&) {
    return false;  // which has been told where the value was read
  }
}

void check_unit(const Expectation& e, const Column& column, Diagnostics& out) {
  if (e.is_flag || std::ranges::find(sums, std::string_view(column.unit)) != sums.end()) return;
  const bool nothing = e.unit.empty() && e.value == 0;
  if (nothing || !is_known(e.unit) || dimension_of(e.unit) == dimension_of(column.unit)) return;
  const std::string given = e.unit.empty() ? "a bare number" : fmt::format("of [{}]", dimension_of(e.unit));
  const bool plain = std::string_view(column.unit) == "1";
  out.error(e.place,
            fmt::format("'{}' is {}, but the expected value is {}", e.quantity,
                        plain ? "a pure number" : fmt::format("of [{}]", dimension_of(column.unit)), given),
            plain ? "give a number without a unit"
                  : fmt::format("give it in {}, e.g. \"1 {}\"", column.unit, column.unit));
}

}  // namespace

void check_expected_column(const Expectation& expected, const Gauge& gauge, Diagnostics& out) {
  const Named named = named_in(expected.quantity, gauge.name);
  const std::vector<Column> columns = std::visit([](const auto& kind) { return kind.columns(); }, gauge.kind);
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
  else if (named.keeps_unit)
    check_unit(expected, *column, out);
}

}  // namespace recoil::config
