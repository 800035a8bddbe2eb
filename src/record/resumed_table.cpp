#include "record/resumed_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "format/csv.hpp"

namespace recoil {

void cut_back(const std::filesystem::path& table, double last, std::size_t rows) {
  constexpr double round_off = 1e-9;  // of the time
  const double wanted = last * 1e6;
  truncate_csv(table, wanted);
  const CsvTable left = read_csv(table);
  const std::vector<double> times = left.numbers(left.columns.front());
  const auto found = static_cast<std::size_t>(std::ranges::count_if(
      times, [&](double t) { return std::abs(t - wanted) <= round_off * std::abs(wanted); }));
  if (found >= rows) return;
  std::string holds = "holds no row";
  if (!times.empty()) holds = fmt::format("ends at {:.6g} us", times.back());
  if (found > 0) holds = fmt::format("holds {} of {} rows of its last time", found, rows);
  throw InputError(fmt::format(
      "error: '{}' {}, but before its checkpoint the run wrote it until {:.6g} us: rows are lost\n"
      "   = help: put the whole file back, or run the case again",
      table.string(), holds, wanted));
}

}  // namespace recoil
