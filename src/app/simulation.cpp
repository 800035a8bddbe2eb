#include "app/simulation.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "app/estimate.hpp"
#include "app/verdict.hpp"
#include "core/build_info.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"
#include "problem/start.hpp"
#include "record/recorder.hpp"
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

/// Writes what is known about a failure. @returns the folder.
template <int Dim>
std::filesystem::path write_crash(const SimulationOptions& options, const State<Dim>& state, double dt,
                                  int rank, const std::string& what) {
  const std::filesystem::path folder = options.folder / "crash";
  std::filesystem::create_directories(folder);
  std::string text =
      fmt::format("{}\ntime {:.9g} us, step {}, last dt {:.6g} ns, process {}\nrecoil {} ({})\n", what,
                  state.time * 1e6, state.step, dt * 1e9, rank, build_info::version, build_info::describe);
  text += "counted so far\n";
  Counters sum;
  for (const BlockLedger<Dim>& ledger : state.ledger) sum += ledger.counters;
  for (const auto& [name, count] : sum.list())
    if (*count != 0) text += fmt::format("  {} {}\n", name, *count);
  write_atomically(folder / fmt::format("process_{}.txt", rank), text);
  return folder;
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

/// The loop over steps. @param dt length of the last one [s], also after a failure.
template <int Dim>
void march(const config::Case& c, const Scheme<Dim>& scheme, State<Dim>& state, Engine& engine,
           Recorder<Dim>& recorder, Reporter& reporter, double& dt) {
  const Stepping stepping{c.time.cfl, c.time.fixed_dt, c.method.kappa};
  const double cells = cells_with_matter(c);
  const double last = c.time.end * (1 - 1e-12);  // the sum of the steps may miss the end by round-off
  while (state.time < last) {
    dt = scheme.advance(state, stepping, c.time.end, engine);
    recorder.after_step(state, dt);
    if (const std::vector<Event> news = recorder.take_news(); !news.empty()) tell_news(reporter, news);
    reporter.progress({state.time, c.time.end, dt, state.step, cells});
  }
}

}  // namespace

/// Processor time of all processes and threads since a reading of the clock.
double processor_seconds(const parallel::World& world, std::clock_t since) {
  std::array ticks{static_cast<std::int64_t>(std::clock() - since)};
  world.sum(ticks);
  return static_cast<double>(ticks[0]) / CLOCKS_PER_SEC;
}

template <int Dim>
int simulate(const LoadedCase& loaded, const SimulationOptions& options, const parallel::World& world) {
  const config::Case& c = loaded.contents;
  Reporter reporter(options.display, options.speaks, options.folder / "run.log");
  reporter.say(fmt::format("{}: {} process{} of {} thread{}, results in {}", c.title, world.size(),
                           world.size() > 1 ? "es" : "", options.threads, options.threads > 1 ? "s" : "",
                           options.folder.string()));
  parallel::Team team(options.threads);
  Engine engine{world, team, {}};
  State<Dim> state = make_state<Dim>(c, loaded.materials, world);
  const Scheme<Dim> scheme = scheme_of<Dim>(c.method.scheme);
  scheme.prepare(state, engine);
  Recorder<Dim> recorder(c, state, world, options.folder, &team);
  recorder.begin(state);

  const auto start = std::chrono::steady_clock::now();
  const std::clock_t worked = std::clock();
  const auto wall = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  double dt = 0;
  try {
    march(c, scheme, state, engine, recorder, reporter, dt);
  } catch (const PhysicsError& e) {
    recorder.abandon(state);
    const auto folder = write_crash(options, state, dt, world.rank(), e.what());
    throw PhysicsError(fmt::format("{}\n   = help: what is known is in {}", e.what(), folder.string()));
  }
  RunFacts facts;
  facts.version = fmt::format("{} ({})", build_info::version, build_info::describe);
  facts.wall_s = wall();
  facts.cpu_s = processor_seconds(world, worked);
  const Summary summary = recorder.finish(state, facts);
  tell_news(reporter, recorder.take_news());
  if (options.verbose) tell_timers(reporter, engine.timers, facts.wall_s);
  tell_verdict(reporter, summary);
  reporter.say(fmt::format("results in {}", options.folder.string()));
  return summary.exit;
}

template int simulate<1>(const LoadedCase&, const SimulationOptions&, const parallel::World&);
template int simulate<2>(const LoadedCase&, const SimulationOptions&, const parallel::World&);
template int simulate<3>(const LoadedCase&, const SimulationOptions&, const parallel::World&);

}  // namespace recoil::app
