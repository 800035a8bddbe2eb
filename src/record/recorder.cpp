#include "record/recorder.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "record/recorder_parts.hpp"

namespace recoil {

namespace {

/// What a killed run leaves is older than this part of the time that it has worked, and than so many seconds
/// of wall time, by no more than the step in hand.
constexpr double status_part = 0.1, status_every = 5;
constexpr int exit_stopped = 3, exit_expectation_failed = 5, exit_doubtful = 6;

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
Recorder<Dim>::Recorder(const config::Case& c, const State<Dim>& state, const parallel::World& world,
                        std::filesystem::path directory, parallel::Team* team)
    : parts_(std::make_unique<Parts>(c, state, world, std::move(directory), team)) {}

template <int Dim>
Recorder<Dim>::~Recorder() = default;

template <int Dim>
bool Recorder<Dim>::reads_contents_around() const {
  return parts_->gauges.reads_contents_around();
}

template <int Dim>
void Recorder<Dim>::begin(const State<Dim>& state) {
  Parts& p = *parts_;
  p.start(state);
  p.open_tables(CsvMode::create);
  p.collect(state, true, true);
  const Totals<Dim> totals = find_totals(state, p.world, p.team);
  if (p.first()) {
    p.budget.begin(totals);
    p.centre.begin(totals);
    p.events.begin(p.pairs);
    p.look(totals, true);
  }
  p.history_due.done(state.time);
  p.gauges.record(state.time, 0, p.sums, p.pairs, &totals, true);
  const auto floors = p.count_floors(state);
  together(p.world, [&] { check_known(p.quantities(totals, floors, state.step), p.case_.expect); });
  p.dump(state);
  if (!p.first()) return;
  p.flush();
  p.save_status(state, "running");
}

template <int Dim>
void Recorder<Dim>::after_step(const State<Dim>& state, double dt, bool unstable) {
  Parts& p = *parts_;
  p.dt = dt;
  p.unstable_steps += unstable ? 1 : 0;
  p.collect(state, false);
  const bool history = p.history_due.at(state.time), bodies = p.gauges.needs_totals(state.time);
  Totals<Dim> totals;
  if (history || bodies) totals = find_totals(state, p.world, p.team);
  if (p.first() && (history || bodies)) p.look(totals, history);
  if (history) p.history_due.done(state.time);
  p.gauges.record(state.time, dt, p.sums, p.pairs, bodies ? &totals : nullptr);
  p.follow_contacts(state, history || bodies ? &totals : nullptr);
  p.follow_failures(state);
  p.look_for_lift_off(state);
  p.save_events();
  p.dump_if_due(state);
  if (p.first() && p.status_is_due(std::min(status_every, status_part * p.worked()))) {
    p.flush();
    p.save_status(state, "running");
  }
  p.stop_beyond_limits(state, history || bodies);
}

template <int Dim>
void Recorder<Dim>::fragment(const State<Dim>& state, int from, int to, const Vec<Dim>& place) {
  Parts& p = *parts_;
  const auto name = [&](int body) { return p.names[static_cast<std::size_t>(body)]; };
  p.events.fragment(name(from), name(to), state.time, {place.c.begin(), place.c.end()});
}

template <int Dim>
Summary Recorder<Dim>::finish(const State<Dim>& state, const RunFacts& facts) {
  Parts& p = *parts_;
  Summary s;
  const Totals<Dim> totals = find_totals(state, p.world, p.team);
  if (p.first()) p.look(totals, true);
  p.collect(state, state.step == 0, true);
  p.gauges.record(state.time, 0, p.sums, p.pairs, &totals, true);
  if (p.fields.last() < state.time) p.dump(state);
  s.floors = p.count_floors(state);
  if (p.first()) {
    p.events.finish();
    p.save_events();
    const Quantities q = p.quantities(totals, s.floors, state.step);
    for (const auto* list : {&p.case_.expect, &facts.expect})
      for (const config::Expectation& e : *list) s.expect.push_back(check(q, e));
    for (const CheckResult& r : s.expect) s.passed = s.passed && r.pass;
    for (const auto& b : totals.bodies) s.cells += b.cells;
    s.budgets = p.budget.worst(), s.centres = p.centre.worst();
    s.turns = p.units.turns, s.turning_unit = p.units.angular_momentum, s.turning = p.budget.turning();
    s.gauges = summarise(q.gauges);
    s.events = p.events.events();
    s.fragments = p.fragments.last();
  }
  s.passed = !p.world.any(!s.passed);
  const Evidence evidence = p.evidence_on(state, s, facts);
  s.verdict = judge(evidence, p.case_.limits);
  s.exit = facts.exit;
  const auto is = [&](Verdict::Kind kind) {  // the first process alone has seen all there is to judge
    return p.world.any(p.first() && s.verdict.kind == kind);
  };
  if (is(Verdict::Kind::stopped)) s.exit = exit_stopped;
  if (s.exit == 0 && !s.passed) s.exit = exit_expectation_failed;
  if (is(Verdict::Kind::doubtful) && s.exit == 0) s.exit = exit_doubtful;
  s.version = facts.version;
  s.case_name = case_name(p.case_);
  s.time = state.time;
  s.steps = state.step;
  s.wall_s = facts.wall_s;
  s.cpu_s = facts.cpu_s;
  for (const BodyEvidence& body : evidence.bodies) s.cell_steps += body.cell_steps;
  const int stages = p.case_.method.stages == "one" ? 1 : 3;
  if (s.wall_s > 0) s.rate = (s.cell_steps - p.cell_steps_before) * stages / s.wall_s * 1e-6;
  if (p.first()) {
    p.flush();
    write_summary(p.directory / "summary.json", s);
    p.save_status(state, s.exit == exit_stopped ? "failed" : "finished");
  }
  return s;
}

template <int Dim>
bool Recorder<Dim>::stopped() const {
  return parts_->stopped;
}

template <int Dim>
Verdict Recorder<Dim>::abandon(const State<Dim>& state, const RunFacts& facts, const std::string& why) {
  Parts& p = *parts_;
  Evidence e = p.evidence_of(p.survey.own_evidence(state, facts.averaged));
  e.failure = why;
  Counters all;
  for (const auto& ledger : state.ledger) all += ledger.counters;
  for (const auto& [name, count] : all.list()) e.counters.emplace_back(name, *count);
  e.steps = state.step, e.unstable_steps = p.unstable_steps;
  Summary s;
  s.version = facts.version, s.case_name = case_name(p.case_);
  s.exit = exit_stopped, s.passed = false;
  s.verdict = judge(e, p.case_.limits);
  s.time = state.time, s.steps = state.step, s.wall_s = facts.wall_s;
  for (const BodyEvidence& body : e.bodies) s.cell_steps += body.cell_steps;
  s.budgets = p.budget.worst(), s.centres = p.centre.worst(), s.events = p.events.events(),
  s.floors = e.counters;
  write_summary(p.directory / "summary.json", s);
  if (p.first()) {
    p.flush();
    p.save_status(state, "failed");
  }
  return s.verdict;
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
