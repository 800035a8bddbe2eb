#include "app/run/standing.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/run/run_folder.hpp"
#include "core/error.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

Standing read_status(const fs::path& file) {
  std::ifstream in(file);
  const auto j = nlohmann::json::parse(in, nullptr, false);
  const auto number = [&](const char* key) {
    return j.contains(key) && j[key].is_number() ? j[key].get<double>() : 0.0;
  };
  if (!j.is_object() || !j.contains("state") || !j["state"].is_string())
    throw InputError(fmt::format("error: '{}' cannot be read", file.string()));
  return {j["state"].get<std::string>(),
          number("time_us"),
          number("end_us"),
          number("dt_ns"),
          number("wall_s"),
          number("left_s"),
          static_cast<long>(number("step"))};
}

}  // namespace

Standing standing_of(const fs::path& run) {
  const bool held = RunLock::is_held(run);
  const fs::path file = run / "status.json";
  if (!fs::exists(file) && !fs::exists(run / "case.resolved.toml"))
    throw InputError(
        fmt::format("error: {} holds no run: there is no status.json\n   = help: give the folder of a run, "
                    "runs/NAME",
                    run.string()));
  Standing s = fs::exists(file) ? read_status(file) : Standing{held ? "starting" : "interrupted"};
  if (s.state == "running" && !held) s.state = "interrupted";
  return s;
}

}  // namespace recoil::app
