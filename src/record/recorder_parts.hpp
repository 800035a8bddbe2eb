#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "config/shape/shape.hpp"
#include "core/error.hpp"
#include "format/csv.hpp"
#include "gauge/due.hpp"
#include "gauge/gauges.hpp"
#include "gauge/pair_sampler.hpp"
#include "material/starting_state.hpp"
#include "parallel/archive.hpp"
#include "record/balance/centre_watch.hpp"
#include "record/field_dump.hpp"
#include "record/findings.hpp"
#include "record/fragment_table.hpp"
#include "record/history.hpp"
#include "record/lift_off.hpp"
#include "record/recorder.hpp"
#include "record/state_survey.hpp"
#include "record/validity.hpp"

/// What a Recorder is made of. For its own .cpp files only.
namespace recoil {

inline double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <int Dim>
std::vector<std::string> names_of(const State<Dim>& state) {
  std::vector<std::string> names;
  for (const auto& body : state.bodies) names.push_back(body.name);
  return names;
}

template <int Dim>
std::vector<bool> rigid_bodies(const State<Dim>& state) {
  std::vector<bool> rigid;
  for (const auto& body : state.bodies) rigid.push_back(body.rigid && !body.rigid->mass);
  return rigid;
}

/// Those that have no cells of their own.
template <int Dim>
std::vector<bool> without_cells(const State<Dim>& state) {
  std::vector<bool> rigid;
  for (const auto& body : state.bodies) rigid.push_back(body.rigid.has_value());
  return rigid;
}

/// Body::fragments_of of all.
template <int Dim>
std::vector<int> sources_of_fragments(const State<Dim>& state) {
  std::vector<int> sources;
  for (const auto& body : state.bodies) sources.push_back(body.fragments_of);
  return sources;
}

inline std::array<bool, 3> closed_axes(const config::Domain& domain) {
  std::array<bool, 3> closed{};
  for (std::size_t d = 0; d < 3; ++d)
    for (const config::Boundary b : domain.boundary[d])
      closed[d] = closed[d] || b == config::Boundary::symmetry || b == config::Boundary::axis;
  return closed;
}

/// What changes of contact must last: twenty transits of a cell by sound, of the pair's slower body. A gap of
/// a tenth of a cell is what the scheme keeps between surfaces that touch.
template <int Dim>
ContactRule contact_rule(const State<Dim>& state, const config::Method& method) {
  constexpr double held_transits = 20, open_gap = 0.1;
  const double dx = state.grid().dx;
  ContactRule rule;
  rule.gap = open_gap * dx;
  if (method.scheme == "seed") rule.stand_off = method.kappa * dx;
  if (method.scheme != "conservative")
    rule.gap_at = 0.5;  // their surfaces are those of the middle of the step
  for (int a = 0; a < state.count(); ++a)
    for (int b = a + 1; b < state.count(); ++b) {
      double hold = 0;
      for (const int m : {a, b})
        if (!state.bodies[m].rigid)
          hold = std::max(hold, held_transits * dx / bulk_sound_speed(state.bodies[m].material));
      rule.hold.push_back(hold);
      const auto& law = state.contact[pair_number(a, b, state.count())];
      rule.glued.push_back(law.mode == ContactLaw::Mode::bonded);
    }
  return rule;
}

/// Motion of all bodies, as the gauges of kind `body` have it.
template <int Dim>
std::vector<BodyMotion> motion_of(const State<Dim>& state, const Totals<Dim>& totals) {
  std::vector<BodyMotion> all;
  for (const BodyTotals<Dim>& b : totals.bodies) {
    BodyMotion& motion = all.emplace_back();
    motion.mass = b.mass;
    const auto& rigid = state.bodies[all.size() - 1].rigid;
    for (int d = 0; d < Dim; ++d) {
      motion.momentum[d] = b.momentum[d];
      if (rigid) motion.velocity[d] = rigid->velocity[d];
    }
  }
  return all;
}

/// @param axes of the run: a place has a column for each.
inline void write_events(const std::filesystem::path& path, const std::vector<Event>& events,
                         const std::vector<std::string>& axes) {
  std::vector<std::string> columns{"time [us]", "event", "bodies"};
  for (const std::string& axis : axes) columns.push_back("place." + axis + " [mm]");
  columns.emplace_back("detail");
  CsvWriter file(path, columns);
  for (const Event& e : events) {
    std::vector<CsvCell> row{e.time * 1e6, e.kind, e.bodies};
    for (std::size_t d = 0; d < axes.size(); ++d)
      row.emplace_back(d < e.place.size() ? std::round(e.place[d] * 1e9) / 1e6 + 0.0
                                          : std::numeric_limits<double>::quiet_NaN());
    row.emplace_back(e.detail);
    file.row(row);
  }
  file.flush();
}

/// over_isentrope() of each body at the start of the case; 1 for those that are rigid.
template <int Dim>
std::vector<double> starts_over_isentropes(const config::Case& c, const State<Dim>& state) {
  std::vector<double> ratios(state.bodies.size(), 1);
  for (std::size_t m = 0; m < ratios.size(); ++m) {
    const Body<Dim>& body = state.bodies[m];
    const config::Body& from = c.bodies[m];
    if (!body.rigid)
      ratios[m] = over_isentrope(body.temperature,
                                 state_at_start(body.material, from.pressure, from.temperature, from.name));
  }
  return ratios;
}

template <int Dim>
struct Recorder<Dim>::Parts {
  const config::Case& case_;
  const parallel::World& world;
  std::filesystem::path directory;
  parallel::Team* team;
  RunUnits units;
  std::vector<std::string> names;
  std::vector<bool> rigid, loaded;
  ExactSums sums;
  PairSampler<Dim> sampler;
  Gauges<Dim> gauges;
  EventWatch events;
  LiftOffWatch<Dim> lift_off;
  BudgetWatch<Dim> budget;
  CentreWatch<Dim> centre;
  std::optional<History<Dim>> history;
  FieldDump<Dim> fields;
  FragmentTable<Dim> fragments;
  StateSurvey<Dim> survey;
  double cell_steps_before = 0;  // of the runs that this one continues; on rank 0
  bool stopped = false;
  std::int64_t unstable_steps = 0;  // longer than a stable one
  Due history_due, fields_due;
  std::vector<PairSample> pairs;
  std::vector<bool> failure_told;  // by body: its first failure is known
  double history_last = -1, started = 0, status_last = 0, dt = 0;
  double started_at = 0;  // s, of the state: after a resume that of the checkpoint
  std::size_t events_written = 0;

  Parts(const config::Case& c, const State<Dim>& state, const parallel::World& w, std::filesystem::path d,
        parallel::Team* t)
      : case_(c),
        world(w),
        directory(std::move(d)),
        team(t),
        units(run_units(c.domain.geometry)),
        names(names_of(state)),
        rigid(rigid_bodies(state)),
        loaded(loaded_bodies(state)),
        sampler(state.count(), sums),
        gauges(c, state, w, make_folder("gauges"), sums),
        events(names, c.domain.geometry, contact_rule(state, c.method), closed_axes(c.domain)),
        lift_off(contact_rule(state, c.method).hold),
        budget(names, rigid, units.balanced),
        centre(names, without_cells(state), units.balanced, sources_of_fragments(state)),
        fields(make_folder("fields"), case_name(c), c.output.fields.variables),
        fragments(names, without_cells(state), units),
        survey(state, c.limits, config::largest_closing_speed(c), starts_over_isentropes(c, state)),
        history_due(c.output.history.every),
        fields_due(c.output.fields.every),
        pairs(pair_count()),
        failure_told(names.size(), false) {}

  void open_tables(CsvMode mode) {
    if (!first()) return;
    history.emplace(directory / "history.csv", names, rigid, loaded, units, mode);
    write_events(directory / "events.csv", events.events(), units.axes);
    events_written = events.events().size();
    fragments.open(directory / "fragments.csv", mode, fields.last());
  }

  bool first() const { return world.rank() == 0; }
  std::size_t pair_count() const { return names.size() * (names.size() - 1) / 2; }
  std::filesystem::path make_folder(const char* name) const {
    std::error_code error;
    if (first()) std::filesystem::create_directories(directory / name, error);
    if (error)
      throw EnvironmentError("cannot make the folder '" + (directory / name).string() +
                             "': " + error.message());
    return directory / name;
  }

  void collect(const State<Dim>& state, bool at_rest, bool all = false) {
    sums.clear();
    sampler.collect(state, sums);
    gauges.collect(state, sums, at_rest, all);
    sums.reduce(world);
    if (first()) pairs = sampler.read(sums);
  }

  void look(const Totals<Dim>& totals, bool write_history) {
    budget.look(totals);
    centre.look(totals);
    if (!write_history || !(totals.time > history_last)) return;
    history->row(totals, budget.now());
    history_last = totals.time;
  }

  /// Takes the step into account in the contacts' stories. Collective.
  void follow_contacts(const State<Dim>& state, const Totals<Dim>* totals) {
    std::vector<BodyMotion> motion;
    if (world.any(first() && events.needs_motion(pairs))) {
      Totals<Dim> own;
      if (totals == nullptr) own = find_totals(state, world, team);
      motion = motion_of(state, totals == nullptr ? own : *totals);
    }
    if (first()) events.step(state.time, dt, pairs, motion);
  }

  /// Takes the first failure of each body into account. Collective.
  void follow_failures(const State<Dim>& state) {
    for (std::size_t m = 0; m < state.bodies.size(); ++m) {
      if (failure_told[m] || rigid[m] || !can_fail(state.bodies[m].material.damage)) continue;
      FailureRecord<Dim> own;
      for (const auto& ledger : state.ledger) own.merge(ledger.failures[m]);
      if (!world.any(own.time < infinite)) continue;
      failure_told[m] = true;
      parallel::Bytes bytes;
      parallel::pack(bytes, own);
      FailureRecord<Dim> first_one;
      for (const auto& from : world.gather(bytes))
        first_one.merge(parallel::Unpacker(from).template read<FailureRecord<Dim>>());
      if (!first()) continue;
      const Vec<Dim> x = state.grid().centre(first_one.cell);
      events.failure(names[m], first_one.time, {x.c.begin(), x.c.end()});
    }
  }

  void look_for_lift_off(const State<Dim>& state) {
    if (Dim == 1) return;
    lift_off.note(state);
    if (state.step % lift_off_steps != 0) return;
    const auto places = lift_off.collect(state, world);
    if (!first()) return;
    const std::vector<PairStory> stories = events.stories();
    for (const auto& place : places) {
      const auto pair = static_cast<std::size_t>(place.pair);
      if (!stories[pair].open && pairs[pair].area > 0)
        events.lift_off(pair, place.time, {place.at.c.begin(), place.at.c.end()});
    }
  }

  void save_events() {
    if (!first() || events.events().size() == events_written) return;
    events_written = events.events().size();
    write_events(directory / "events.csv", events.events(), units.axes);
  }

  void dump_if_due(const State<Dim>& state) {
    // Without an interval only the first and the last picture are wanted.
    if (case_.output.fields.every <= 0 || !fields_due.at(state.time)) return;
    dump(state);
  }

  /// Fields, and the table of fragments. Collective.
  void dump(const State<Dim>& state) {
    const Fragments<Dim> found = find_fragments(state, world);
    fields.write(state, world, &found);
    if (first()) fragments.write(found, state.time);
    fields_due.done(state.time);
  }

  /// The first or the next life of the run begins.
  void start(const State<Dim>& state) { started = wall_clock(), started_at = state.time; }
  /// s of wall time since then.
  double worked() const { return wall_clock() - started; }
  bool status_is_due(double every) const { return wall_clock() - status_last > every; }

  void save_status(const State<Dim>& state, const std::string& what) {
    const double wall = worked(), end = case_.time.end, done = state.time - started_at;
    status_last = wall_clock();
    write_status(directory / "status.json",
                 {what, state.time, end, dt, state.step, wall,
                  done > 0 ? wall * std::max(0.0, end - state.time) / done : 0, budget.worst()});
  }

  void flush() {
    if (!first()) return;
    history->flush();
    gauges.flush();
  }

  std::vector<std::pair<std::string, std::int64_t>> count_floors(const State<Dim>& state) const {
    Counters all;
    for (const auto& ledger : state.ledger) all += ledger.counters;
    std::vector<std::int64_t> counts;
    for (const auto& [name, count] : all.list()) counts.push_back(*count);
    world.sum(counts);
    std::vector<std::pair<std::string, std::int64_t>> floors;
    for (const auto& [name, count] : all.list()) floors.emplace_back(name, counts[floors.size()]);
    floors.emplace_back("unstable-steps", unstable_steps);
    return floors;
  }

  /// What is known beside `bodies`; budgets on rank 0 only.
  Evidence evidence_of(std::vector<BodyEvidence> bodies) const {
    Evidence e;
    e.dimensions = Dim;
    e.conservative = case_.method.scheme == "conservative";
    e.bodies = std::move(bodies);
    for (BodyEvidence& b : e.bodies)
      for (const config::Body& body : case_.bodies)
        if (body.name == b.name)
          b.thickness = config::thickness(body.shape, case_.domain) / case_.mesh.finest;
    e.budgets = budget.worst();
    e.converted = budget.converted();
    e.centres = centre.worst(), e.cell = case_.mesh.finest;
    return e;
  }

  /// Stops the run where it has passed a limit that says so. Collective.
  void stop_beyond_limits(const State<Dim>& state, bool looked) {
    const bool due = state.step % survey_steps == 0;
    if (!due && !looked) return;
    Evidence e = evidence_of({});
    if (due) {
      survey.look(state, team);
      const auto recent = survey.recent(state, world);
      e.recent_averaged = recent.averaged, e.recent_cell_steps = recent.cell_steps;
      e.steps = state.step, e.unstable_steps = unstable_steps;
    }
    const Verdict verdict = judge(e, case_.limits);
    stopped = world.any(verdict.kind == Verdict::Kind::stopped);
    if (!stopped) return;
    std::string text = "beyond a limit that stops a run";
    if (first()) text = verdict.reasons.front().text;
    throw PhysicsError(fmt::format("stopped at {:.6g} us: {}", state.time * 1e6, text));
  }

  /// All that a run is judged by at its end. Collective; complete on rank 0.
  Evidence evidence_on(const State<Dim>& state, const Summary& s, const RunFacts& facts) {
    if (survey.last() < state.step) survey.look(state, team);
    const auto recent = survey.recent(state, world);
    Evidence e = evidence_of(survey.evidence(state, facts.averaged, world));
    e.recent_averaged = recent.averaged, e.recent_cell_steps = recent.cell_steps;
    e.counters = s.floors;
    e.steps = state.step, e.unstable_steps = unstable_steps;
    return e;
  }

  Quantities quantities(const Totals<Dim>& totals,
                        const std::vector<std::pair<std::string, std::int64_t>>& floors, long steps) const {
    Quantities q = find_quantities(totals, names, rigid, units, budget.worst(), events, floors, steps);
    add_fragments(q, fragments.last(), units);
    q.gauges = gauges.series();
    q.folder = std::filesystem::path(case_.file).parent_path();
    return q;
  }
};

}  // namespace recoil
