#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/commands.hpp"
#include "app/field_plot.hpp"
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
    throw InputError(fmt::format("'{}' names no column\n   = help: write --reference FILE.csv:COLUMN", text));
  Series s = curve(read_csv(text.substr(0, colon)), text.substr(colon + 1), over, unit, "reference");
  s.style = kReferenceStyle;
  return s;
}

/// Of one run the gauge is named, of several the run.
std::string label_of(const fs::path& folder, const PlotOptions& o, const std::string& gauge) {
  return o.others.empty() ? gauge : fs::absolute(folder).lexically_normal().filename().string();
}

int plot_gauge(const PlotOptions& o, const std::string& name) {
  const fs::path file = fs::path(o.folder) / "gauges" / (name + ".csv");
  const std::vector<std::string> names = gauges_in(o.folder);
  if (!fs::exists(file)) {
    const std::string near = did_you_mean(name, names);
    throw InputError(fmt::format("there is no gauge '{}' in {}{}{}", name, o.folder,
                                 near.empty() ? "" : "\n   = help: ", near));
  }
  const CsvTable table = read_csv(file);
  if (table.columns.size() < 2)
    throw InputError(fmt::format("{} holds no column but the time", file.string()));
  const std::string column = table.columns[o.what.size() > 1 ? table.index(o.what[1]) : 1];
  LineChart chart;
  chart.title = o.others.empty()
                    ? fmt::format("{}, {}", fs::path(o.folder).lexically_normal().filename().string(), name)
                    : name;
  const std::string over = table.unit(table.columns.front());
  chart.x_title = over == "us" ? "time [µs]" : table.columns.front();
  chart.y_title = column;
  if (!o.reference.empty()) chart.series.push_back(reference_curve(o.reference, over, table.unit(column)));
  chart.series.push_back(curve(table, column, over, table.unit(column), label_of(o.folder, o, name)));
  for (const std::string& other : o.others) {
    const CsvTable more = read_csv(fs::path(other) / "gauges" / (name + ".csv"));
    chart.series.push_back(curve(more, column, over, table.unit(column), label_of(other, o, name)));
  }
  // A reference may go on for longer than the run.
  const std::vector<double>& span = chart.series[o.reference.empty() ? 0 : 1].x;
  if (!o.reference.empty() && !span.empty()) chart.x_range = {span.front(), span.back()};
  const fs::path png = o.file.empty() ? fs::path(o.folder) / (name + ".png") : fs::path(o.file);
  write_png(png, line_chart(chart));
  fmt::print("{}\n", png.string());
  return 0;
}

}  // namespace

int plot(const PlotOptions& given) {
  PlotOptions o = given;
  if (o.what.size() > 1 && o.what.back().ends_with(".png")) {
    if (o.file.empty()) o.file = o.what.back();
    o.what.pop_back();
  }
  if (!fs::is_directory(o.folder)) throw InputError(fmt::format("there is no folder {}", o.folder));
  const std::string& what = o.what.front();
  if (what.starts_with("gauge.")) return plot_gauge(o, what.substr(6));
  if (fs::exists(fs::path(o.folder) / "gauges" / (what + ".csv"))) return plot_gauge(o, what);
  return o.over_time ? plot_field_over_time(o) : plot_field(o);
}

}  // namespace recoil::app
