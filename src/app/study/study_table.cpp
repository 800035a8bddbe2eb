#include "app/study/study_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>

#include "config/units.hpp"
#include "format/csv.hpp"

namespace recoil::app {

namespace {

constexpr double round_off = 1e-10;  // of a reference or a limit: an error below it has no order
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double in_unit(double si, const std::string& unit) { return unit.empty() ? si : config::in_unit(si, unit); }

std::string number(double x, int digits) {
  return std::isfinite(x) ? fmt::format("{:.{}g}", x, digits) : "-";
}

double mean_of(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return v.empty() ? nothing : sum / static_cast<double>(v.size());
}

StudyRow row_of(const StudyTable& table, std::size_t q) {
  StudyRow row;
  row.quantity = table.quantities[q];
  row.unit = table.runs.front().values[q].unit;
  row.reference = table.runs.front().values[q].reference;
  const bool is_error = std::isnan(row.reference) && std::isfinite(table.runs.front().values[q].limit);
  std::map<double, std::vector<double>, std::greater<>> by_size;
  for (const StudyRun& run : table.runs) by_size[run.size].push_back(run.values[q].value);
  for (const auto& [size, values] : by_size) {
    row.sizes.push_back(size);
    row.mean.push_back(mean_of(values));
    const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
    row.spread.push_back(0.5 * (*hi - *lo));
    std::vector<double> errors;
    for (const double v : values) errors.push_back(is_error ? std::abs(v) : std::abs(v - row.reference));
    row.error.push_back(mean_of(errors));
  }
  const StudyValue& first = table.runs.front().values[q];
  const double scale = std::abs(is_error ? first.limit : row.reference);
  for (std::size_t i = 0; i < row.sizes.size(); ++i) {
    row.from_finest.push_back(std::abs(row.mean[i] - row.mean.back()) / std::abs(row.mean.back()));
    const bool none = i == 0 || row.quantity.starts_with("budget.") ||
                      !(std::min(row.error[i], row.error[i - 1]) > round_off * scale);
    row.order.push_back(none ? nothing
                             : std::log(row.error[i - 1] / row.error[i]) /
                                   std::log(row.sizes[i - 1] / row.sizes[i]));
  }
  return row;
}

std::string cell(const StudyRow& row, std::size_t i) {
  std::string text = number(in_unit(row.mean[i], row.unit), 5);
  if (row.spread[i] > 0)
    text += " ± " + number(row.spread[i] / (row.unit.empty() ? 1 : config::unit_size(row.unit)), 2);
  if (std::isfinite(row.reference) && row.reference != 0)
    text += fmt::format(" ({} %)", number(100 * row.error[i] / std::abs(row.reference), 2));
  return text;
}

std::string heading(const StudyRow& row) {
  std::string head = "| quantity | reference |", rule = "|---|---|";
  for (const double size : row.sizes) {
    head += fmt::format(" {} mm |", number(size * 1e3, 4));
    rule += "---|";
  }
  return head + " order |\n" + rule + "---|\n";
}

}  // namespace

std::vector<StudyRow> rows_of(const StudyTable& table) {
  std::vector<StudyRow> rows;
  for (std::size_t q = 0; !table.runs.empty() && q < table.quantities.size(); ++q)
    rows.push_back(row_of(table, q));
  return rows;
}

std::string study_markdown(const StudyTable& table) {
  const std::vector<StudyRow> rows = rows_of(table);
  std::string text = fmt::format("# {}\n\n", table.title);
  if (rows.empty()) return text + "The case has no expected numbers to tabulate.\n";
  text +=
      "Mean over the shifts of the mesh ± half their range, and in brackets the mean error against the "
      "reference. "
      "Order: of that error,\nfrom each mesh to the next.\n\n" +
      heading(rows.front());
  for (const StudyRow& row : rows) {
    text += fmt::format("| {} [{}] | {} |", row.quantity, row.unit.empty() ? "1" : row.unit,
                        number(in_unit(row.reference, row.unit), 5));
    for (std::size_t i = 0; i < row.sizes.size(); ++i) text += ' ' + cell(row, i) + " |";
    std::string orders;
    for (std::size_t i = 1; i < row.order.size(); ++i)
      orders += (i > 1 ? ", " : "") + number(row.order[i], 2);
    text += ' ' + (orders.empty() ? "-" : orders) + " |\n";
  }
  text +=
      "\nAgainst the finest mesh of the table itself, |q - q_finest| / |q_finest| (the measure of the "
      "contact-separation paper, eq. 27).\nIt vanishes by construction on the last mesh, and makes a "
      "first-order "
      "method look better than that.\n\n" +
      heading(rows.front());
  for (const StudyRow& row : rows) {
    if (std::isnan(row.reference)) continue;
    text += fmt::format("| {} | |", row.quantity);
    for (const double e : row.from_finest) text += ' ' + number(100 * e, 2) + " % |";
    text += " |\n";
  }
  return text;
}

std::string study_csv(const StudyTable& table) {
  std::string text = "quantity,unit,mesh [mm],offset [1],value,reference,error\n";
  for (const StudyRun& run : table.runs)
    for (std::size_t q = 0; q < run.values.size(); ++q) {
      const StudyValue& v = run.values[q];
      const double size = v.unit.empty() ? 1 : config::unit_size(v.unit);
      text += fmt::format(
          "\"{}\",{},{},{},{},{},{}\n", table.quantities[q], v.unit.empty() ? "1" : v.unit,
          format_number(run.size * 1e3), format_number(run.offset), format_number(in_unit(v.value, v.unit)),
          format_number(in_unit(v.reference, v.unit)), format_number((v.value - v.reference) / size));
    }
  return text;
}

}  // namespace recoil::app
