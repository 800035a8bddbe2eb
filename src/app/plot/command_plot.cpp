#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/load_case.hpp"
#include "app/plot/field_plot.hpp"
#include "app/plot/plot_file.hpp"
#include "config/units.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"
#include "format/csv.hpp"
#include "picture/line_chart.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> gauges_in(const fs::path& run) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(run / "gauges", error))
    if (entry.path().extension() == ".csv") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// What to multiply a column by to have it in `unit`; 1 where it names no unit.
double factor(const CsvTable& table, const std::string& column, const std::string& unit) {
  const std::string own = table.unit(column);
  return own.empty() || unit.empty() || own == unit ? 1 : config::unit_size(own) / config::unit_size(unit);
}

Series curve(const CsvTable& table, const std::string& column, const std::string& over,
             const std::string& unit, std::string label) {
  Series s{std::move(label), table.numbers(table.columns.front()), table.numbers(column)};
  for (double& t : s.x) t *= factor(table, table.columns.front(), over);
  for (double& y : s.y) y *= factor(table, column, unit);
  return s;
}

Series reference_curve(const std::string& text, const std::string& over, const std::string& unit) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos)
    throw InputError(
        fmt::format("'{}' does not name a column\n   = help: write --reference FILE.csv:COLUMN", text));
  Series s = curve(read_csv(text.substr(0, colon)), text.substr(colon + 1), over, unit, "reference");
  s.style = kReferenceStyle;
  return s;
}

/// Of one run the gauge is named, of several the run.
std::string label_of(const fs::path& folder, const PlotOptions& o, const std::string& gauge) {
  return o.others.empty() ? gauge : fs::absolute(folder).lexically_normal().filename().string();
}

/// A column of one table, by its name in every run: `what` is "gauges/rear.csv" or "history.csv".
struct Record {
  std::string what, name, column;
};

int plot_record(PlotOptions o, const Record& record) {
  o.round_off = round_off_of(o.folder);
  const CsvTable table = read_csv(fs::path(o.folder) / record.what);
  if (table.columns.size() < 2)
    throw InputError(fmt::format("{} has no column besides the time", table.path.string()));
  const std::string column = table.columns[record.column.empty() ? 1 : table.index(record.column)];
  const std::string unit = table.unit(column), over = table.unit(table.columns.front());
  LineChart chart;
  chart.title =
      o.others.empty()
          ? fmt::format("{}, {}", fs::path(o.folder).lexically_normal().filename().string(), record.name)
          : record.name;
  chart.x_title = table.columns.front();
  chart.y_title = column;
  if (!o.reference.empty()) chart.series.push_back(reference_curve(o.reference, over, unit));
  chart.series.push_back(curve(table, column, over, unit, label_of(o.folder, o, record.name)));
  if (std::ranges::none_of(chart.series.back().y, [](double y) { return std::isfinite(y); }))
    throw InputError(
        fmt::format("there is no number in '{}' of {}\n   = help: nan means that there was nothing to "
                    "measure; other columns: {}",
                    column, table.path.string(), fmt::join(std::span(table.columns).subspan(1), ", ")));
  for (const std::string& other : o.others)
    chart.series.push_back(
        curve(read_csv(fs::path(other) / record.what), column, over, unit, label_of(other, o, record.name)));
  if (chart.series.size() == 1) chart.series.front().label.clear();  // it is in the title
  // A reference may go on for longer than the run.
  const std::vector<double>& span = chart.series[o.reference.empty() ? 0 : 1].x;
  if (!o.reference.empty() && !span.empty()) chart.x_range = {span.front(), span.back()};
  return save_chart(o, std::move(chart), record.name);
}

/// @throws InputError where a run has no gauge of that name.
void require_gauge(const std::string& run, const std::string& file, const std::string& name) {
  if (fs::exists(fs::path(run) / file)) return;
  require_folder(run);
  const std::vector<std::string> all = gauges_in(run);
  const std::string near = did_you_mean(name, all);
  throw InputError(fmt::format("there is no gauge '{}' in {}\n   = help: {}", name, run,
                               !near.empty() ? near
                               : all.empty()
                                   ? std::string("it has no gauges; [gauge.NAME] in the case makes one")
                                   : fmt::format("it has {}", fmt::join(all, ", "))));
}

int plot_gauge(const PlotOptions& o, const std::string& name) {
  const std::string file = "gauges/" + name + ".csv";
  require_gauge(o.folder, file, name);
  for (const std::string& other : o.others) require_gauge(other, file, name);
  return plot_record(o, {file, name, o.what.size() > 1 ? o.what[1] : ""});
}

/// @throws InputError for a second word after a gauge that is neither a column nor the name of a picture.
void refuse_unknown_file(const PlotOptions& o) {
  const std::string name = o.what.front().substr(o.what.front().starts_with("gauge.") ? 6 : 0);
  const fs::path file = fs::path(o.folder) / "gauges" / (name + ".csv");
  if (!fs::exists(file) || fs::path(o.what.back()).extension().empty()) return;
  const CsvTable table = read_csv(file);
  if (table.has(o.what.back())) return;
  throw InputError(fmt::format(
      "'{}' is neither a file that ends in .png, .svg or .pdf nor a column of the gauge '{}'\n   = "
      "help: its columns are {}",
      o.what.back(), name, fmt::join(std::span(table.columns).subspan(1), ", ")));
}

/// Takes the file off the words, if one is given: after a gauge and its column, or behind anything else.
void take_file(PlotOptions& o, bool is_gauge) {
  if (o.what.size() < 2) return;
  const std::string suffix = fs::path(o.what.back()).extension().string();
  const bool known = suffix == ".png" || suffix == ".svg" || suffix == ".pdf";
  if (!known && is_gauge && o.what.size() == 2) return refuse_unknown_file(o);
  picture_format(o.what.back());
  if (!o.file.empty()) throw InputError(fmt::format("two files are given: {} and {}", o.what.back(), o.file));
  o.file = o.what.back();
  o.what.pop_back();
  if (o.what.size() > (is_gauge ? 2U : 1U))
    throw InputError(fmt::format("unexpected argument '{}'", o.what.back()));
}

}  // namespace

int plot(const PlotOptions& given) {
  PlotOptions o = given;
  require_folder(o.folder);
  const std::string what = o.what.front();
  const bool is_gauge =
      what.starts_with("gauge.") || fs::exists(fs::path(o.folder) / "gauges" / (what + ".csv"));
  take_file(o, is_gauge);
  if (!o.file.empty()) picture_format(o.file);  // before the work
  if (is_gauge) return plot_gauge(o, what.starts_with("gauge.") ? what.substr(6) : what);
  if (what.starts_with("history.")) return plot_record(o, {"history.csv", what, what.substr(8)});
  return o.over_time ? plot_field_over_time(o) : plot_field(o);
}

}  // namespace recoil::app
