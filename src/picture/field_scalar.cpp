#include "picture/field_scalar.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "record/field_dump.hpp"

namespace recoil {

namespace {

/// Names of the six stored stresses, by the axes of the run.
std::vector<std::string> stored_stresses(const RunUnits& u) {
  if (u.axes.size() == 1) return u.stresses;
  if (u.axes.front() == "r") return {"rr", "zz", "tt", "rz"};
  if (u.axes.size() == 2) return {"xx", "yy", "zz", "xy"};
  return {"xx", "yy", "zz", "xy", "yz", "xz"};
}

/// Names of the components of a variable; none of a scalar.
std::vector<std::string> parts_of(const FieldVariable& v, const RunUnits& units) {
  if (v.components == 3) return units.axes;
  return v.components == 6 ? stored_stresses(units) : std::vector<std::string>{};
}

FieldScalar whole(const FieldVariable& v) { return {v.name, v.array, v.label, 0, v.signed_values}; }

FieldScalar part_of(const FieldVariable& v, const std::string& part, std::size_t component) {
  FieldScalar s{std::string(v.name) + "." + part, v.array, v.label, static_cast<int>(component), true};
  s.label.insert(s.label.find(" ["), " " + part);
  return s;
}

/// In 1-d a vector is its one component.
FieldScalar vector_of(const FieldVariable& v, const RunUnits& units) {
  FieldScalar s = whole(v);
  const bool one_axis = units.axes.size() == 1;
  s.component = one_axis ? 0 : FieldScalar::magnitude;
  s.signed_values = v.signed_values || one_axis;
  return s;
}

constexpr const char* phi_begin = "level_set_";
constexpr const char* phi_end = "_m";

/// "left + right": the bodies whose bits are set.
std::string names_of_bits(const std::vector<std::string>& bodies, unsigned bits) {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < bodies.size(); ++m)
    if ((bits >> m & 1U) != 0) names.push_back(bodies[m]);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, " + "));
}

}  // namespace

FieldScalar find_scalar(const std::string& name, const RunUnits& units) {
  if (name == "body" || name == "contact") return {name, name, name, 0, false};
  const std::size_t dot = name.find('.');
  const std::string base = name.substr(0, dot), part = dot == std::string::npos ? "" : name.substr(dot + 1);
  std::vector<std::string> known{"body", "contact"};
  for (const FieldVariable& v : field_variables()) {
    known.emplace_back(v.name);
    if (base != v.name) continue;
    const std::vector<std::string> parts = parts_of(v, units);
    if (part.empty() && v.components == 6)
      throw InputError(fmt::format("error: which component of '{}'?\n   = help: one of {}.{}", base, base,
                                   fmt::join(parts, ", " + base + ".")));
    if (part.empty()) return v.components == 3 ? vector_of(v, units) : whole(v);
    const auto at = std::find(parts.begin(), parts.end(), part);
    if (at == parts.end())
      throw InputError(fmt::format("error: the field '{}' has no component '{}'\n   = help: it has {}", base,
                                   part, parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "))));
    return part_of(v, part, static_cast<std::size_t>(at - parts.begin()));
  }
  throw InputError(fmt::format("error: there is no field '{}'\n   = help: the fields are {}", name,
                               fmt::join(known, ", ")));
}

std::vector<FieldScalar> scalars_of(const UnstructuredGrid& grid, const RunUnits& units) {
  std::vector<FieldScalar> all;
  for (const NamedArray& array : grid.cell_arrays)
    for (const FieldVariable& v : field_variables()) {
      if (array.name != v.array) continue;
      const std::vector<std::string> parts = parts_of(v, units);
      if (parts.empty()) all.push_back(whole(v));
      if (v.components == 3 && parts.size() == 1) {
        all.push_back(vector_of(v, units));
        continue;
      }
      for (std::size_t k = 0; k < parts.size(); ++k) all.push_back(part_of(v, parts[k], k));
    }
  for (const char* name : {"body", "contact"})
    if (std::ranges::any_of(grid.cell_arrays, [name](const NamedArray& a) { return a.name == name; }))
      all.push_back(find_scalar(name, units));
  return all;
}

std::vector<double> values_of(const UnstructuredGrid& grid, const FieldScalar& scalar) {
  const NamedArray& array = find_array(grid, scalar.array);
  const std::vector<double> all = as_doubles(array.values);
  const auto n = static_cast<std::size_t>(array.components);
  std::vector<double> one(all.size() / n);
  for (std::size_t k = 0; k < one.size(); ++k) {
    const double* v = all.data() + k * n;
    if (scalar.component != FieldScalar::magnitude) {
      one[k] = v[scalar.component];
      continue;
    }
    double sum = 0;
    for (std::size_t c = 0; c < n; ++c) sum += v[c] * v[c];
    one[k] = std::sqrt(sum);
  }
  return one;
}

std::vector<BodyField> bodies_of(const UnstructuredGrid& grid) {
  std::vector<BodyField> all;
  for (const NamedArray& array : grid.cell_arrays) {
    if (!array.name.starts_with(phi_begin) || !array.name.ends_with(phi_end)) continue;
    const std::size_t begin = std::string(phi_begin).size(), end = std::string(phi_end).size();
    all.push_back({array.name.substr(begin, array.name.size() - begin - end), as_doubles(array.values)});
  }
  return all;
}

std::vector<Category> categories_of(const std::string& name, const std::vector<std::string>& bodies,
                                    const std::set<double>& values) {
  constexpr Rgb grey{176, 184, 194};
  std::vector<Category> found;
  if (name == "body")
    for (std::size_t m = 0; m < bodies.size(); ++m)
      found.push_back({static_cast<double>(m), bodies[m], area_colour(m)});
  if (name == "contact-state")
    found = {{0, "free", grey},
             {1, "touching", {30, 140, 84}},
             {2, "slipping", {232, 146, 20}},
             {3, "opened", {212, 64, 52}}};
  if (name == "contact")
    for (const double v : values)
      found.push_back({v, names_of_bits(bodies, static_cast<unsigned>(v)),
                       v == 0 ? grey : area_colour(found.size() - (values.contains(0) ? 1 : 0))});
  constexpr std::size_t most_named = 24;  // of more a scale tells as much
  if (name == "fragment" && values.size() <= most_named)
    for (const double v : values)
      found.push_back(
          {v, fmt::format("{:.0f}", v), area_colour(static_cast<std::size_t>(std::max(v - 1, 0.0)))});
  return found;
}

}  // namespace recoil
