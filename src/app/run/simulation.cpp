#include "app/run/simulation.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#include "app/check/estimate.hpp"
#include "app/command_line.hpp"
#include "app/run/checkpoint_folder.hpp"
#include "app/run/crash.hpp"
#include "app/run/run_quantities.hpp"
#include "app/run/stepping.hpp"
#include "app/run/stop_request.hpp"
#include "app/run/verdict.hpp"
#include "core/build_info.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"
#include "problem/start.hpp"
#include "record/checkpoint.hpp"
#include "record/field_dump.hpp"
#include "record/recorder.hpp"
#include "state/state_error.hpp"
#include "timestep/schemes.hpp"

namespace recoil::app {

namespace {

/// Cells full of matter at the start, on all processes together.
double cells_with_matter(const config::Case& c) {
  double n = 0;
  const std::vector<double> cells = cells_of_bodies(c);
  for (std::size_t m = 0; m < cells.size(); ++m) n += c.bodies[m].rigid ? 0 : cells[m];
  return n;
}

void tell_news(Reporter& reporter, const std::vector<Event>& news) {
  for (const Event& e : news) {
    std::string place;
    for (const double x : e.place)  // to a nanometre
      place += fmt::format("{}{:.4g}", place.empty() ? " at " : ", ", std::round(x * 1e9) * 1e-6 + 0.0);
    if (!place.empty()) place += " mm";
    reporter.say(fmt::format("{:8.4g} us {} {}{}{}{}", e.time * 1e6, e.kind, e.bodies, place,
                             e.detail.empty() ? "" : "; ", e.detail));
  }
}

void tell_timers(Reporter& reporter, const Timers<StepPhase>& timers, double wall) {
  reporter.say("time by part of the step");
  for (int i = 0; i < static_cast<int>(StepPhase::count); ++i) {
    const auto part = static_cast<StepPhase>(i);
    reporter.say(fmt::format("  {:<16} {:8.3f} s  {:3.0f} %", name_of(part), timers.seconds(part),
                             wall > 0 ? 100 * timers.seconds(part) / wall : 0));
  }
}

/// What the processes have sent each other; nothing where there is one. Collective.
void tell_traffic(Reporter& reporter, const parallel::World& world, const parallel::Traffic& before,
                  long steps) {
  if (world.size() == 1 || steps == 0) return;
  const parallel::Traffic own = parallel::traffic() - before;
  const auto exchanges = static_cast<double>(own.exchanges), reductions = static_cast<double>(own.reductions);
  std::array<std::int64_t, 2> all{own.messages, own.bytes};
  std::array<double, 2> most{static_cast<double>(own.messages), static_cast<double>(own.bytes)};
  world.sum(all);
  world.max(most);
  const auto n = static_cast<double>(steps), per_rank = n * world.size();
  reporter.say(fmt::format("sent in a step by each of {} processes (mean, most)", world.size()));
  reporter.say(fmt::format("  exchanges        {:.1f}, reductions {:.1f}", exchanges / n, reductions / n));
  reporter.say(
      fmt::format("  messages         {:.1f}, {:.1f}", static_cast<double>(all[0]) / per_rank, most[0] / n));
  reporter.say(fmt::format("  kB               {:.1f}, {:.1f}", 1e-3 * static_cast<double>(all[1]) / per_rank,
                           1e-3 * most[1] / n));
}

/// What a verdict has to say of a failure, beyond its own text.
void add_reasons(Failure& failure, const Verdict& verdict) {
  for (const Reason& r : verdict.reasons) {
    if (!failure.text.starts_with(r.text)) failure.text += "\n   " + r.text;
    if (failure.place.empty() && !r.place.empty()) failure.body = r.body, failure.place = r.place;
  }
}

template <int Dim>
Refinement<Dim> refinement(const config::Case& c) {
  Refinement<Dim> rules{c.mesh.bend, c.mesh.every, {}};
  for (const config::Region& from : c.regions) {
    auto& region = rules.regions.emplace_back();
    for (int d = 0; d < Dim; ++d) region.lo[d] = from.lo[d], region.hi[d] = from.hi[d];
  }
  return rules;
}

}  // namespace

/// Processor time of all processes and threads since a reading of the clock.
double processor_seconds(const parallel::World& world, std::clock_t since) {
  std::array ticks{static_cast<std::int64_t>(std::clock() - since)};
  world.sum(ticks);
  return static_cast<double>(ticks[0]) / CLOCKS_PER_SEC;
}

template <int Dim>
Simulation<Dim>::Simulation(const LoadedCase& loaded, const SimulationOptions& options,
                            const parallel::World& world)
    : loaded_(loaded),
      case_(loaded.contents),
      options_(options),
      world_(world),
      reporter_(options.display, options.speaks, options.folder / "run.log", !options.checkpoint.empty()),
      team_(options.threads),
      engine_{world, team_, {}},
      state_(make_state<Dim>(case_, loaded.materials, world)),
      scheme_(scheme_of<Dim>(case_.method.scheme)),
      refinement_(refinement<Dim>(case_)),
      checkpoint_due_(case_.output.checkpoint.every),
      cells_(options.speaks ? cells_with_matter(case_) : 0),  // for those who read
      begun_(std::chrono::steady_clock::now()),
      worked_(std::clock()) {
  reporter_.say(fmt::format("{}: {} process{} of {} thread{}, results in {}", title_of(case_), world.size(),
                            world.size() > 1 ? "es" : "", options.threads, options.threads > 1 ? "s" : "",
                            options.folder.string()));
  recorder_.emplace(case_, state_, world, options.folder, &team_);
  engine_.contents_between_steps = recorder_->reads_contents_around();
  if (options.checkpoint.empty()) {
    scheme_.prepare(state_, engine_);
    regrid(state_, engine_, refinement_);
    recorder_->begin(state_);
  } else {
    read_checkpoint(BlockFile(options.checkpoint), state_, engine_.averaged, *recorder_, world);
    reporter_.say(fmt::format("goes on from {} at {:.6g} us, step {}", options.checkpoint.string(),
                              state_.time * 1e6, state_.step));
  }
  checkpoint_due_.done(state_.time);
  first_step_ = state_.step;
  reporter_.begin(state_.time, state_.step);
  sent_before_ = parallel::traffic();
}

template <int Dim>
double Simulation<Dim>::wall() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

template <int Dim>
RunFacts Simulation<Dim>::facts() const {
  RunFacts f;
  f.version = build_info::full_version;
  f.averaged = &engine_.averaged;
  f.wall_s = wall();
  return f;
}

template <int Dim>
bool Simulation<Dim>::finished() const {
  return !(state_.time < case_.time.end * (1 - 1e-12));  // the sum of the steps may miss the end by round-off
}

template <int Dim>
void Simulation<Dim>::tell_events() {
  if (const std::vector<Event> news = recorder_->take_news(); !news.empty()) tell_news(reporter_, news);
}

template <int Dim>
void Simulation<Dim>::advance() {
  const Stepping stepping = stepping_of(case_);
  try {
    if (regrid(state_, engine_, refinement_)) recorder_->after_regrid(state_);
    for (const auto& f : part_fragments(state_, engine_))
      recorder_->fragment(state_, f.from, f.to, f.position);
    dt_ = scheme_.advance(state_, stepping, case_.time.end, engine_);
    recorder_->after_step(state_, dt_, engine_.unstable);
  } catch (const PhysicsError& e) {
    fail(e);
  }
  tell_events();
  reporter_.progress({state_.time, case_.time.end, dt_, state_.step, cells_});
}

template <int Dim>
void Simulation<Dim>::fail(const PhysicsError& e) {
  RunFacts failed = facts();
  failed.exit = exit_numerical_failure;
  Failure failure{e.what(), "", {}, dt_};
  const bool together = recorder_->stopped();  // all processes have stopped
  if (together) {
    failed.cpu_s = processor_seconds(world_, worked_);
    const Summary summary = recorder_->finish(state_, failed);
    add_reasons(failure, summary.verdict);
    if (world_.rank() == 0) tell_verdict(reporter_, summary);
  } else {
    if (const auto* state_error = dynamic_cast<const StateError*>(&e))
      failure.body = state_error->body, failure.place = state_error->place;
    const Verdict known = recorder_->abandon(state_, failed, e.what());
    add_reasons(failure, known);
    tell_validity(reporter_, known);
  }
  const UnstructuredGrid all =
      together ? gather_fields(state_, world_, field_variables()) : UnstructuredGrid{};
  const auto fields = [&] { return together ? all : own_fields(state_, field_variables()); };
  if (!together || world_.rank() == 0)
    write_crash(options_.folder, case_, state_, failure, fields, world_.rank());
  throw PhysicsError(
      fmt::format("{}\n   = help: what is known is in {}", e.what(), (options_.folder / "crash").string()));
}

template <int Dim>
void Simulation<Dim>::save() {
  const auto file = checkpoint_file(options_.folder, state_.step);
  if (world_.rank() == 0) std::filesystem::create_directories(file.parent_path());
  CheckpointText text = describe(loaded_, options_.overrides);
  text.time = state_.time;
  write_checkpoint(file, to_json(text), state_, engine_.averaged, *recorder_, world_);
  if (world_.rank() == 0) remove_old_checkpoints(options_.folder, case_.output.checkpoint.keep);
  checkpoint_due_.done(state_.time);
  saved_at_ = wall();
}

template <int Dim>
void Simulation<Dim>::save_if_due() {
  const config::CheckpointOutput& wanted = case_.output.checkpoint;
  const bool by_time = wanted.every > 0 && checkpoint_due_.at(state_.time);
  const bool by_wall = wanted.every_wall > 0 && world_.rank() == 0 && wall() - saved_at_ > wanted.every_wall;
  if (wanted.every_wall > 0 ? world_.any(by_time || by_wall) : by_time) save();
}

template <int Dim>
Summary Simulation<Dim>::finish() {
  RunFacts done = facts();
  done.cpu_s = processor_seconds(world_, worked_);
  const Summary summary = recorder_->finish(state_, done);
  tell_events();
  if (options_.verbose) {
    tell_timers(reporter_, engine_.timers, done.wall_s);
    tell_traffic(reporter_, world_, sent_before_, state_.step - first_step_);
  }
  tell_verdict(reporter_, summary);
  reporter_.say(fmt::format("results in {}", options_.folder.string()));
  if (summary.exit == exit_numerical_failure)
    throw PhysicsError(fmt::format("the run has come to its end, but must not be trusted: see {}",
                                   (options_.folder / "summary.json").string()));
  write_quantities(options_.folder / "quantities.csv", case_, state_, summary, world_, team_);
  return summary;
}

template <int Dim>
void Simulation<Dim>::stop(const std::string& why) {
  save();
  recorder_->stop(state_);
  reporter_.insist(fmt::format("stopped at {:.6g} us, {}; `recoil resume {}` goes on", state_.time * 1e6, why,
                               options_.folder.string()));
}

template <int Dim>
int simulate(const LoadedCase& loaded, const SimulationOptions& options, const parallel::World& world) {
  const auto begun = std::chrono::steady_clock::now();
  Simulation<Dim> run(loaded, options, world);
  const auto out_of_time = [&] {
    const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - begun;
    return options.wall_limit > 0 && so_far.count() > options.wall_limit;
  };
  while (!run.finished()) {
    run.advance();
    if (run.finished()) break;
    if (world.any(stop_requested() || out_of_time())) {
      run.stop(out_of_time() ? "at the limit of its wall time" : "as asked");
      return exit_stopped;
    }
    run.save_if_due();
  }
  return run.finish().exit;
}

#define RECOIL_INSTANTIATE(Dim)   \
  template class Simulation<Dim>; \
  template int simulate<Dim>(const LoadedCase&, const SimulationOptions&, const parallel::World&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil::app
