#include "app/plot/plot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>

#include "config/units.hpp"
#include "core/error.hpp"
#include "picture/axis.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// "2", in the label's unit, or "2 GPa".
std::optional<double> limit(const std::string& text, const std::string& unit, const char* option) {
  if (text.empty()) return std::nullopt;
  if (const config::Quantity plain = config::parse_quantity(text, "1", option); plain.ok())
    return plain.value;
  return quantity_option(text, unit.c_str(), option);
}

}  // namespace

double quantity_option(const std::string& text, const char* unit, const char* option) {
  const config::Quantity q = config::parse_quantity(text, unit, option);
  if (!q.ok()) throw InputError(fmt::format("{}\n   = help: {}", q.problem, q.help));
  return q.value;
}

Limits limits_of(const PlotOptions& o, const std::string& label) {
  const std::string unit = unit_in(label);
  const Limits limits{limit(o.lowest, unit, "--min"), limit(o.highest, unit, "--max")};
  if (limits.lowest && limits.highest && !(*limits.lowest < *limits.highest))
    throw InputError(fmt::format("--min {} is not below --max {}", o.lowest, o.highest));
  for (const auto& end : {limits.lowest, limits.highest})
    if (o.log && end && !(*end > 0))
      throw InputError(
          "a logarithmic scale needs positive limits\n   = help: omit --log, or give a --min above 0");
  return limits;
}

std::optional<std::pair<double, double>> range_of(const PlotOptions& o, const std::string& label,
                                                  double lowest_value, double highest_value) {
  const Limits limits = limits_of(o, label);
  if (o.log && !(highest_value > 0) && !(limits.lowest && limits.highest))
    throw InputError("--log needs positive values, and there are none\n   = help: omit it");
  if (!limits.lowest && !limits.highest) return std::nullopt;
  const double highest = limits.highest.value_or(highest_value);
  if (o.log) lowest_value = std::max(lowest_value, 1e-6 * highest);
  const double lowest = limits.lowest.value_or(lowest_value);
  if (!(lowest < highest))
    throw InputError(fmt::format("no value lies {}\n   = help: the values go from {:.4g} to {:.4g}",
                                 limits.lowest ? "above --min " + o.lowest : "below --max " + o.highest,
                                 lowest_value, highest_value));
  return std::pair{lowest, highest};
}

Spread spread_of(const PlotOptions& o, const std::string& label, const Range& values, double digits) {
  if (o.log || !o.lowest.empty() || !o.highest.empty()) return Spread::real;
  return o.round_off.judge(unit_in(label), values.lo, values.hi, digits);
}

std::optional<std::pair<double, double>> shown_range(const PlotOptions& o, const std::string& label,
                                                     const Range& values, Spread spread, bool signed_values) {
  if (const auto honest =
          honest_range(spread, o.round_off.in(unit_in(label)), values.lo, values.hi, signed_values))
    return honest;
  return range_of(o, label, values.lo, values.hi);
}

Canvas chart_canvas(const PlotOptions& o, LineChart chart, double digits) {
  Range values;
  for (const Series& s : chart.series)
    for (const double y : s.y) values.include(y, o.log);
  const Spread spread = spread_of(o, chart.y_title, values, digits);
  chart.y_range = shown_range(o, chart.y_title, values, spread, false);
  chart.y_title = noted(chart.y_title, spread);
  chart.log_y = o.log;
  if (!o.title.empty()) chart.title = o.title;
  if (o.width > 0) chart.width = o.width;
  if (o.height > 0) chart.height = o.height;
  return line_chart(chart);
}

int save_chart(const PlotOptions& o, LineChart chart, const std::string& name) {
  return save_picture(o, chart_canvas(o, std::move(chart), RoundOff::of_tables), name);
}

int save_picture(const PlotOptions& o, const Canvas& canvas, const std::string& name) {
  const fs::path file = o.file.empty() ? fs::path(o.folder) / (name + ".png") : fs::path(o.file);
  write_picture(file, canvas);
  fmt::print("{}\n", file.string());
  return 0;
}

}  // namespace recoil::app
