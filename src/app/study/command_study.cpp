#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/launch.hpp"
#include "app/load_case.hpp"
#include "app/run/run_quantities.hpp"
#include "app/study/child_runs.hpp"
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

/// A quantity to tabulate, and what the case expects of it.
struct Asked {
  std::string quantity;
  std::optional<config::Expectation> expected;
};

/// Those that were asked for, else what the case expects in numbers; truths are not tabulated.
std::vector<Asked> asked_of(const StudyOptions& o, const config::Case& c) {
  std::vector<Asked> all;
  for (const std::string& q : o.quantities) {
    const auto same = [&](const config::Expectation& e) { return !e.is_flag && e.quantity == q; };
    const auto e = std::ranges::find_if(c.expect, same);
    all.push_back({q, e == c.expect.end() ? std::nullopt : std::optional(*e)});
  }
  for (const config::Expectation& e : c.expect)
    if (o.quantities.empty() && !e.is_flag) all.push_back({e.quantity, e});
  return all;
}

/// The values in a run: in SI, with the unit of the expectation or else that of the run's files.
std::vector<StudyValue> values_in(const RunQuantities& run, const std::vector<Asked>& asked) {
  std::vector<StudyValue> values;
  for (const Asked& a : asked) {
    StudyValue v{value_of(run, a.quantity), nothing, nothing, unit_of(run, a.quantity)};
    if (v.unit == "1") v.unit.clear();
    if (const auto& e = a.expected) {
      const bool one_sided = e->at_most || e->at_least;
      (one_sided ? v.limit : v.reference) = e->value;
      v.unit = e->unit;
    }
    values.push_back(v);
  }
  return values;
}

/// One mesh of the study.
struct Mesh {
  std::string size, offset;  // as written
  std::string name() const { return "mesh_" + size + (offset.empty() ? "" : "_offset_" + offset); }
};

/// Runs the case on it. @returns the exit code.
int run_on(const Mesh& mesh, const StudyOptions& o, const fs::path& folder) {
  std::vector<std::string> words{
      "run",   find_case_file(o.file).string(), "-o", (folder / mesh.name()).string(), "--force", "--plain",
      "--set", "mesh.finest=" + mesh.size};
  if (!mesh.offset.empty()) words.insert(words.end(), {"--set", "mesh.offset=" + mesh.offset});
  for (const std::string& change : o.overrides) words.insert(words.end(), {"--set", change});
  const fs::path log = folder / (mesh.name() + ".log");
  fmt::print("{} ...", mesh.name());
  std::fflush(stdout);
  const int code = run_child(words, log);
  fmt::print(" {}\n", has_results(code) ? "done" : "FAILED with " + why_no_results(code, log));
  return code;
}

/// The values of an option, each once. @throws InputError.
void check_values(const std::vector<std::string>& texts, const char* unit, const char* option) {
  std::vector<double> values;
  for (const std::string& text : texts) {
    const double value = quantity(text, unit, option);
    if (std::ranges::find(values, value) != values.end())
      throw InputError(fmt::format("{} names {} twice\n   = help: take one of them out", option, text));
    values.push_back(value);
  }
}

/// The case as it is read on a mesh. @throws InputError, EnvironmentError where it cannot be run on it.
void check_mesh(const Mesh& mesh, const StudyOptions& o) {
  std::vector<std::string> changes{"mesh.finest=" + mesh.size};
  if (!mesh.offset.empty()) changes.push_back("mesh.offset=" + mesh.offset);
  changes.insert(changes.end(), o.overrides.begin(), o.overrides.end());
  LoadedCase loaded = load_case(o.file, changes);
  if (!loaded.found.has_errors()) check_logic(loaded);
  if (loaded.too_large) throw EnvironmentError(loaded.found.text());
  loaded.found.throw_if_errors();
}

/// All mistakes before the first run.
std::vector<Mesh> meshes_of(const StudyOptions& o) {
  std::vector<Mesh> meshes;
  check_values(o.sizes, "m", "--mesh");
  check_values(o.offsets, "1", "--offset");
  for (const std::string& size : o.sizes)
    for (const std::string& offset : o.offsets.empty() ? std::vector<std::string>{""} : o.offsets)
      meshes.push_back({size, offset});
  for (const Mesh& mesh : meshes) check_mesh(mesh, o);
  return meshes;
}

/// Runs without results have no value of any quantity, but its unit and reference.
void fill_gaps(StudyTable& table) {
  std::vector<StudyValue> none(table.quantities.size(), StudyValue{nothing, nothing, nothing, ""});
  for (const StudyRun& run : table.runs)
    if (!run.values.empty()) none = run.values;
  for (StudyValue& v : none) v.value = nothing;
  for (StudyRun& run : table.runs)
    if (run.values.empty()) run.values = none;
}

/// Names in --quantity of gauges, bodies and pairs that the case does not have.
void check_case(const StudyOptions& o, const LoadedCase& loaded, const std::vector<Asked>& asked) {
  check_named(o.quantities, loaded.contents, "--quantity");
  if (asked.empty() && loaded.contents.gauges.empty())
    throw InputError(
        "there is nothing to tabulate: the case has no gauge and expects no number\n   = help: name results, "
        "e.g. "
        "--quantity body.NAME.velocity.x, or write an [expect]");
}

}  // namespace

int study(const StudyOptions& o) {
  const LoadedCase loaded = load_case(o.file, o.overrides);
  loaded.found.throw_if_errors();
  std::vector<Asked> asked = asked_of(o, loaded.contents);
  check_case(o, loaded, asked);
  const std::vector<Mesh> wanted = meshes_of(o);
  const fs::path folder = o.folder.empty()
                              ? fs::path("runs") / (short_name(find_case_file(o.file)) + "_study")
                              : fs::path(o.folder);
  make_folder(folder);
  StudyTable table{loaded.contents.title, {}, {}};
  int worst = exit_finished;
  std::vector<StudyMesh> meshes;  // with the first of the shifts
  for (const Mesh& mesh : wanted) {
    const int code = run_on(mesh, o, folder);
    StudyRun run{quantity(mesh.size, "m", "--mesh"),
                 mesh.offset.empty() ? 0 : quantity(mesh.offset, "1", "--offset"),
                 {}};
    if (has_results(code)) {
      const RunQuantities found = read_quantities(folder / mesh.name(), loaded.folder);
      if (asked.empty())
        for (const std::string& peak : peaks_of_gauges(found)) asked.push_back({peak, {}});
      run.values = values_in(found, asked);
      if (meshes.empty() || meshes.back().size != mesh.size)
        meshes.push_back({mesh.size, folder / mesh.name()});
    } else {
      worst = code;
    }
    table.runs.push_back(std::move(run));
  }
  for (const Asked& a : asked) table.quantities.push_back(a.quantity);
  fill_gaps(table);
  const std::string text = study_markdown(table);
  write_atomically(folder / "study.md", text);
  write_atomically(folder / "study.csv", study_csv(table));
  fmt::print("\n{}\n{}\n", text, (folder / "study.md").string());
  for (const fs::path& png : write_study_charts(folder, table, meshes, loaded.folder))
    fmt::print("{}\n", png.string());
  return worst;
}

}  // namespace recoil::app
