#include "app/load_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include <system_error>
#include <utility>
#include <variant>

#include "app/data_folder.hpp"
#include "config/kept_files.hpp"
#include "config/read_case.hpp"
#include "config/section/expect.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"
#include "material/library.hpp"
#include "record/recorder.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> shipped_cases() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_folder() / "cases", error))
    if (fs::exists(entry.path() / "case.toml")) names.push_back(entry.path().filename().string());
  return names;
}

/// Names of files in a folder that may be cases.
std::vector<std::string> case_files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

/// expected.toml belongs to the case as it stands there: [expect] of the case itself comes first.
void add_expected_file(LoadedCase& loaded) {
  const fs::path file = loaded.folder / "expected.toml";
  if (!fs::exists(file)) return;
  const config::Document document = config::read_document(file.string(), loaded.found);
  if (!document.complete) return;
  const auto more = config::read_expectations(document, loaded.found);
  auto& all = loaded.contents.expect;
  config::check_expected_names(more, loaded.contents.bodies, loaded.contents.gauges, loaded.found);
  all.insert(all.end(), more.begin(), more.end());
}

/// A run keeps a copy of the table of a material, as of the files that its case names.
void add_table(LoadedCase& loaded, const Material& material, const config::Place& place) {
  const auto* table = tabular(material.eos);
  if (!table) return;
  const std::string problem = config::keep_file(loaded.contents.files, table->path);
  if (!problem.empty()) loaded.found.error(place, problem, config::rename_one);
}

}  // namespace

fs::path find_case_file(const std::string& word) {
  if (fs::is_directory(word)) {
    if (fs::exists(fs::path(word) / "case.toml")) return fs::path(word) / "case.toml";
    const std::vector<std::string> files = case_files_in(word);
    throw InputError(fmt::format(
        "the folder {} has no case.toml\n   = help: {}", word,
        files.empty() ? std::string("`recoil new --list` shows cases to start from")
                      : fmt::format("give the case file itself; there are: {}", fmt::join(files, ", "))));
  }
  if (fs::exists(word)) return word;
  const fs::path shipped = data_folder() / "cases" / word / "case.toml";
  const bool is_name = word.find('/') == std::string::npos;
  if (is_name && fs::exists(shipped)) return shipped;
  std::string near = fs::exists(word + ".toml") ? fmt::format("did you mean '{}.toml'?", word) : "";
  if (near.empty())
    near = did_you_mean(fs::path(word).filename().string(), case_files_in(fs::path(word).parent_path()));
  if (near.empty() && is_name) near = did_you_mean(word, shipped_cases());
  throw InputError(
      fmt::format("there is no case file '{}'\n   = help: {}", word,
                  near.empty() ? "give a .toml file, a folder that holds case.toml, or the name of one in " +
                                     (data_folder() / "cases").string()
                               : near));
}

std::string short_name(const fs::path& case_file) {
  if (case_file.filename() != "case.toml") return case_file.stem().string();
  return fs::absolute(case_file).lexically_normal().parent_path().filename().string();
}

std::string title_of(const config::Case& c) { return c.title.empty() ? case_name(c) : c.title; }

LoadedCase load_case(const std::string& word, const std::vector<std::string>& overrides,
                     const fs::path& home) {
  LoadedCase loaded;
  const fs::path file = find_case_file(word);
  loaded.overrides = overrides;
  loaded.folder = (home.empty() ? file : home).parent_path();
  loaded.contents = config::read_case(file.string(), loaded.document, loaded.found, overrides);
  if (!home.empty()) loaded.contents.file = home.string();
  add_expected_file(loaded);
  const fs::path beside = loaded.folder.empty() ? fs::path(".") : loaded.folder;
  for (const config::Body& body : loaded.contents.bodies) {
    Material none;
    if (!body.rigid && !body.material.empty()) {
      auto material = find_material(body.material, &loaded.document, material_folders(beside), loaded.found,
                                    body.material_place);
      if (material) add_table(loaded, *material, body.material_place);
      if (material) none = std::move(*material);
    }
    loaded.materials.push_back(std::move(none));
  }
  return loaded;
}

void require_folder(const fs::path& folder) {
  if (fs::is_directory(folder)) return;
  const fs::path whole = folder.has_filename() ? folder : folder.parent_path();
  std::vector<std::string> beside;
  std::error_code error;
  for (const auto& entry :
       fs::directory_iterator(whole.has_parent_path() ? whole.parent_path() : fs::path("."), error))
    if (entry.is_directory()) beside.push_back(entry.path().filename().string());
  const std::string near = did_you_mean(whole.filename().string(), beside);
  throw InputError(
      fmt::format("there is no folder {}\n   = help: {}", folder.string(),
                  near.empty() ? "give the folder of a run; `recoil run` names it in its last lines" : near));
}

LoadedCase load_run(const fs::path& folder) {
  const fs::path resolved = folder / "case.resolved.toml";
  if (!fs::exists(resolved))
    throw InputError(
        fmt::format("{} is not the folder of a run\n   = help: a run leaves case.resolved.toml there; the "
                    "usual folder is runs/NAME",
                    folder.string()));
  LoadedCase loaded = load_case(resolved.string(), {});
  loaded.found.throw_if_errors();
  return loaded;
}

}  // namespace recoil::app
