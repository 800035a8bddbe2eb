#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/load_case.hpp"
#include "app/plot/plot_file.hpp"
#include "app/run/reporter.hpp"
#include "app/run/run_quantities.hpp"
#include "app/run/stop_request.hpp"
#include "app/study/child_runs.hpp"
#include "app/study/study_charts.hpp"
#include "app/study/study_table.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "core/nothing.hpp"
#include "format/json_files.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

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
    StudyValue v{value_of(run, a.quantity), nothing, nothing, unit_of(run.found, a.quantity)};
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

/// Runs the case on it.
ChildResult run_on(const ChildRun& run) {
  tell(fmt::format("{} ...", run.folder.filename().string()));
  ChildResult result = run_or_reuse(run);
  const bool stopped = result.exit == exit_stopped;
  tell(!result.begun()          ? " not begun\n"
       : result.reused          ? " finished before\n"
       : result.problem.empty() ? " done\n"
       : stopped                ? " stopped\n"
                                : " FAILED with " + result.problem + "\n");
  return result;
}

/// The values of an option, each once. @throws InputError.
void check_values(const std::vector<std::string>& texts, const char* unit, const char* option) {
  std::vector<double> values;
  for (const std::string& text : texts) {
    const double value = quantity_option(text, unit, option);
    if (std::ranges::find(values, value) != values.end())
      throw InputError(fmt::format("{} names {} twice\n   = help: take one of them out", option, text));
    values.push_back(value);
  }
}

/// The case on a mesh. @throws InputError, EnvironmentError where it cannot be run on it.
ChildRun run_of(const Mesh& mesh, const StudyOptions& o, const fs::path& folder) {
  std::vector<std::string> changes{"mesh.finest=" + mesh.size};
  if (!mesh.offset.empty()) changes.push_back("mesh.offset=" + mesh.offset);
  changes.insert(changes.end(), o.overrides.begin(), o.overrides.end());
  ChildRun run = checked_run(find_case_file(o.file), changes, folder / mesh.name());
  run.threads = 0;  // one after the other: each has all processors
  return run;
}

std::vector<Mesh> meshes_of(const StudyOptions& o) {
  std::vector<Mesh> meshes;
  check_values(o.sizes, "m", "--mesh");
  check_values(o.offsets, "1", "--offset");
  for (const std::string& size : o.sizes)
    for (const std::string& offset : o.offsets.empty() ? std::vector<std::string>{""} : o.offsets)
      meshes.push_back({size, offset});
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
  check_named(o.quantities, loaded, "--quantity");
  if (asked.empty() && loaded.contents.gauges.empty())
    throw InputError(
        "there is nothing to tabulate: the case has no gauge and expects no number\n   = help: name results, "
        "e.g. "
        "--quantity body.NAME.velocity.x, or write an [expect]");
}

/// The table of the runs that are done. @returns 0, or the exit code of the last that has no results.
int tabulate(const LoadedCase& loaded, std::vector<Asked> asked, const fs::path& folder,
             const std::vector<Mesh>& meshes, const std::vector<ChildResult>& results) {
  StudyTable table{title_of(loaded.contents), {}, {}};
  int worst = exit_finished;
  std::vector<StudyMesh> drawn;  // with the first of the shifts
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const Mesh& mesh = meshes[k];
    StudyRun run{quantity_option(mesh.size, "m", "--mesh"),
                 mesh.offset.empty() ? 0 : quantity_option(mesh.offset, "1", "--offset"),
                 {}};
    if (results[k].problem.empty()) {
      const RunQuantities found = read_quantities(folder / mesh.name(), loaded.folder);
      if (asked.empty())
        for (const std::string& peak : peaks_of_gauges(found)) asked.push_back({peak, {}});
      run.values = values_in(found, asked);
      if (drawn.empty() || drawn.back().size != mesh.size) drawn.push_back({mesh.size, folder / mesh.name()});
    } else {
      worst = results[k].exit;
    }
    table.runs.push_back(std::move(run));
  }
  for (const Asked& a : asked) table.quantities.push_back(a.quantity);
  fill_gaps(table);
  const std::string text = study_markdown(table);
  write_atomically(folder / "study.md", text);
  write_atomically(folder / "study.csv", study_csv(table));
  tell(fmt::format("\n{}\n{}\n", text, (folder / "study.md").string()));
  for (const fs::path& png : write_study_charts(folder, table, drawn, loaded.folder))
    tell(png.string() + "\n");
  return worst;
}

}  // namespace

int study(const StudyOptions& o) {
  const LoadedCase loaded = load_case(o.file, o.overrides);
  loaded.found.throw_if_errors();
  const std::vector<Asked> asked = asked_of(o, loaded.contents);
  check_case(o, loaded, asked);
  const std::vector<Mesh> meshes = meshes_of(o);
  const fs::path folder = o.folder.empty()
                              ? fs::path("runs") / (short_name(find_case_file(o.file)) + "_study")
                              : fs::path(o.folder);
  std::vector<ChildRun> runs;  // all mistakes before the first of them
  for (const Mesh& mesh : meshes) runs.push_back(run_of(mesh, o, folder));
  make_folder(folder);
  watch_stop_signals();
  std::vector<ChildResult> results(runs.size());
  for (std::size_t k = 0; k < runs.size() && !stop_requested(); ++k) results[k] = run_on(runs[k]);
  if (cut_short(results)) {
    std::fputs(told_stopped(results, "the same command goes on").c_str(), stderr);
    return exit_stopped;
  }
  return tabulate(loaded, asked, folder, meshes, results);
}

}  // namespace recoil::app
