#include "app/run/run_quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/command_line.hpp"
#include "app/run/standing.hpp"
#include "config/units.hpp"
#include "core/closest.hpp"
#include "core/error.hpp"
#include "format/csv.hpp"
#include "format/json_files.hpp"
#include "format/run_units.hpp"
#include "record/events.hpp"
#include "record/findings.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* file_name = "quantities.csv";
constexpr const char* flag_unit = "flag";

constexpr std::string_view of_contact = "contact.";

std::string contact_quantity(std::string_view first, std::string_view second, std::string_view what) {
  return fmt::format("{}{}-{}.{}", of_contact, first, second, what);
}

/// "contact.A-B.opens" taken apart.
struct PairName {
  std::string first, second, what;
  explicit operator bool() const { return !what.empty(); }
  std::string swapped() const { return contact_quantity(second, first, what); }
};

/// All ways to read such a name; one for each hyphen, since names of bodies may hold some. None for others.
std::vector<PairName> pair_names(const std::string& name) {
  std::vector<PairName> found;
  const std::size_t begin = of_contact.size(), dot = name.find('.', begin);
  if (!name.starts_with(of_contact) || dot == std::string::npos) return found;
  for (std::size_t k = begin; k < dot; ++k)
    if (name[k] == '-')
      found.push_back({name.substr(begin, k - begin), name.substr(k + 1, dot - k - 1), name.substr(dot + 1)});
  return found;
}

/// The one whose bodies are among these; nothing where there is none.
PairName pair_of(const std::string& name, const std::vector<std::string>& bodies) {
  const auto known = [&](const std::string& body) { return std::ranges::find(bodies, body) != bodies.end(); };
  for (const PairName& p : pair_names(name))
    if (known(p.first) && known(p.second)) return p;
  return {};
}

/// Times of a pair's contact, from the events of a run.
void take_events(Quantities& q, const std::vector<Event>& events) {
  const auto first = [&q](const std::string& name, double time) {
    if (const auto at = q.numbers.find(name); at != q.numbers.end() && std::isnan(at->second))
      at->second = time;
  };
  for (const Event& e : events) {
    q.flags["event." + e.kind] = true;
    const std::string pair = "contact." + e.bodies, failure = "failure." + e.bodies;
    if (e.kind == "contact") first(pair + ".made", e.time);
    if (e.kind == "opening" && !std::isnan(q.numbers[pair + ".opens"])) first(pair + ".reopens", e.time);
    if (e.kind == "opening") first(pair + ".opens", e.time);
    if (e.kind == "separation") first(pair + ".separates", e.time);
    if (e.kind == "reclosure") first(pair + ".recloses", e.time);
    if (e.kind == "lift-off") first(pair + ".first-lift-off", e.time);
    if (e.kind == "lift-off") q.numbers[pair + ".last-lift-off"] = e.time;
    if (e.kind != "failure") continue;
    first(failure + ".time", e.time);
  }
}

/// Where a body first failed: one number for each axis.
void take_places(Quantities& q, const std::vector<Event>& events, const std::vector<std::string>& axes) {
  for (const Event& e : events)
    for (std::size_t d = 0; e.kind == "failure" && d < std::min(axes.size(), e.place.size()); ++d)
      q.numbers["failure." + e.bodies + "." + axes[d]] = e.place[d];
}

/// Leaves each quantity once: a pair in the order of its bodies, the only component of a vector by its full
/// name; and drops what only the recorder knows, unless the case expects it.
void tidy(Quantities& q, const std::vector<std::string>& bodies, const std::vector<CheckResult>& expected) {
  const auto position = [&](const std::string& body) { return std::ranges::find(bodies, body); };
  for (const CheckResult& r : expected)
    if (const PairName p = pair_of(r.expected.quantity, bodies); p && p.what == "restitution")
      for (const std::string& name : {r.expected.quantity, p.swapped()})
        if (!std::isnan(r.measured.value)) q.numbers[name] = r.measured.value;
  std::erase_if(q.numbers, [&](const auto& entry) {
    const PairName p = pair_of(entry.first, bodies);
    if (p && position(p.second) < position(p.first)) return true;
    if (p && p.what == "restitution" && std::isnan(entry.second)) return true;
    return q.numbers.contains(entry.first + ".x") && !q.numbers.contains(entry.first + ".y");
  });
  std::erase_if(q.flags, [&](const auto& entry) { return pair_of(entry.first, bodies); });  // by times
  for (auto& [name, value] : q.numbers)
    if (const PairName p = pair_of(name, bodies); p && p.what == "lasts")
      value = q.numbers.at(contact_quantity(p.first, p.second, "opens")) -
              q.numbers.at(contact_quantity(p.first, p.second, "made"));
}

double size_of(const std::string& unit) { return unit.empty() || unit == "1" ? 1 : config::unit_size(unit); }

SeriesColumn column_of(const CsvTable& table, const std::string& head) {
  const std::string unit = table.unit(head);
  return {unit.empty() ? head : head.substr(0, head.rfind(" [")), unit, 1 / size_of(unit)};
}

TimeSeries read_series(const fs::path& file) {
  const CsvTable table = read_csv(file);
  TimeSeries s;
  s.name = file.stem().string();
  s.over = column_of(table, table.columns.front());
  s.time = table.numbers(table.columns.front());
  for (double& t : s.time) t *= size_of(s.over.unit);
  for (std::size_t k = 1; k < table.columns.size(); ++k) {
    s.columns.push_back(column_of(table, table.columns[k]));
    s.values.push_back(table.numbers(table.columns[k]));
    for (double& v : s.values.back()) v *= size_of(s.columns.back().unit);
  }
  return s;
}

void read_gauges(Quantities& q, const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const fs::path& file : files) q.gauges.push_back(read_series(file));
}

/// The other names by which an expectation may call a number, and the flags that follow from it.
void add_aliases(Quantities& q) {
  const std::map<std::string, double> given = q.numbers;
  for (const auto& [name, value] : given) {
    if (name.starts_with("body.") && name.ends_with(".x"))
      if (const std::string bare = name.substr(0, name.size() - 2); !given.contains(bare + ".y"))
        q.numbers[bare] = value, q.units[bare] = q.units[name];
    for (const PairName& p : pair_names(name)) {
      q.numbers[p.swapped()] = value, q.units[p.swapped()] = q.units[name];
      if (p.what == "made" || p.what == "opens" || p.what == "separates" || p.what == "recloses")
        q.flags[name] = q.flags[p.swapped()] = !std::isnan(value);
    }
  }
}

/// Why a folder has no results.
std::string why_none(const fs::path& run) {
  if (!fs::exists(run / "status.json"))
    return fmt::format("{} holds no finished run\n   = help: give the folder of a run, runs/NAME",
                       run.string());
  const Standing s = standing_of(run);
  const std::string where = fmt::format("{:.4g} of {:.4g} us", s.time_us, s.end_us);
  if (s.state == "running")
    return fmt::format(
        "the run in {} is still going, at {}: it has no results yet\n   = help: try again at its end; "
        "`recoil status {}` says how long that takes",
        run.string(), where, run.string());
  if (s.state == "failed")
    return fmt::format("the run in {} stopped at {} (exit code {}) and has no results\n   = help: see {}",
                       run.string(), where, static_cast<int>(exit_numerical_failure),
                       (run / (fs::exists(run / "report.html") ? "report.html" : "summary.json")).string());
  if (s.state == "stopped" || s.state == "interrupted")
    return fmt::format(
        "the run in {} was {} at {} and has no results\n   = help: `recoil status {}` says how "
        "to go on",
        run.string(), s.state, where, run.string());
  return fmt::format("{} holds no {}\n   = help: run the case again", run.string(), file_name);
}

}  // namespace

template <int Dim>
void write_quantities(const fs::path& file, const config::Case& c, const State<Dim>& state,
                      const Summary& summary, const parallel::World& world, parallel::Team& team) {
  const Totals<Dim> totals = find_totals(state, world, &team);
  if (world.rank() != 0) return;
  std::vector<std::string> names;
  std::vector<bool> rigid;
  for (const auto& body : state.bodies) {
    names.push_back(body.name);
    rigid.push_back(body.rigid && !body.rigid->mass);
  }
  const RunUnits units = run_units(c.domain.geometry);
  Quantities q = find_quantities(totals, names, rigid, units, summary.budgets,
                                 without_events(names, c.domain.geometry), summary.floors, summary.steps);
  take_events(q, summary.events);
  take_places(q, summary.events, units.axes);
  add_fragments(q, summary.fragments, units);
  tidy(q, names, summary.expect);
  std::string text = "quantity,value,unit\n";
  for (const auto& [name, value] : q.numbers) {
    const std::string& unit = q.units.at(name);
    text += fmt::format("{},{},{}\n", name, format_number(value / size_of(unit)), unit);
  }
  for (const auto& [name, flag] : q.flags) text += fmt::format("{},{},{}\n", name, flag ? 1 : 0, flag_unit);
  write_atomically(file, text);
}

bool has_quantities(const fs::path& run) {
  return fs::exists(run / "summary.json") && fs::exists(run / file_name);
}

RunQuantities read_quantities(const fs::path& run, const fs::path& case_folder) {
  if (!has_quantities(run)) throw InputError(why_none(run));
  RunQuantities r;
  r.file = run / file_name;
  const CsvTable table = read_csv(run / file_name);
  const std::vector<std::string> names = table.texts("quantity"), units = table.texts("unit");
  const std::vector<double> values = table.numbers("value");
  for (std::size_t k = 0; k < names.size(); ++k) {
    r.names.push_back(names[k]);
    if (units[k] == flag_unit)
      r.found.flags[names[k]] = values[k] != 0;
    else
      r.found.numbers[names[k]] = values[k] * size_of(units[k]), r.found.units[names[k]] = units[k];
  }
  add_aliases(r.found);
  read_gauges(r.found, run / "gauges");
  r.found.folder = case_folder;
  return r;
}

double value_of(const RunQuantities& run, const std::string& quantity) {
  if (quantity.starts_with("gauge.")) return measure(run.found, quantity).value;
  if (const auto at = run.found.numbers.find(quantity); at != run.found.numbers.end()) return at->second;
  if (const auto at = run.found.flags.find(quantity); at != run.found.flags.end()) return at->second ? 1 : 0;
  const std::string near = did_you_mean(quantity, run.names);
  throw InputError(fmt::format(
      "the run has no quantity '{}'\n   = help: {}", quantity,
      !near.empty()
          ? near
          : fmt::format("{} lists what it has; more of gauges: gauge.NAME.COLUMN.max", run.file.string())));
}

std::vector<std::string> peaks_of_gauges(const RunQuantities& run) {
  std::vector<std::string> all;
  for (const TimeSeries& s : run.found.gauges)
    if (s.over.name == "time" && !s.columns.empty())
      all.push_back(fmt::format("gauge.{}.{}.peak", s.name, s.columns.front().name));
  return all;
}

std::vector<std::string> extremes_of_gauges(const RunQuantities& run) {
  std::vector<std::string> all;
  for (const TimeSeries& s : run.found.gauges)
    for (const SeriesColumn& c : s.columns)
      for (const char* what : {"max", "min", "last"})
        if (s.over.name == "time") all.push_back(fmt::format("gauge.{}.{}.{}", s.name, c.name, what));
  return all;
}

#define RECOIL_INSTANTIATE(Dim)                                                                \
  template void write_quantities<Dim>(const fs::path&, const config::Case&, const State<Dim>&, \
                                      const Summary&, const parallel::World&, parallel::Team&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil::app
