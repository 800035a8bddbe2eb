#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/load_case.hpp"
#include "app/run/run_quantities.hpp"
#include "config/units.hpp"

namespace recoil::app {

namespace {

/// Why there is no value: of a record, how far it goes.
std::string why_nothing(const Quantities& found, const std::string& quantity) {
  const auto record = record_of(quantity);
  if (!record) return "did not happen";
  const auto series = std::ranges::find(found.gauges, record->gauge, &TimeSeries::name);
  if (series == found.gauges.end() || series->time.empty()) return "the record is empty";
  const SeriesColumn& over = series->over;
  return fmt::format("the record, from {:.6g} to {:.6g} {}, has no value there",
                     series->time.front() * over.to_unit, series->time.back() * over.to_unit, over.unit);
}

/// "219.406 m/s", "yes", "did not happen".
std::string shown_value(const RunQuantities& run, const std::string& quantity) {
  const double value = value_of(run, quantity);
  if (std::isnan(value)) return why_nothing(run.found, quantity);
  const bool is_flag = run.found.flags.contains(quantity) && !run.found.numbers.contains(quantity);
  if (is_flag) return value != 0 ? "yes" : "no";
  const std::string unit = unit_of(run.found, quantity);
  if (unit.empty() || unit == "1") return fmt::format("{:.6g}", value);
  return fmt::format("{:.6g} {}", config::in_unit(value, unit), unit);
}

}  // namespace

int value(const ValueOptions& o) {
  require_folder(o.folder);
  const RunQuantities run = read_quantities(o.folder, o.folder);
  std::vector<std::string> wanted = o.quantities;
  if (wanted.empty()) {
    wanted = peaks_of_gauges(run);
    wanted.insert(wanted.end(), run.names.begin(), run.names.end());
  }
  std::size_t width = 0;
  for (const std::string& q : wanted) width = std::max(width, q.size());
  for (const std::string& q : wanted) fmt::print("{:{}}  {}\n", q, width, shown_value(run, q));
  return exit_finished;
}

}  // namespace recoil::app
