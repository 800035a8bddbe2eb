#include "config/section/mesh.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "config/declare/reading.hpp"

namespace recoil::config {

void MeshChoice::check(const TableReading& reading) const {
  const CaseReading& in = reading.in;
  if (!reading.good("finest")) return;
  for (std::size_t d = 0; d < in.axes.size(); ++d) {
    const double extent = in.hi[d] - in.lo[d];
    if (!(extent > 0) || extent >= 3.999 * finest) continue;
    reading.wrong("finest",
                  fmt::format("the domain is {:.3g} cells wide along {}; at least 4 are needed",
                              extent / finest, in.axes[d]),
                  fmt::format("finest = \"{:.4g} mm\" gives 40", 1e3 * extent / 40));
  }
}

}  // namespace recoil::config
