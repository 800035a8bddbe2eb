#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/data_folder.hpp"
#include "app/named_material.hpp"
#include "app/study/child_runs.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"
#include "material/library.hpp"
#include "material/lint.hpp"
#include "material/ls_dyna.hpp"
#include "material/tabulate.hpp"

namespace recoil::app {

namespace {

/// Of all folders. @throws EnvironmentError where there are none.
std::vector<std::string> all_names() {
  std::vector<std::string> names = list_materials(material_folders("."));
  if (names.empty())
    throw EnvironmentError(
        fmt::format("there are no materials in {}\n   = help: set RECOIL_DATA to the folder that "
                    "holds materials/",
                    materials_folder().string()));
  return names;
}

}  // namespace

Material named_material(const std::string& name) {
  constexpr const char* asked = "command line";
  config::Diagnostics out;
  const auto material = find_material(name, nullptr, material_folders("."), out, {asked});
  if (material) return *material;
  const std::string near = did_you_mean(name, list_materials(material_folders(".")));
  for (const auto& d : out.list())
    if (d.place.file != asked) throw InputError(out.text());  // the file exists, and is wrong
  throw InputError(fmt::format("there is no material '{}'\n   = help: {}", name,
                               near.empty() ? "`recoil material list` lists all" : near));
}

int list_library() {
  const std::vector<std::string> names = all_names();
  std::size_t width = 0;
  for (const std::string& n : names) width = std::max(width, n.size());
  for (const std::string& n : names) {
    const Material m = named_material(n);
    fmt::print("{:{}}  {:8.5g} kg/m3  {}\n", n, width, density(m), m.title);
  }
  return 0;
}

int show_material(const std::string& name) {
  fmt::print("# {}\n# {}\n{}", name, material_file(name, material_folders(".")).string(),
             to_toml(named_material(name)));
  return 0;
}

int lint_materials(const std::vector<std::string>& names) {
  int found = 0, certain = 0;
  const std::vector<std::string> list = names.empty() ? all_names() : names;
  for (const std::string& n : list) {
    for (const Suspicion& s : lint(named_material(n))) {
      fmt::print("{}: {}: {}: {}\n   = help: {}\n", n, s.certain ? "error" : "warning", s.key, s.message,
                 s.help);
      ++found;
      certain += s.certain ? 1 : 0;
    }
  }
  fmt::print("{} material{}, {}\n", list.size(), list.size() == 1 ? "" : "s",
             found == 0 ? std::string("nothing to remark") : fmt::format("{} to look at", found));
  return certain > 0 ? exit_bad_input : 0;
}

int tabulate_material(const TableOptions& o) {
  TableExtent extent;
  extent.densities = o.densities;
  extent.temperatures = o.temperatures;
  if (o.densities < 10 || o.temperatures < 3 || o.densities > 10000 || o.temperatures > 1000)
    throw InputError("a table has 10 to 10000 densities and 3 to 1000 temperatures");
  const Material m = named_material(o.name);
  if (std::holds_alternative<Porous>(m.eos))
    throw InputError(
        fmt::format("{}: porous matter has no table: its pressure depends on how far its pores "
                    "have been crushed\n   = help: tabulate its solid",
                    o.name));
  if (barotropic(m.eos) || is_fluid(m.eos))
    throw InputError(fmt::format("{}: only solids whose pressure depends on energy are tabulated", o.name));
  if (m.thermal.rule != Thermal::Rule::energy)
    throw InputError(
        fmt::format("{}: its temperature is that of plastic work alone\n   = help: take a material "
                    "with thermal.temperature = \"energy\"",
                    o.name));
  std::ofstream file(o.file);
  file << to_text(tabulate(m, extent), "made by `recoil material table` from " + o.name + ", cv constant");
  if (!file) throw EnvironmentError(fmt::format("cannot write {}", o.file));
  return 0;
}

int import_material(const ImportOptions& o) {
  const auto units = std::find_if(card_units().begin(), card_units().end(),
                                  [&](const CardUnits& u) { return o.units == u.name; });
  if (units == card_units().end())
    throw InputError(
        fmt::format("--units must be SI, g-mm-ms, g-cm-us, kg-mm-ms or t-mm-s, not {}", o.units));
  if (!std::filesystem::exists(o.file) || std::filesystem::is_directory(o.file))
    throw InputError(fmt::format("there is no file {}\n   = help: give an LS-DYNA keyword file", o.file));
  ImportedMaterial found = import_cards(text_of(o.file), *units, o.file);
  const std::string name = std::filesystem::path(o.file).filename().string();
  std::string& title = found.material.title;
  title = title.empty() ? "imported from " + name : title + ", imported from " + name;
  std::string text;
  for (const std::string& part : found.left_out) text += fmt::format("# not taken over: {}\n", part);
  text += to_toml(found.material);
  if (o.out.empty()) {
    fmt::print("{}", text);
    return 0;
  }
  if (std::filesystem::exists(o.out))
    throw InputError(fmt::format("{} exists\n   = help: give another name, or remove it first", o.out));
  make_folder(std::filesystem::absolute(o.out).parent_path());
  write_atomically(o.out, text);
  fmt::print("{}\n", o.out);
  for (const std::string& part : found.left_out) fmt::print("not taken over: {}\n", part);
  return 0;
}

}  // namespace recoil::app
