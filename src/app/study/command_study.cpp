#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/launch.hpp"
#include "app/load_case.hpp"
#include "app/study/study_charts.hpp"
#include "app/study/study_table.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double quantity(const std::string& text, const char* unit, const char* option) {
  const config::Quantity q = config::parse_quantity(text, unit, option);
  if (!q.ok()) throw InputError(fmt::format("{}\n   = help: {}", q.problem, q.help));
  return q.value;
}

/// What the case expects in numbers; truths are not tabulated.
std::vector<config::Expectation> numbers_of(const config::Case& c) {
  std::vector<config::Expectation> all;
  for (const config::Expectation& e : c.expect)
    if (!e.is_flag) all.push_back(e);
  return all;
}

/// A value of summary.json, which has it in the unit of its expectation.
double in_si(double value, const std::string& unit) {
  return unit.empty() ? value
                      : config::parse_any_quantity(fmt::format("{:.17g} {}", value, unit), unit).value;
}

/// The values of the expectations in a run's summary.json, NaN where there is none.
std::vector<StudyValue> values_in(const fs::path& summary, const std::vector<config::Expectation>& expected) {
  std::ifstream file(summary);
  const nlohmann::json all = nlohmann::json::parse(file, nullptr, false);
  std::vector<StudyValue> values;
  for (const config::Expectation& e : expected) {
    const bool one_sided = e.at_most || e.at_least;
    StudyValue v{nothing, one_sided ? nothing : e.value, one_sided ? e.value : nothing, e.unit};
    if (!all.is_discarded() && all.contains("expect") && all["expect"].contains(e.quantity)) {
      const auto& value = all["expect"][e.quantity]["value"];
      if (value.is_number()) v.value = in_si(value.get<double>(), e.unit);
    }
    values.push_back(v);
  }
  return values;
}

}  // namespace

int study(const StudyOptions& o) {
  const LoadedCase loaded = load_case(o.file, o.overrides);
  loaded.found.throw_if_errors();
  const fs::path folder = o.folder.empty()
                              ? fs::path("runs") / (short_name(find_case_file(o.file)) + "_study")
                              : fs::path(o.folder);
  const std::vector<std::string> offsets = o.offsets.empty() ? std::vector<std::string>{""} : o.offsets;
  const std::vector<config::Expectation> expected = numbers_of(loaded.contents);
  StudyTable table{loaded.contents.title, {}, {}};
  for (const config::Expectation& e : expected) table.quantities.push_back(e.quantity);
  for (const std::string& s : o.sizes) quantity(s, "m", "--mesh");  // all mistakes before the first run
  for (const std::string& s : o.offsets) quantity(s, "1", "--offset");
  fs::create_directories(folder);
  int worst = exit_finished;
  std::vector<StudyMesh> meshes;  // with the first of the shifts
  for (const std::string& size : o.sizes)
    for (const std::string& offset : offsets) {
      const std::string name = "mesh_" + size + (offset.empty() ? "" : "_offset_" + offset);
      std::vector<std::string> words{"run",     find_case_file(o.file).string(),
                                     "-o",      (folder / name).string(),
                                     "--force", "--plain",
                                     "--set",   "mesh.finest=" + size};
      if (!offset.empty()) words.insert(words.end(), {"--set", "mesh.offset=" + offset});
      for (const std::string& change : o.overrides) words.insert(words.end(), {"--set", change});
      const fs::path log = folder / (name + ".log");
      fmt::print("{} ...", name);
      std::fflush(stdout);
      const int code = run_child(words, log);
      const bool done = has_results(code);
      fmt::print(" {}\n",
                 done ? "done" : fmt::format("FAILED with exit code {}, see {}", code, log.string()));
      if (!done) worst = code;
      if (done && (meshes.empty() || meshes.back().size != size)) meshes.push_back({size, folder / name});
      table.runs.push_back({quantity(size, "m", "--mesh"),
                            offset.empty() ? 0 : quantity(offset, "1", "--offset"),
                            values_in(done ? folder / name / "summary.json" : fs::path(), expected)});
    }
  const std::string text = study_markdown(table);
  write_atomically(folder / "study.md", text);
  write_atomically(folder / "study.csv", study_csv(table));
  fmt::print("\n{}\n{}\n", text, (folder / "study.md").string());
  for (const fs::path& png : write_study_charts(folder, table, meshes, loaded.folder))
    fmt::print("{}\n", png.string());
  return worst;
}

}  // namespace recoil::app
