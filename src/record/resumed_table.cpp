#include "record/resumed_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "format/csv.hpp"

namespace recoil {

void cut_back(const std::filesystem::path& table, double last) {
  constexpr double round_off = 1e-9;  // of the time
  const double wanted = last * 1e6, end = truncate_csv(table, wanted);
  if (std::abs(end - wanted) <= round_off * std::abs(wanted)) return;
  throw InputError(fmt::format(
      "error: '{}' {}, but before its checkpoint the run wrote it until {:.6g} us: rows are lost\n"
      "   = help: put the whole file back, or run the case again",
      table.string(), std::isfinite(end) ? fmt::format("ends at {:.6g} us", end) : "holds no row", wanted));
}

}  // namespace recoil
