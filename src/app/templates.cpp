#include "app/templates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include "app/commands.hpp"
#include "app/data_folder.hpp"
#include "config/schema.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"
#include "material/library.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* schema_name = "recoil-case-1.schema.json";

fs::path file_of(const std::string& name) { return templates_folder() / (name + ".toml"); }

/// The first line of comment, that says what it is.
std::string summary_of(const std::string& text) {
  const std::size_t begin = text.find("\n# ");
  if (begin == std::string::npos) return "";
  return text.substr(begin + 3, text.find('\n', begin + 1) - begin - 3);
}

int list_templates() {
  for (const std::string& name : template_names())
    fmt::print("{:14} {}\n", name, summary_of(text_of(file_of(name))));
  return 0;
}

/// With the schema, by which editors complete keys, in the case's own folder.
std::string with_schema_beside(const std::string& text) {
  const bool named = text.starts_with("#:schema ");
  return fmt::format("#:schema ./{}\n{}", schema_name, named ? text.substr(text.find('\n') + 1) : text);
}

/// The files that a template's case reads: those called as it is, but with other endings.
std::vector<fs::path> files_beside(const std::string& name) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(templates_folder()))
    if (entry.path().stem() == name && entry.path().extension() != ".toml") files.push_back(entry.path());
  return files;
}

}  // namespace

std::vector<std::string> template_names() { return list_materials(MaterialFolders{templates_folder()}); }

int new_case(const NewOptions& o) {
  if (o.list) return list_templates();
  const std::vector<std::string> names = template_names();
  if (names.empty())
    throw EnvironmentError(
        fmt::format("there are no templates in {}\n   = help: set RECOIL_DATA to the folder that "
                    "holds templates/",
                    templates_folder().string()));
  if (o.name.empty()) throw InputError("which template?\n   = help: `recoil new --list` shows them");
  if (std::ranges::find(names, o.name) == names.end()) {
    const std::string near = did_you_mean(o.name, names);
    throw InputError(fmt::format("there is no template '{}'\n   = help: {}", o.name,
                                 near.empty() ? "`recoil new --list` shows them" : near));
  }
  const fs::path folder = o.folder.empty() ? o.name : o.folder, file = folder / "case.toml";
  if (fs::exists(file))
    throw InputError(fmt::format("{} exists\n   = help: `recoil new {} DIR` chooses another folder",
                                 file.string(), o.name));
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw EnvironmentError(fmt::format("the folder {} cannot be made: {}", folder.string(), error.message()));
  write_atomically(file, with_schema_beside(text_of(file_of(o.name))));
  for (const fs::path& other : files_beside(o.name))
    if (!error) fs::copy_file(other, folder / other.filename(), fs::copy_options::overwrite_existing, error);
  if (error)
    throw EnvironmentError(fmt::format("{} cannot be written to: {}", folder.string(), error.message()));
  write_atomically(folder / schema_name, config::json_schema(material_sections()));
  fmt::print("{}\n  recoil check {}\n  recoil run {}\n", file.string(), folder.string(), folder.string());
  return 0;
}

}  // namespace recoil::app
