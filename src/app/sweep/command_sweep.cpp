#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/check/count_text.hpp"
#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/load_case.hpp"
#include "app/run/reporter.hpp"
#include "app/run/stop_request.hpp"
#include "app/sweep/sweep_runs.hpp"
#include "config/diagnostics.hpp"
#include "config/units.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"
#include "record/findings.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_runs = 10000;
constexpr double usual_tolerance = 0.01;  // of the range

/// Everything of the command line, read and checked.
struct Sweep {
  fs::path case_file, folder;
  std::string title;
  std::vector<SweptKey> keys;
  SweepQuestion question;
  std::size_t along = 0;  // the key that a threshold is searched along
  double within = 0;      // in the unit of that key
  int jobs = 0;
  bool searches() const { return !question.condition.quantity.empty(); }
};

double tolerance(const std::string& text, const SweptKey& key) {
  const double range = std::abs(key.numbers.back() - key.numbers.front());
  if (text.empty()) return usual_tolerance * range;
  const config::Quantity q = config::parse_any_quantity(text, "--within");
  const std::string unit = key.unit.empty() ? "a plain number" : key.unit;
  if (!q.ok())
    throw InputError(
        fmt::format("{}\n   = help: {}", q.problem, q.help.empty() ? "give it in " + unit : q.help));
  if (config::dimension_name(q.unit) != config::dimension_name(key.unit))
    throw InputError(fmt::format("--within '{}' is not of the dimension of {}\n   = help: give it in {}",
                                 text, key.key, unit));
  const double size =
      key.unit.empty() ? q.value : q.written * config::unit_size(q.unit) / config::unit_size(key.unit);
  if (!(size > 0) || size < 1e-8 * range)
    throw InputError(
        fmt::format("--within {} is too small for the range\n   = help: it is the half width of the last "
                    "interval; {} of the range is usual",
                    text, usual_tolerance));
  return size;
}

/// The one key with a range.
std::size_t key_to_search(const std::vector<SweptKey>& keys) {
  const auto n = std::ranges::count_if(keys, [](const SweptKey& k) { return k.is_range; });
  if (n != 1)
    throw InputError(
        fmt::format("--find searches along one key, but {}\n   = help: --set KEY=FROM:TO, e.g. "
                    "body.flyer.velocity.x=200m/s:800m/s; a list of values for the other keys",
                    n == 0 ? "no --set has a range" : "several have a range"));
  return static_cast<std::size_t>(std::ranges::find_if(keys, [](const SweptKey& k) { return k.is_range; }) -
                                  keys.begin());
}

Sweep read(const SweepOptions& o) {
  Sweep s;
  config::Diagnostics found;
  s.case_file = find_case_file(o.file);
  s.keys = read_swept_keys(o.sets, found);
  found.throw_if_errors();
  if (!o.find.empty()) s.question.condition = parse_condition(o.find), s.along = key_to_search(s.keys);
  if (!o.find.empty()) s.within = tolerance(o.within, s.keys[s.along]);
  if (o.find.empty() && !o.within.empty())
    throw InputError("--within goes with --find\n   = help: add --find 'QUANTITY > VALUE', or omit it");
  std::size_t runs = 1;
  for (const SweptKey& key : s.keys) runs = std::min(runs * key.values.size(), most_runs + 1);
  if (runs > most_runs)
    throw InputError(fmt::format(
        "more than {} runs\n   = help: give fewer values, or sweep one key after the other", most_runs));
  s.question.quantities = o.quantities;
  std::vector<std::string> first;
  for (const SweptKey& key : s.keys) first.push_back(key.key + "=" + key.values.front());
  const LoadedCase loaded = load_case(o.file, first);
  loaded.found.throw_if_errors();
  check_named(o.quantities, loaded, "--quantity");
  if (s.searches()) {
    check_named({s.question.condition.quantity}, loaded, "--find");
    s.question.condition.check(known_quantities(loaded.contents));
  }
  s.title = title_of(loaded.contents);
  s.folder = o.folder.empty() ? fs::path("runs") / (short_name(s.case_file) + "_sweep") : fs::path(o.folder);
  s.jobs = o.jobs;
  return s;
}

std::vector<std::string> values_at(const std::vector<SweptKey>& keys, const Combination& at) {
  std::vector<std::string> values;
  for (std::size_t k = 0; k < keys.size(); ++k) values.push_back(keys[k].values[at[k]]);
  return values;
}

void write_table(const Sweep& s, const SweepRuns& runs) {
  const SweepTable table = runs.table(s.title, s.keys);
  const std::string text = sweep_markdown(table, runs.shown());
  write_atomically(s.folder / "sweep.csv", sweep_csv(table));
  write_atomically(s.folder / "sweep.md", text);
  tell(fmt::format("\n{}\n{}: {}, {} of them finished before; {} of each\n", text,
                   (s.folder / "sweep.csv").string(), counted(table.rows.size(), "run", "runs"),
                   runs.reused(), counted(table.columns.size(), "quantity", "quantities")));
}

int tell_stopped(const SweepRuns& runs) {
  std::fputs(runs.told_stopped().c_str(), stderr);
  return exit_stopped;
}

int tabulate(const Sweep& s) {
  SweepRuns runs(s.case_file, s.folder, s.question, s.jobs);
  for (const Combination& at : combinations_of(s.keys)) runs.add(s.keys, values_at(s.keys, at));
  make_folder(s.folder);
  if (!runs.compute()) return tell_stopped(runs);
  write_table(s, runs);
  return runs.worst();
}

/// A search for every choice of the other keys.
std::vector<FoundThreshold> searches_of(const Sweep& s) {
  std::vector<SweptKey> others = s.keys;
  others[s.along].values = {""};
  std::vector<FoundThreshold> all;
  for (const Combination& at : combinations_of(others))
    all.push_back({values_at(others, at), Threshold(s.keys[s.along].numbers, s.within), ""});
  return all;
}

int find_thresholds(const Sweep& s) {
  SweepRuns runs(s.case_file, s.folder, s.question, s.jobs);
  std::vector<FoundThreshold> found = searches_of(s);
  struct Try {
    std::size_t search, run;
    double x;
  };
  for (bool first = true;; first = false) {
    std::vector<Try> tries;
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (!found[k].problem.empty()) continue;
      std::vector<std::string> values = found[k].values;
      for (const double x : found[k].search.wanted()) {
        values[s.along] = range_value(x, s.keys[s.along].unit);
        tries.push_back({k, runs.add(s.keys, values), x});
      }
    }
    if (tries.empty()) break;
    if (first) make_folder(s.folder);
    if (!runs.compute()) return tell_stopped(runs);
    for (const Try& t : tries)
      if (runs.has_results(t.run))
        found[t.search].search.learn(t.x, runs.holds(t.run));
      else
        found[t.search].problem = fmt::format("the search ended at {}, whose run has no results: {}",
                                              range_value(t.x, s.keys[s.along].unit), runs.problem(t.run));
  }
  write_table(s, runs);
  const std::string text = threshold_text(s.keys, s.along, s.question.condition.text, found);
  write_atomically(s.folder / "threshold.csv", threshold_csv(s.keys, s.along, found));
  tell(fmt::format("\n{}{}\n", text, (s.folder / "threshold.csv").string()));
  const bool all = std::ranges::all_of(found, [](const FoundThreshold& f) { return f.search.changes() > 0; });
  return runs.worst() != 0 ? runs.worst() : all ? exit_finished : exit_expectation_failed;
}

}  // namespace

int sweep(const SweepOptions& o) {
  const Sweep s = read(o);
  watch_stop_signals();
  try {
    return s.searches() ? find_thresholds(s) : tabulate(s);
  } catch (const InputError& e) {  // that only results could show, such as a quantity without a value
    std::string text = e.what();
    while (text.ends_with('\n')) text.pop_back();
    if (!std::filesystem::exists(s.folder)) throw InputError(text);
    throw InputError(
        fmt::format("{}\n   = note: what has run is kept in {}, the corrected command goes on from it", text,
                    s.folder.string()));
  }
}

}  // namespace recoil::app
