#include "app/plot/written_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "picture/field_scalar.hpp"

namespace recoil::app {

namespace {

std::string without_component(const std::string& name) { return name.substr(0, name.find('.')); }

/// As [output.fields] writes them.
std::vector<std::string> written_fields(const UnstructuredGrid& grid, const RunUnits& units) {
  std::vector<std::string> names;
  for (const FieldScalar& s : scalars_of(grid, units))
    if (const std::string name = without_component(s.name); std::ranges::find(names, name) == names.end())
      names.push_back(name);
  return names;
}

}  // namespace

VtkhdfFile read_with_field(const std::filesystem::path& file, const std::string& field,
                           const RunUnits& units) {
  VtkhdfFile dump = read_vtkhdf(file);
  const FieldScalar scalar = find_scalar(field, units);
  const auto holds = [&](const NamedArray& a) { return a.name == scalar.array; };
  if (std::ranges::any_of(dump.grid.cell_arrays, holds)) return dump;
  throw InputError(fmt::format(
      "error: this run did not write the field '{}'\n   = help: it has {}; add it to `variables` in "
      "[output.fields] and run the case again",
      without_component(field), fmt::join(written_fields(dump.grid, units), ", ")));
}

}  // namespace recoil::app
