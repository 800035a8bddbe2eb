#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/data_folder.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"
#include "material/library.hpp"

namespace recoil::app {

namespace {

/// A material of the library by its name. @throws InputError with the nearest names.
Material library_material(const std::string& name) {
  config::Diagnostics out;
  const auto material = find_material(name, nullptr, materials_folder(), out, {"command line"});
  if (material) return *material;
  const std::string near = did_you_mean(name, list_materials(materials_folder()));
  for (const auto& d : out.list())
    if (d.place.line > 0) throw InputError(out.text());  // the file exists, and is wrong
  throw InputError(fmt::format("there is no material '{}'\n   = help: {}", name,
                               near.empty() ? "`recoil material list` lists all" : near));
}

}  // namespace

int list_library() {
  const std::vector<std::string> names = list_materials(materials_folder());
  if (names.empty())
    throw EnvironmentError(
        fmt::format("there are no materials in {}\n   = help: set RECOIL_DATA to the folder that "
                    "holds materials/",
                    materials_folder().string()));
  std::size_t width = 0;
  for (const std::string& n : names) width = std::max(width, n.size());
  for (const std::string& n : names) {
    const Material m = library_material(n);
    fmt::print("{:{}}  {:6.0f} kg/m3  {}\n", n, width, density(m), m.title);
  }
  return 0;
}

int show_material(const std::string& name) {
  fmt::print("# {}\n{}", name, to_toml(library_material(name)));
  return 0;
}

}  // namespace recoil::app
