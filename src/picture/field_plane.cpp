#include "picture/field_plane.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <system_error>

#include "core/error.hpp"
#include "picture/raster.hpp"
#include "record/field_dump.hpp"

namespace recoil {

namespace {

/// Names of the six stored stresses, by the axes of the run.
std::vector<std::string> stored_stresses(const RunUnits& u) {
  if (u.axes.front() == "r") return {"rr", "zz", "tt", "rz"};
  return {"xx", "yy", "zz", "xy", "yz", "xz"};
}

/// What a name means: an array, and one of its components or (-1) its magnitude.
struct Wanted {
  std::string array, label;
  int component = 0;
  bool signed_values = false;
};

Wanted find_wanted(const std::string& name, const RunUnits& units) {
  if (name == "body" || name == "contact") return {name, name, 0, false};
  const std::size_t dot = name.find('.');
  const std::string base = name.substr(0, dot), part = dot == std::string::npos ? "" : name.substr(dot + 1);
  std::vector<std::string> known{"body", "contact"};
  for (const FieldVariable& v : field_variables()) {
    known.emplace_back(v.name);
    if (base != v.name) continue;
    Wanted w{v.array, v.label, 0, v.signed_values};
    if (part.empty() && v.components == 6)
      throw InputError(fmt::format("error: which component of '{}'?\n   = help: one of {}.{}", base, base,
                                   fmt::join(stored_stresses(units), ", " + base + ".")));
    if (part.empty()) {
      const bool vector = v.components == 3, one_axis = units.axes.size() == 1;
      w.component = vector && !one_axis ? -1 : 0;
      w.signed_values = v.signed_values || (vector && one_axis);
      return w;
    }
    const auto parts = v.components == 3   ? units.axes
                       : v.components == 6 ? stored_stresses(units)
                                           : std::vector<std::string>{};
    const auto at = std::find(parts.begin(), parts.end(), part);
    if (at == parts.end())
      throw InputError(fmt::format("error: the field '{}' has no component '{}'\n   = help: it has {}", base,
                                   part, parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "))));
    w.component = static_cast<int>(at - parts.begin());
    w.label.insert(w.label.find(" ["), " " + part);
    w.signed_values = true;
    return w;
  }
  throw InputError(fmt::format("error: there is no field '{}'\n   = help: the fields are {}", name,
                               fmt::join(known, ", ")));
}

std::vector<double> component_of(const NamedArray& array, int component) {
  const std::vector<double> all = as_doubles(array.values);
  const auto n = static_cast<std::size_t>(array.components);
  std::vector<double> one(all.size() / n);
  for (std::size_t k = 0; k < one.size(); ++k) {
    const double* v = all.data() + k * n;
    if (component >= 0) {
      one[k] = v[component];
      continue;
    }
    double sum = 0;
    for (std::size_t c = 0; c < n; ++c) sum += v[c] * v[c];
    one[k] = std::sqrt(sum);
  }
  return one;
}

constexpr const char* phi_begin = "level_set_";
constexpr const char* phi_end = "_m";

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

/// "left + right": the bodies whose bits are set.
std::string names_of_bits(const std::vector<std::string>& bodies, unsigned bits) {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < bodies.size(); ++m)
    if ((bits >> m & 1U) != 0) names.push_back(bodies[m]);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, " + "));
}

/// What the values of a field mean that has only a few; none of other fields.
std::vector<Category> categories_of(const std::string& name, const FieldPlane& plane) {
  constexpr Rgb grey{176, 184, 194};
  std::vector<Category> found;
  if (name == "body")
    for (std::size_t m = 0; m < plane.bodies.size(); ++m)
      found.push_back({static_cast<double>(m), plane.bodies[m], area_colour(m)});
  if (name == "contact-state")
    found = {{0, "free", grey},
             {1, "touching", {30, 140, 84}},
             {2, "slipping", {232, 146, 20}},
             {3, "opened", {212, 64, 52}}};
  if (name == "contact") {
    std::set<double> values;
    for (const double v : plane.values.values)
      if (!std::isnan(v)) values.insert(v);
    for (const double v : values)
      found.push_back({v, names_of_bits(plane.bodies, static_cast<unsigned>(v)),
                       v == 0 ? grey : area_colour(found.size() - (values.contains(0) ? 1 : 0))});
  }
  return found;
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

FieldPlane field_plane(const VtkhdfFile& dump, const std::string& name, const RunUnits& units, double z) {
  const Wanted wanted = find_wanted(name, units);
  FieldPlane plane;
  plane.label = wanted.label;
  plane.signed_values = wanted.signed_values;
  plane.time_s = dump.time_s;
  plane.values = rasterise(dump.grid, component_of(find_array(dump.grid, wanted.array), wanted.component), z);
  std::vector<bool> solid;
  for (const NamedArray& array : dump.grid.cell_arrays) {
    if (!array.name.starts_with(phi_begin) || !array.name.ends_with(phi_end)) continue;
    const std::size_t begin = std::string(phi_begin).size();
    plane.bodies.push_back(array.name.substr(begin, array.name.size() - begin - std::string(phi_end).size()));
    const std::vector<double> phi = component_of(array, 0);
    solid.push_back(holds_matter(dump.grid, phi));
    plane.level_sets.push_back(rasterise(dump.grid, phi, z));
  }
  if (name == "body")
    for (double& v : plane.values.values)
      if (v < 0) v = std::numeric_limits<double>::quiet_NaN();
  plane.categories = categories_of(name, plane);
  if (name == "contact-state") plane.label = "contact";
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
