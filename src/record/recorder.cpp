#include "record/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include "config/shape/shape.hpp"
#include "core/error.hpp"
#include "format/csv.hpp"
#include "gauge/due.hpp"
#include "gauge/gauges.hpp"
#include "gauge/pair_sampler.hpp"
#include "parallel/archive.hpp"
#include "record/field_dump.hpp"
#include "record/findings.hpp"
#include "record/history.hpp"
#include "record/lift_off.hpp"
#include "record/state_survey.hpp"
#include "record/validity.hpp"

namespace recoil {

namespace {

constexpr double status_every = 5;  // s of wall time
constexpr int stages = 3;           // of a step
constexpr int exit_stopped = 3, exit_expectation_failed = 5, exit_doubtful = 6;

double wall_clock() {
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

std::array<bool, 3> closed_axes(const config::Domain& domain) {
  std::array<bool, 3> closed{};
  for (std::size_t d = 0; d < 3; ++d)
    for (const config::Boundary b : domain.boundary[d])
      closed[d] = closed[d] || b == config::Boundary::symmetry || b == config::Boundary::axis;
  return closed;
}

void write_events(const std::filesystem::path& path, const std::vector<Event>& events) {
  CsvWriter file(path, {"time [us]", "event", "bodies", "place [mm]", "detail"});
  for (const Event& e : events) {
    std::string place;
    for (const double x : e.place)
      place += (place.empty() ? "" : " ") + format_number(std::round(x * 1e9) / 1e6 + 0.0);
    file.row({e.time * 1e6, e.kind, e.bodies, place, e.detail});
  }
  file.flush();
}

/// Says the same error on all ranks that rank 0 found. Collective.
template <class F>
void together(const parallel::World& world, F&& f) {
  std::string text;
  if (world.rank() == 0) {
    try {
      f();
    } catch (const InputError& error) {
      text = error.what();
    }
  }
  parallel::Bytes bytes;
  parallel::pack(bytes, text.data(), text.size());
  world.broadcast(bytes);
  if (bytes.empty()) return;
  text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  throw InputError(text);
}

}  // namespace

template <int Dim>
struct Recorder<Dim>::Parts {
  const config::Case& case_;
  const parallel::World& world;
  std::filesystem::path directory;
  parallel::Team* team;
  RunUnits units;
  std::vector<std::string> names;
  std::vector<bool> rigid;
  OrderedSums sums;
  PairSampler<Dim> sampler;
  Gauges<Dim> gauges;
  EventWatch events;
  LiftOffWatch<Dim> lift_off;
  BudgetWatch<Dim> budget;
  std::optional<History<Dim>> history;
  FieldDump<Dim> fields;
  StateSurvey<Dim> survey;
  bool stopped = false;
  Due history_due, fields_due;
  std::vector<PairSample> pairs;
  double history_last = -1, started = 0, status_last = 0, dt = 0;
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
        sampler(state.count(), sums),
        gauges(c, state, w, make_folder("gauges"), sums),
        events(names, c.domain.geometry, closed_axes(c.domain)),
        budget(names, rigid, units.balanced),
        fields(make_folder("fields"), case_name(c), c.output.fields.variables),
        survey(state, c.limits),
        history_due(c.output.history.every),
        fields_due(c.output.fields.every),
        pairs(pair_count()) {}

  void open_tables(CsvMode mode) {
    if (!first()) return;
    history.emplace(directory / "history.csv", names, rigid, units, mode);
    write_events(directory / "events.csv", events.events());
    events_written = events.events().size();
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
    if (!write_history || !(totals.time > history_last)) return;
    history->row(totals, budget.now());
    history_last = totals.time;
  }

  void look_for_lift_off(const State<Dim>& state) {
    if (Dim == 1) return;
    lift_off.note(state);
    if (state.step % opening_steps != 0) return;
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
    write_events(directory / "events.csv", events.events());
  }

  void dump_if_due(const State<Dim>& state) {
    // Without an interval only the first and the last picture are wanted.
    if (case_.output.fields.every <= 0 || !fields_due.at(state.time)) return;
    fields.write(state, world);
    fields_due.done(state.time);
  }

  void save_status(const State<Dim>& state, const std::string& what) {
    const double now = wall_clock(), wall = now - started;
    const double done = case_.time.end > 0 ? state.time / case_.time.end : 1;
    status_last = now;
    write_status(directory / "status.json",
                 {what, state.time, case_.time.end, dt, state.step, wall,
                  done > 0 ? wall * std::max(0.0, 1 - done) / done : 0, budget.worst()});
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
    }
    const Verdict verdict = judge(e, case_.limits);
    stopped = world.any(verdict.kind == Verdict::Kind::stopped);
    if (!stopped) return;
    std::string text = "beyond a limit that stops a run";
    if (first()) text = verdict.reasons.front().text;
    throw PhysicsError(fmt::format("stopped at {:.6g} us: {}", state.time * 1e6, text));
  }

  /// Collective; complete on rank 0.
  Verdict verdict_on(const State<Dim>& state, const Summary& s, const RunFacts& facts) {
    if (survey.last() < state.step) survey.look(state, team);
    const auto recent = survey.recent(state, world);
    Evidence e = evidence_of(survey.evidence(state, facts.averaged, world));
    e.recent_averaged = recent.averaged, e.recent_cell_steps = recent.cell_steps;
    e.counters = s.floors;
    return judge(e, case_.limits);
  }

  Quantities quantities(const Totals<Dim>& totals,
                        const std::vector<std::pair<std::string, std::int64_t>>& floors, long steps) const {
    Quantities q = find_quantities(totals, names, rigid, units, budget.worst(), events, floors, steps);
    q.gauges = gauges.series();
    q.folder = std::filesystem::path(case_.file).parent_path();
    return q;
  }
};

template <int Dim>
Recorder<Dim>::Recorder(const config::Case& c, const State<Dim>& state, const parallel::World& world,
                        std::filesystem::path directory, parallel::Team* team)
    : parts_(std::make_unique<Parts>(c, state, world, std::move(directory), team)) {}

template <int Dim>
Recorder<Dim>::~Recorder() = default;

template <int Dim>
void Recorder<Dim>::begin(const State<Dim>& state) {
  Parts& p = *parts_;
  p.started = wall_clock();
  p.open_tables(CsvMode::create);
  p.collect(state, true, true);
  const Totals<Dim> totals = find_totals(state, p.world, p.team);
  if (p.first()) {
    p.budget.begin(totals);
    std::vector<BodyMotion> start;
    for (const BodyTotals<Dim>& b : totals.bodies) {
      BodyMotion& motion = start.emplace_back();
      motion.mass = b.mass;
      const auto& rigid = state.bodies[start.size() - 1].rigid;
      for (int d = 0; d < Dim; ++d) {
        motion.momentum[d] = b.momentum[d];
        if (rigid) motion.velocity[d] = rigid->velocity[d];
      }
    }
    p.events.begin(start);
    p.look(totals, true);
  }
  p.history_due.done(state.time);
  p.gauges.record(state.time, 0, p.sums, p.pairs, &totals, true);
  const auto floors = p.count_floors(state);
  together(p.world, [&] { check_known(p.quantities(totals, floors, state.step), p.case_.expect); });
  p.fields.write(state, p.world);
  p.fields_due.done(state.time);
  if (p.first()) p.save_status(state, "running");
}

template <int Dim>
void Recorder<Dim>::after_step(const State<Dim>& state, double dt) {
  Parts& p = *parts_;
  p.dt = dt;
  p.collect(state, false);
  const bool history = p.history_due.at(state.time), bodies = p.gauges.needs_totals(state.time);
  Totals<Dim> totals;
  if (history || bodies) totals = find_totals(state, p.world, p.team);
  if (p.first() && (history || bodies)) p.look(totals, history);
  if (history) p.history_due.done(state.time);
  p.gauges.record(state.time, dt, p.sums, p.pairs, bodies ? &totals : nullptr);
  if (p.first()) p.events.step(state.time, dt, p.pairs);
  p.look_for_lift_off(state);
  p.save_events();
  p.dump_if_due(state);
  if (p.first() && wall_clock() - p.status_last > status_every) {
    p.flush();
    p.save_status(state, "running");
  }
  p.stop_beyond_limits(state, history || bodies);
}

template <int Dim>
Summary Recorder<Dim>::finish(const State<Dim>& state, const RunFacts& facts) {
  Parts& p = *parts_;
  Summary s;
  const Totals<Dim> totals = find_totals(state, p.world, p.team);
  if (p.first()) p.look(totals, true);
  p.collect(state, state.step == 0, true);
  p.gauges.record(state.time, 0, p.sums, p.pairs, &totals, true);
  if (p.fields.last() < state.time) p.fields.write(state, p.world);
  s.floors = p.count_floors(state);
  if (p.first()) {
    p.events.finish();
    p.save_events();
    const Quantities q = p.quantities(totals, s.floors, state.step);
    for (const auto* list : {&p.case_.expect, &facts.expect})
      for (const config::Expectation& e : *list) s.expect.push_back(check(q, e));
    for (const CheckResult& r : s.expect) s.passed = s.passed && r.pass;
    for (const auto& b : totals.bodies) s.cells += b.cells;
    s.budgets = p.budget.worst();
    s.gauges = summarise(q.gauges);
    s.events = p.events.events();
  }
  s.passed = !p.world.any(!s.passed);
  s.verdict = p.verdict_on(state, s, facts);
  s.exit = facts.exit;
  if (p.world.any(s.verdict.kind == Verdict::Kind::stopped)) s.exit = exit_stopped;
  if (s.exit == 0 && !s.passed) s.exit = exit_expectation_failed;
  if (p.world.any(s.verdict.kind == Verdict::Kind::doubtful) && s.exit == 0) s.exit = exit_doubtful;
  s.version = facts.version;
  s.case_name = case_name(p.case_);
  s.time = state.time;
  s.steps = state.step;
  s.wall_s = facts.wall_s;
  s.cpu_s = facts.cpu_s;
  if (s.wall_s > 0)
    s.rate = static_cast<double>(s.cells) * static_cast<double>(s.steps) * stages / s.wall_s * 1e-6;
  if (p.first()) {
    p.flush();
    write_summary(p.directory / "summary.json", s);
    p.save_status(state, s.exit == exit_stopped ? "failed" : "finished");
  }
  return s;
}

template <int Dim>
void Recorder<Dim>::pack_whole(parallel::Bytes& bytes) {
  Parts& p = *parts_;
  p.survey.pack(p.world, bytes);
  if (!p.first()) return;
  p.flush();
  p.gauges.pack(bytes);
  p.events.pack(bytes);
  p.fields.pack(bytes);
  parallel::ArchiveWriter archive(bytes);
  archive(p.budget, p.history_due, p.fields_due, p.history_last, p.dt);
}

template <int Dim>
void Recorder<Dim>::pack_block(int slot, parallel::Bytes& bytes) const {
  parts_->lift_off.pack(slot, bytes);
}

template <int Dim>
void Recorder<Dim>::unpack_block(int slot, parallel::Unpacker& from) {
  parts_->lift_off.unpack(slot, from);
}

template <int Dim>
void Recorder<Dim>::resume(const State<Dim>& state, parallel::Unpacker& from) {
  Parts& p = *parts_;
  p.started = wall_clock();
  p.survey.unpack(p.world, from);
  p.gauges.unpack(from);
  p.events.unpack(from);
  p.fields.unpack(from, p.first());
  parallel::ArchiveReader archive(from);
  Due history_before, fields_before;
  archive(p.budget, history_before, fields_before, p.history_last, p.dt);
  p.history_due.go_on(history_before);
  p.fields_due.go_on(fields_before);
  if (p.first()) truncate_csv(p.directory / "history.csv", p.history_last * 1e6);
  p.open_tables(CsvMode::append);
  if (p.first()) p.save_status(state, "running");
}

template <int Dim>
void Recorder<Dim>::stop(const State<Dim>& state) {
  if (!parts_->first()) return;
  parts_->flush();
  parts_->save_status(state, "stopped");
}

template <int Dim>
bool Recorder<Dim>::stopped() const {
  return parts_->stopped;
}

template <int Dim>
void Recorder<Dim>::abandon(const State<Dim>& state, const RunFacts& facts, const std::string& why) {
  Parts& p = *parts_;
  Evidence e = p.evidence_of(p.survey.own_evidence(state, facts.averaged));
  e.failure = why;
  Counters all;
  for (const auto& ledger : state.ledger) all += ledger.counters;
  for (const auto& [name, count] : all.list()) e.counters.emplace_back(name, *count);
  Summary s;
  s.version = facts.version, s.case_name = case_name(p.case_);
  s.exit = exit_stopped, s.passed = false;
  s.verdict = judge(e, p.case_.limits);
  s.time = state.time, s.steps = state.step, s.wall_s = facts.wall_s;
  s.budgets = e.budgets, s.events = p.events.events(), s.floors = e.counters;
  write_summary(p.directory / "summary.json", s);
  if (!p.first()) return;
  p.flush();
  p.save_status(state, "failed");
}

template <int Dim>
std::vector<Event> Recorder<Dim>::take_news() {
  return parts_->events.take_news();
}

template <int Dim>
const std::vector<Drift>& Recorder<Dim>::budgets() const {
  return parts_->budget.worst();
}

std::string case_name(const config::Case& c) {
  const std::filesystem::path file(c.file);
  if (file.stem() != "case") return file.stem().empty() ? "case" : file.stem().string();
  const std::string folder = file.parent_path().filename().string();
  return folder.empty() || folder == "." || folder == ".." ? "case" : folder;
}

template class Recorder<1>;
template class Recorder<2>;
template class Recorder<3>;

}  // namespace recoil
