#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "app/check/checks.hpp"
#include "app/check/estimate.hpp"
#include "app/launch.hpp"
#include "app/machine.hpp"
#include "config/geometry.hpp"

namespace recoil::app {

namespace {

/// More cells along an axis than this cannot be numbered.
constexpr double most_along_axis = 1e9;

/// Part of the machine's memory that a run may take: the system needs some.
constexpr double usable = 0.9;

double cells_of(const config::Case& c, double& longest) {
  double cells = 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(config::dimension(c.domain.geometry)); ++d) {
    const double along = (c.domain.hi[d] - c.domain.lo[d]) / c.mesh.finest;
    longest = std::max(longest, along);
    cells *= along;
  }
  return cells;
}

}  // namespace

void check_size(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  const int dim = config::dimension(c.domain.geometry);
  const double room = usable * machine_memory();
  double longest = 0;
  const double cells = cells_of(c, longest);
  // The number of steps does not matter here.
  const double need =
      longest > most_along_axis ? cells * bytes_of_cell(dim) : estimate(c, loaded.materials, 1).memory;
  if (longest <= most_along_axis && need <= room) return;
  const double over = std::isfinite(room) ? need / room : 0;
  const double coarser = std::max(std::pow(over, 1.0 / dim), longest / most_along_axis) * 1.05;
  const std::string message =
      fmt::format("{:.3g} cells need about {:.3g} GB, but this machine has {:.3g} GB of memory", cells,
                  need * 1e-9, room / usable * 1e-9);
  const std::string help = fmt::format("finest = \"{:.3g} mm\" would fit", c.mesh.finest * coarser * 1e3);
  const config::Place place = place_of(loaded, "mesh.finest", {c.file});
  // Several machines may share a run that was launched on them.
  if (launched() && longest <= most_along_axis) return loaded.found.warning(place, message, help);
  loaded.found.error(place, message, help);
  loaded.too_large = true;
}

}  // namespace recoil::app
