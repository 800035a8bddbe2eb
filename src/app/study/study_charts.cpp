#include "app/study/study_charts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "config/units.hpp"
#include "core/nothing.hpp"
#include "format/csv.hpp"
#include "picture/line_chart.hpp"
#include "record/quantities.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// Errors of more quantities than this are no chart any more.
constexpr std::size_t most_curves = 9;

bool write_errors(const fs::path& png, const StudyTable& table) {
  LineChart chart;
  chart.title = table.title + ": error";
  chart.x_title = "cells [mm]";
  chart.y_title = "error against the reference [%]";
  chart.log_x = chart.log_y = true;
  for (const StudyRow& row : rows_of(table)) {
    if (!std::isfinite(row.reference) || row.reference == 0 || chart.series.size() == most_curves) continue;
    Series s;
    s.label = row.quantity;
    s.style.markers = true;
    for (std::size_t k = 0; k < row.sizes.size(); ++k) {
      const double error = 100 * row.error[k] / std::abs(row.reference);
      s.x.push_back(row.sizes[k] * 1e3);
      s.y.push_back(error > 0 ? error : nothing);
    }
    chart.series.push_back(std::move(s));
  }
  if (chart.series.empty()) return false;
  write_picture(png, line_chart(chart));
  return true;
}

/// The records that quantities are read from, each once, with the curve that one of them compares it with.
std::vector<ReferenceCurve> records_of(const std::vector<std::string>& quantities) {
  std::vector<ReferenceCurve> all;
  for (const std::string& quantity : quantities) {
    const auto record = record_of(quantity);
    if (!record) continue;
    const auto same = std::ranges::find_if(
        all, [&](const ReferenceCurve& r) { return r.gauge == record->gauge && r.column == record->column; });
    if (same == all.end())
      all.push_back(*record);
    else if (same->file.empty())
      *same = *record;
  }
  return all;
}

Series curve_in(const CsvTable& table, const std::string& column, const CsvTable& like,
                const std::string& like_column, const std::string& label) {
  const auto factor = [](const std::string& own, const std::string& wanted) {
    return own.empty() || wanted.empty() || own == wanted
               ? 1
               : config::unit_size(own) / config::unit_size(wanted);
  };
  Series s{label, table.numbers(table.columns.front()), table.numbers(column), {}};
  for (double& x : s.x) x *= factor(table.unit(table.columns.front()), like.unit(like.columns.front()));
  for (double& y : s.y) y *= factor(table.unit(column), like.unit(like_column));
  return s;
}

void write_record(const fs::path& png, const ReferenceCurve& c, const StudyTable& table,
                  const std::vector<StudyMesh>& meshes, const fs::path& case_folder) {
  LineChart chart;
  chart.title = table.title;
  chart.note = c.gauge;
  for (const StudyMesh& mesh : meshes) {
    const CsvTable record = read_csv(mesh.run / "gauges" / (c.gauge + ".csv"));
    if (chart.series.empty()) {
      chart.x_title = record.columns.front();
      chart.y_title = record.columns[record.index(c.column)];
    }
    chart.series.push_back(curve_in(record, c.column, record, c.column, mesh.size));
    chart.series.back().style.width = 2;
    if (&mesh != &meshes.back()) continue;
    const Series& last = chart.series.back();
    if (!last.x.empty()) chart.x_range = {last.x.front(), last.x.back()};
    if (c.file.empty()) continue;
    Series reference = curve_in(read_csv(case_folder / c.file), c.file_column, record, c.column, "reference");
    reference.style = kReferenceStyle;
    chart.series.push_back(std::move(reference));
  }
  write_picture(png, line_chart(chart));
}

}  // namespace

std::vector<fs::path> write_study_charts(const fs::path& folder, const StudyTable& table,
                                         const std::vector<StudyMesh>& meshes, const fs::path& case_folder) {
  std::vector<fs::path> files;
  if (table.runs.empty() || meshes.empty()) return files;
  if (write_errors(folder / "error.png", table)) files.push_back(folder / "error.png");
  for (const ReferenceCurve& record : records_of(table.quantities)) {
    files.push_back(folder / fmt::format("{}_{}.png", record.gauge, record.column));
    write_record(files.back(), record, table, meshes, case_folder);
  }
  return files;
}

}  // namespace recoil::app
