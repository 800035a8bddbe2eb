#include "app/study/study_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>

#include "config/units.hpp"
#include "core/nothing.hpp"
#include "format/csv.hpp"

namespace recoil::app {

namespace {

constexpr double round_off = 1e-10;  // of a reference or a limit: an error below it has no order

double in_unit(double si, const std::string& unit) { return unit.empty() ? si : config::in_unit(si, unit); }

double mean_of(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return v.empty() ? nothing : sum / static_cast<double>(v.size());
}

/// Order and value of the three finest meshes.
void extrapolate(StudyRow& row) {
  row.own_order = row.extrapolated = nothing;
  const std::size_t n = row.sizes.size();
  if (n < 3 || row.quantity.starts_with("budget.")) return;
  const std::array sizes{row.sizes[n - 3], row.sizes[n - 2], row.sizes[n - 1]};
  const std::array values{row.mean[n - 3], row.mean[n - 2], row.mean[n - 1]};
  row.own_order = observed_order(sizes, values);
  row.extrapolated = extrapolated_value(sizes, values, row.own_order);
}

StudyRow row_of(const StudyTable& table, std::size_t q) {
  StudyRow row;
  row.quantity = table.quantities[q];
  row.unit = table.runs.front().values[q].unit;
  row.reference = table.runs.front().values[q].reference;
  const bool is_error = row.is_error =
      std::isnan(row.reference) && std::isfinite(table.runs.front().values[q].limit);
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
  extrapolate(row);
  return row;
}

std::string cell(const StudyRow& row, std::size_t i) {
  std::string text = format_number(in_unit(row.mean[i], row.unit), 5);
  if (row.spread[i] > 0)
    text += " ± " + format_number(row.spread[i] / (row.unit.empty() ? 1 : config::unit_size(row.unit)), 2);
  if (std::isfinite(row.reference) && row.reference != 0)
    text += fmt::format(" ({} %)", format_number(100 * row.error[i] / std::abs(row.reference), 2));
  return text;
}

std::string heading(const StudyRow& row, const char* first, const char* last) {
  std::string head = fmt::format("| quantity | {} |", first), rule = "|---|---|";
  for (const double size : row.sizes) {
    head += fmt::format(" {} mm |", format_number(size * 1e3, 4));
    rule += "---|";
  }
  return fmt::format("{} {} |\n{}---|\n", head, last, rule);
}

}  // namespace

std::vector<StudyRow> rows_of(const StudyTable& table) {
  std::vector<StudyRow> rows;
  for (std::size_t q = 0; !table.runs.empty() && q < table.quantities.size(); ++q)
    rows.push_back(row_of(table, q));
  return rows;
}

double observed_order(const std::array<double, 3>& sizes, const std::array<double, 3>& values) {
  constexpr double least = 0.1, most = 10;
  const double ratio = (values[0] - values[1]) / (values[1] - values[2]);
  const double scale = std::max(std::abs(values[1]), std::abs(values[2]));
  if (!(std::abs(values[1] - values[2]) > round_off * scale) || !(ratio > 0)) return nothing;
  // (h0^p - h1^p) / (h1^p - h2^p) rises with p.
  const auto rises_beyond = [&](double p) {
    const double a = std::pow(sizes[0] / sizes[2], p), b = std::pow(sizes[1] / sizes[2], p);
    return (a - b) / (b - 1) > ratio;
  };
  double lo = least, hi = most;
  if (rises_beyond(lo) || !rises_beyond(hi)) return nothing;
  while (hi - lo > round_off) (rises_beyond(0.5 * (lo + hi)) ? hi : lo) = 0.5 * (lo + hi);
  return 0.5 * (lo + hi);
}

double extrapolated_value(const std::array<double, 3>& sizes, const std::array<double, 3>& values,
                          double order) {
  return values[2] + (values[2] - values[1]) / (std::pow(sizes[1] / sizes[2], order) - 1);
}

namespace {

std::string main_table(const std::vector<StudyRow>& rows) {
  std::string text =
      "Mean over the shifts of the mesh ± half their range, and in brackets the mean error against the "
      "reference. "
      "Order: of that error,\nfrom each mesh to the next.\n\n" +
      heading(rows.front(), "reference", "order");
  for (const StudyRow& row : rows) {
    text += fmt::format("| {} [{}] | {} |", row.quantity, row.unit.empty() ? "1" : row.unit,
                        format_number(in_unit(row.reference, row.unit), 5));
    for (std::size_t i = 0; i < row.sizes.size(); ++i) text += ' ' + cell(row, i) + " |";
    std::string orders;
    for (std::size_t i = 1; i < row.order.size(); ++i)
      orders += (i > 1 ? ", " : "") + format_number(row.order[i], 2);
    text += ' ' + (orders.empty() ? "-" : orders) + " |\n";
  }
  return text;
}

/// Errors by themselves (of an upper limit) are left out: they have no value to go to but zero.
std::string own_table(const std::vector<StudyRow>& rows) {
  std::string text =
      "\nAgainst the finest mesh of the table itself, |q - q_finest| / |q_finest| (the measure of the "
      "contact-separation paper, eq. 27).\nIt vanishes by construction on the last mesh, and makes a "
      "first-order "
      "method look better than that. Order and the value at cells of size zero\n(Richardson): from the three "
      "finest meshes, where they approach each other from one side.\n\n" +
      heading(rows.front(), "extrapolated", "order");
  for (const StudyRow& row : rows) {
    if (row.is_error) continue;
    text += fmt::format("| {} [{}] | {} |", row.quantity, row.unit.empty() ? "1" : row.unit,
                        format_number(in_unit(row.extrapolated, row.unit), 5));
    for (const double e : row.from_finest) text += ' ' + format_number(100 * e, 2) + " % |";
    text += ' ' + format_number(row.own_order, 2) + " |\n";
  }
  return text;
}

}  // namespace

std::string study_markdown(const StudyTable& table) {
  const std::vector<StudyRow> rows = rows_of(table);
  const std::string title = fmt::format("# {}\n\n", table.title);
  if (rows.empty()) return title + "The case has no expected numbers to tabulate.\n";
  return title + main_table(rows) + own_table(rows);
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
