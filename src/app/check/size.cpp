#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "app/check/checks.hpp"
#include "app/check/estimate.hpp"
#include "app/launch.hpp"
#include "app/machine.hpp"
#include "config/geometry.hpp"
#include "core/error.hpp"

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

/// What the making of the mesh refuses, at the key that decides it.
void report(LoadedCase& loaded, std::string text) {
  const std::string_view begins = "error: ", helps = "\n   = help: ";
  if (text.starts_with(begins)) text.erase(0, begins.size());
  const std::size_t help = std::min(text.find(helps), text.size());
  const bool levels = text.find("levels") != std::string::npos;
  const config::Place mesh = place_of(loaded, "mesh.finest", {loaded.contents.file});
  loaded.found.error(levels ? place_of(loaded, "mesh.levels", mesh) : mesh, text.substr(0, help),
                     help < text.size() ? text.substr(help + helps.size()) : "");
}

}  // namespace

void check_size(LoadedCase& loaded) {
  const config::Case& c = loaded.contents;
  const int dim = config::dimension(c.domain.geometry);
  const double room = usable * machine_memory();
  double longest = 0;
  const double cells = cells_of(c, longest);
  // The number of steps does not matter here.
  double need = cells * bytes_of_cell(c);
  try {
    if (longest <= most_along_axis) need = estimate(c, loaded.materials, 1).memory;
  } catch (const InputError& e) {  // cells that do not fit into the domain
    return report(loaded, e.what());
  }
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
