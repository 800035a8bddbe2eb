#include "app/run/checkpoint_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <system_error>

#include "config/declare/write.hpp"
#include "config/read_case.hpp"
#include "core/build_info.hpp"
#include "core/error.hpp"
#include "material/library.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& run) { return run / "checkpoints"; }

bool may_change(const std::string& key) {
  const auto below = [&](const char* table) { return key.starts_with(std::string(table) + '.'); };
  return key == "time.end" || key == "title" || key == "cite" || below("output") || below("gauge") ||
         below("expect");
}

}  // namespace

CheckpointText describe(const LoadedCase& loaded, const std::vector<std::string>& overrides) {
  CheckpointText text;
  text.version = build_info::full_version;
  text.case_file = fs::absolute(loaded.contents.file).lexically_normal().string();
  text.overrides = overrides;
  for (const config::WrittenTable& table : config::written_tables(loaded.contents))
    for (const config::WrittenKey& key : table.keys)
      text.keys[table.path.empty() ? key.name : table.path + '.' + key.name] = key.value;
  for (std::size_t m = 0; m < loaded.materials.size(); ++m)
    if (!loaded.contents.bodies[m].rigid)
      text.keys["material of " + loaded.contents.bodies[m].name] = to_toml(loaded.materials[m], "material");
  return text;
}

std::string to_json(const CheckpointText& text) {
  const nlohmann::json j{{"version", text.version},
                         {"case", text.case_file},
                         {"overrides", text.overrides},
                         {"keys", text.keys},
                         {"time", text.time}};
  return j.dump(1);
}

CheckpointText checkpoint_text(const std::string& json) {
  try {
    const auto j = nlohmann::json::parse(json);
    return {j.at("version").get<std::string>(), j.at("case").get<std::string>(),
            j.at("overrides").get<std::vector<std::string>>(),
            j.at("keys").get<std::map<std::string, std::string>>(), j.at("time").get<double>()};
  } catch (const nlohmann::json::exception&) {
    throw InputError("error: the checkpoint does not say of which case it is: it is of another version");
  }
}

fs::path checkpoint_file(const fs::path& run, long step) {
  return folder_of(run) / fmt::format("{:09}.h5", step);
}

std::vector<fs::path> checkpoints_of(const fs::path& run) {
  std::vector<fs::path> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder_of(run), none))
    if (entry.path().extension() == ".h5" && !entry.path().filename().string().starts_with("."))
      found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

void remove_old_checkpoints(const fs::path& run, int keep) {
  const std::vector<fs::path> all = checkpoints_of(run);
  std::error_code ignored;
  for (std::size_t k = 0; k + static_cast<std::size_t>(keep) < all.size(); ++k) fs::remove(all[k], ignored);
  std::vector<fs::path> torn;
  for (const auto& entry : fs::directory_iterator(folder_of(run), ignored))
    if (entry.path().extension() == ".tmp") torn.push_back(entry.path());
  for (const fs::path& file : torn) fs::remove(file, ignored);
}

std::vector<std::string> changed_keys(const CheckpointText& then, const CheckpointText& now) {
  std::vector<std::string> changed;
  for (const auto& [key, value] : then.keys) {
    const auto found = now.keys.find(key);
    if (!may_change(key) && (found == now.keys.end() || found->second != value)) changed.push_back(key);
  }
  for (const auto& [key, value] : now.keys)
    if (!may_change(key) && !then.keys.contains(key)) changed.push_back(key);
  return changed;
}

std::string refusal(const CheckpointText& then, const CheckpointText& now) {
  const std::vector<std::string> changed = changed_keys(then, now);
  if (changed.empty()) return "";
  const std::string help =
      then.version == now.version
          ? "time.end, output, gauges and expectations may change; for the rest start a new run"
          : fmt::format(
                "the checkpoint is of recoil {}, this is {}, which may have other keys or defaults: go on "
                "with "
                "that one, or start a new run",
                then.version, now.version);
  return fmt::format("error: a run cannot go on with other values of {}\n   = help: {}",
                     fmt::join(changed, ", "), help);
}

}  // namespace recoil::app
