#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/commands.hpp"
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

/// The chart with the options' title, size, limits and scale.
Canvas chart_canvas(const PlotOptions& options, LineChart chart);

/// Writes that chart. @param name of the file
/// without suffix in the folder of the run, where the options name none. @returns the exit code.
int save_chart(const PlotOptions& options, LineChart chart, const std::string& name);

/// Writes the file and prints its name. @param name as in save_chart. @returns the exit code.
int save_picture(const PlotOptions& options, const Canvas& canvas, const std::string& name);

}  // namespace recoil::app
