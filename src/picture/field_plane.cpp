#include "picture/field_plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "picture/field_scalar.hpp"
#include "picture/raster.hpp"

namespace recoil {

namespace {

/// Whether there is matter inside of a body: not in a rigid one.
bool holds_matter(const UnstructuredGrid& grid, const std::vector<double>& phi) {
  const std::vector<double> fraction = as_doubles(find_array(grid, "volume_fraction").values);
  double inside = 0, filled = 0;
  for (std::size_t k = 0; k < phi.size(); ++k) {
    if (!(phi[k] < 0)) continue;
    inside += 1;
    filled += fraction[k];
  }
  return filled > 0.5 * inside;
}

}  // namespace

std::vector<ChosenDump> all_dumps(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "fields", ignored))
    if (entry.path().extension() == ".series") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  std::vector<SeriesEntry> entries;
  if (!found.empty()) entries = read_series(found.front());
  if (entries.empty())
    throw InputError(fmt::format("error: there are no fields in '{}'", directory.string()));
  std::vector<ChosenDump> dumps;
  for (const SeriesEntry& e : entries) dumps.push_back({directory / "fields" / e.name, e.time_s});
  return dumps;
}

ChosenDump choose_dump(const std::filesystem::path& directory, std::optional<double> time_s) {
  const std::vector<ChosenDump> dumps = all_dumps(directory);
  const double last = dumps.back().time_s, wanted = time_s.value_or(last);
  if (wanted > 1.001 * last)
    throw InputError(
        fmt::format("error: {:.6g} us is beyond the end of the run\n   = help: the last fields of '{}' are "
                    "at {:.6g} us",
                    wanted * 1e6, directory.string(), last * 1e6));
  return *std::min_element(dumps.begin(), dumps.end(), [&](const auto& p, const auto& q) {
    return std::abs(p.time_s - wanted) < std::abs(q.time_s - wanted);
  });
}

Cut middle_cut(const config::Domain& domain, std::size_t axis) {
  const double lo = domain.lo[axis], hi = domain.hi[axis];
  return {axis, lo <= 0 && hi > 0 ? 0 : 0.5 * (lo + hi)};
}

FieldPlane field_plane(const VtkhdfFile& dump, const std::string& name, const RunUnits& units, Cut cut) {
  const FieldScalar wanted = find_scalar(name, units);
  const Raster raster(dump.grid, cut);
  FieldPlane plane;
  plane.label = name == "contact-state" ? "contact" : wanted.label;
  plane.signed_values = wanted.signed_values;
  plane.time_s = dump.time_s;
  plane.values = raster.of(values_of(dump.grid, wanted));
  std::vector<bool> solid;
  for (BodyField& body : bodies_of(dump.grid)) {
    solid.push_back(holds_matter(dump.grid, body.level_set));
    plane.level_sets.push_back(raster.of(body.level_set));
    plane.bodies.push_back(std::move(body.name));
  }
  if (name == "body")
    for (double& v : plane.values.values)
      if (v < 0) v = std::numeric_limits<double>::quiet_NaN();
  std::set<double> seen;
  for (const double v : plane.values.values)
    if ((name == "contact" || name == "fragment") && !std::isnan(v)) seen.insert(v);
  plane.categories = categories_of(name, plane.bodies, seen);
  plane.matter = plane.values;
  // Beyond all cells of the dump nothing is near.
  const double far = 8 * std::max(plane.values.dx, plane.values.dy);
  std::fill(plane.matter.values.begin(), plane.matter.values.end(), far);
  for (std::size_t m = 0; m < plane.level_sets.size(); ++m) {
    if (!solid[m]) continue;
    const std::vector<double>& phi = plane.level_sets[m].values;
    for (std::size_t k = 0; k < phi.size(); ++k)
      if (!std::isnan(phi[k])) plane.matter.values[k] = std::min(plane.matter.values[k], phi[k]);
  }
  return plane;
}

}  // namespace recoil
