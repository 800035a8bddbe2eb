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
#include "core/nothing.hpp"
#include "picture/field_scalar.hpp"
#include "picture/raster.hpp"
#include "picture/space/cell_lookup.hpp"

namespace recoil {

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

namespace {

/// An array of places in an oblique plane.
class ObliqueRaster {
 public:
  ObliqueRaster(const UnstructuredGrid& grid, const SpacePlane& plane) : cells_(grid), plane_(plane) {
    const auto axes = axes_of(plane);
    const double dx = cells_.finest();
    std::array<double, 2> lo{}, hi{};
    for (std::size_t k = 0; k < 2; ++k)
      for (int d = 0; d < 3; ++d) {
        const double a = axes[k][d] * cells_.box().lo[d], b = axes[k][d] * cells_.box().hi[d];
        lo[k] += std::min(a, b), hi[k] += std::max(a, b);
      }
    const auto count = [&](std::size_t k) {
      return static_cast<int>(std::clamp(std::ceil((hi[k] - lo[k]) / dx), 1.0, 4096.0));
    };
    empty_ = {count(0), count(1), lo[0], lo[1], (hi[0] - lo[0]) / count(0), (hi[1] - lo[1]) / count(1), {}};
    crop();
  }

  /// The value of the cell that holds the place.
  PlaneArray of(const std::vector<double>& values) const {
    return filled([&](const Vec<3>& x) {
      const int cell = cells_.at(x);
      return cell < 0 ? nothing : values[static_cast<std::size_t>(cell)];
    });
  }
  /// Linear between the middles of cells; NaN without a cell.
  PlaneArray linear(const std::vector<double>& values) const {
    return filled([&](const Vec<3>& x) {
      if (cells_.at(x) < 0) return nothing;
      const CellLookup::Corners c = cells_.around(x);
      double sum = 0, weight = 0;
      for (std::size_t n = 0; n < 8; ++n) {
        if (c.cell[n] < 0) continue;
        sum += c.weight[n] * values[static_cast<std::size_t>(c.cell[n])];
        weight += c.weight[n];
      }
      return weight > 0 ? sum / weight : nothing;
    });
  }

 private:
  template <class F>
  PlaneArray filled(F&& value) const {
    const auto [across, up] = axes_of(plane_);
    PlaneArray a = empty_;
    a.values.reserve(static_cast<std::size_t>(a.nx) * static_cast<std::size_t>(a.ny));
    for (int j = 0; j < a.ny; ++j)
      for (int i = 0; i < a.nx; ++i)
        a.values.push_back(value(plane_.normal * plane_.distance + across * (a.x0 + (i + 0.5) * a.dx) +
                                 up * (a.y0 + (j + 0.5) * a.dy)));
    return a;
  }
  /// Leaves the part of the array that meets cells.
  void crop() {
    const PlaneArray met = filled([&](const Vec<3>& x) { return 1.0 * cells_.at(x); });
    int i0 = met.nx, i1 = -1, j0 = met.ny, j1 = -1;
    for (int j = 0; j < met.ny; ++j)
      for (int i = 0; i < met.nx; ++i)
        if (met.at(i, j) >= 0)
          i0 = std::min(i0, i), i1 = std::max(i1, i), j0 = std::min(j0, j), j1 = std::max(j1, j);
    if (i1 < 0) throw InputError("the plane lies outside of all matter\n   = help: choose another --slice");
    empty_ = {i1 - i0 + 1, j1 - j0 + 1, met.x0 + i0 * met.dx, met.y0 + j0 * met.dy, met.dx, met.dy, {}};
  }

  CellLookup cells_;
  SpacePlane plane_;
  PlaneArray empty_;
};

/// @param of,linear arrays of the plane from values of cells.
template <class Of, class Linear>
FieldPlane plane_from(const VtkhdfFile& dump, const std::string& name, const RunUnits& units, Of&& of,
                      Linear&& linear) {
  const FieldScalar wanted = find_scalar(name, units);
  FieldPlane plane;
  plane.label = name == "contact-state" ? "contact" : wanted.label;
  plane.signed_values = wanted.signed_values;
  plane.time_s = dump.time_s;
  plane.values = of(values_of(dump.grid, wanted));
  std::vector<bool> solid;
  for (BodyField& body : bodies_of(dump.grid)) {
    solid.push_back(holds_matter(dump.grid, body.level_set));
    plane.level_sets.push_back(linear(body.level_set));
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

}  // namespace

std::array<Vec<3>, 2> axes_of(const SpacePlane& plane) {
  const Vec<3>& n = plane.normal;
  const double flat = std::hypot(n[0], n[1]);
  const Vec<3> across = flat > 1e-9 ? Vec<3>{{-n[1] / flat, n[0] / flat, 0}} : Vec<3>{{1, 0, 0}};
  return {across,
          {{n[1] * across[2] - n[2] * across[1], n[2] * across[0] - n[0] * across[2],
            n[0] * across[1] - n[1] * across[0]}}};
}

FieldPlane field_plane(const VtkhdfFile& dump, const std::string& name, const RunUnits& units, Cut cut) {
  const Raster raster(dump.grid, cut);
  const auto of = [&raster](const std::vector<double>& values) { return raster.of(values); };
  return plane_from(dump, name, units, of, of);
}

FieldPlane field_plane(const VtkhdfFile& dump, const std::string& name, const RunUnits& units,
                       const SpacePlane& plane) {
  const ObliqueRaster raster(dump.grid, plane);
  return plane_from(
      dump, name, units, [&](const std::vector<double>& values) { return raster.of(values); },
      [&](const std::vector<double>& values) { return raster.linear(values); });
}

}  // namespace recoil
