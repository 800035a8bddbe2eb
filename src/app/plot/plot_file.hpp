#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/commands.hpp"
#include "app/plot/round_off.hpp"
#include "picture/axis.hpp"
#include "picture/line_chart.hpp"

namespace recoil::app {

/// An option's number with its unit, in `unit`. @throws InputError for another dimension.
double quantity_option(const std::string& text, const char* unit, const char* option);

/// Ends of colours or an axis, from --min and --max, in the unit in the brackets of `label`.
struct Limits {
  std::optional<double> lowest, highest;
};

/// @throws InputError for another dimension, for --min that is not below --max, and with --log for ends at or
/// below 0.
Limits limits_of(const PlotOptions& options, const std::string& label);

/// Limits with what is missing taken from the values (with --log from the positive ones, of them six decades
/// at most); nothing where no limit is given. @throws InputError where --log meets no positive value, or the
/// values leave nothing between a limit and their end.
std::optional<std::pair<double, double>> range_of(const PlotOptions& options, const std::string& label,
                                                  double lowest_value, double highest_value);

/// What values in the unit of `label` are; real ones where the options name limits or a logarithmic scale.
/// @param digits as in RoundOff::judge.
Spread spread_of(const PlotOptions& options, const std::string& label, const Range& values, double digits);

/// The range of values for people: where they are noise, none that would make it look like physics.
std::optional<std::pair<double, double>> shown_range(const PlotOptions& options, const std::string& label,
                                                     const Range& values, Spread spread, bool signed_values);

/// The chart with the options' title, size, limits and scale.
Canvas chart_canvas(const PlotOptions& options, LineChart chart, double digits = RoundOff::of_dumps);

/// Writes that chart of numbers in tables. @param name of the file
/// without suffix in the folder of the run, where the options name none. @returns the exit code.
int save_chart(const PlotOptions& options, LineChart chart, const std::string& name);

/// Writes the file and prints its name. @param name as in save_chart. @returns the exit code.
int save_picture(const PlotOptions& options, const Canvas& canvas, const std::string& name);

}  // namespace recoil::app
