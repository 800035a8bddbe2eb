#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/launch.hpp"
#include "app/load_case.hpp"
#include "app/machine.hpp"
#include "app/report/report_page.hpp"
#include "app/run/checkpoint_folder.hpp"
#include "app/run/run_folder.hpp"
#include "app/run/simulation.hpp"
#include "app/run/stop_request.hpp"
#include "config/units.hpp"
#include "core/error.hpp"

namespace recoil::app {

namespace {

/// Set for the processes of a run with -n that was started at a terminal.
constexpr const char* terminal_mark = "RECOIL_TERMINAL";

int default_threads(const config::Case& c, int ranks) {
  if (config::dimension(c.domain.geometry) == 1) return 1;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / ranks);
}

/// Under mpirun, whose processes always write to something like a terminal, only -n says whether there is
/// one.
template <class Options>
Display display_of(const Options& options) {
  if (options.quiet) return Display::none;
  const bool terminal = launched() ? std::getenv(terminal_mark) != nullptr : isatty(STDOUT_FILENO) == 1;
  return !options.plain && terminal ? Display::live : Display::plain;
}

/// A limit of wall time [s]; 0: none. @throws InputError.
double wall_limit(const std::string& text) {
  if (text.empty()) return 0;
  const auto value = config::parse_quantity(text, "s", "--wall");
  if (!value.ok() || !(value.value > 0))
    throw InputError(fmt::format("error: --wall {}: {}\n   = help: write it as 2h, 30min or 90s", text,
                                 value.ok() ? "a time above zero is needed" : value.problem));
  return value.value;
}

/// The command line of one of the processes under mpirun: ours without -n.
std::vector<std::string> arguments_of(const ResumeOptions& o) {
  std::vector<std::string> words{"resume", o.folder};
  if (!o.from.empty()) words.insert(words.end(), {"--from", o.from});
  if (!o.to.empty()) words.insert(words.end(), {"--to", o.to});
  if (o.threads > 0) words.insert(words.end(), {"-j", std::to_string(o.threads)});
  for (const std::string& change : o.overrides) words.insert(words.end(), {"--set", change});
  if (!o.wall.empty()) words.insert(words.end(), {"--wall", o.wall});
  if (o.quiet) words.push_back("--quiet");
  if (o.verbose) words.push_back("--verbose");
  if (o.plain) words.push_back("--plain");
  return words;
}
std::vector<std::string> arguments_of(const RunOptions& o) {
  std::vector<std::string> words{"run", o.file};
  if (!o.folder.empty()) words.insert(words.end(), {"-o", o.folder});
  if (o.threads > 0) words.insert(words.end(), {"-j", std::to_string(o.threads)});
  for (const std::string& change : o.overrides) words.insert(words.end(), {"--set", change});
  if (!o.end.empty()) words.insert(words.end(), {"--end", o.end});
  if (!o.wall.empty()) words.insert(words.end(), {"--wall", o.wall});
  if (o.force) words.push_back("--force");
  if (o.quiet) words.push_back("--quiet");
  if (o.verbose) words.push_back("--verbose");
  if (o.plain) words.push_back("--plain");
  return words;
}

/// More processes than this for each processor only wait for each other.
constexpr int most_ranks_each = 8;

void check_ranks(int ranks) {
  const int processors = machine_processors();
  if (ranks > most_ranks_each * processors)
    throw InputError(fmt::format("{} processes are too many for {} processor{}\n   = help: -n {}", ranks,
                                 processors, processors > 1 ? "s" : "", processors));
}

/// The number of threads does not change results, so what is more than there are processors is left out.
template <class Options>
int threads_of(const Options& options, const config::Case& c, int ranks) {
  if (options.threads <= 0) return default_threads(c, ranks);
  const int processors = machine_processors();
  if (options.threads > processors && speaks() && !options.quiet)
    fmt::print(stderr, "note: {} threads, as there are processors, not {}\n", processors, options.threads);
  return std::min(options.threads, processors);
}

int simulate_any(const LoadedCase& loaded, const SimulationOptions& options, const parallel::World& world) {
  switch (config::dimension(loaded.contents.domain.geometry)) {
    case 1:
      return simulate<1>(loaded, options, world);
    case 2:
      return simulate<2>(loaded, options, world);
    default:
      return simulate<3>(loaded, options, world);
  }
}

/// With other processes waiting for us, an error must end them all.
int simulate_together(const LoadedCase& loaded, const SimulationOptions& options,
                      const parallel::World& world) {
  if (world.size() == 1) return simulate_any(loaded, options, world);
  bool failed = false;
  const int code = report_errors([&] {
    try {
      return simulate_any(loaded, options, world);
    } catch (const std::exception& e) {
      failed = true;
      if (!options.speaks) fmt::print(stderr, "process {}: {}\n", world.rank(), e.what());
      throw;
    }
  });
  if (failed) world.abort(code);
  return code;
}

}  // namespace

namespace {

/// A run that has ended, also one that had to, leaves a page that shows it.
int simulate_and_report(const LoadedCase& loaded, const SimulationOptions& options,
                        const parallel::World& world) {
  const bool reports = options.speaks && loaded.contents.output.report;
  const bool quiet = options.display == Display::none;
  try {
    const int code = simulate_together(loaded, options, world);
    if (reports && has_results(code)) leave_report(options.folder, quiet);
    return code;
  } catch (const PhysicsError&) {
    if (reports) leave_report(options.folder, quiet);
    throw;
  }
}

/// What `run` and `resume` have in common once the case is read.
/// @param prepare_folder done by one process, which holds the folder.
template <class Options, class Prepare>
int start(const Options& options, const LoadedCase& loaded, SimulationOptions& simulation,
          const Prepare& prepare_folder) {
  simulation.speaks = speaks();
  simulation.display = display_of(options);
  simulation.verbose = options.verbose;
  simulation.wall_limit = wall_limit(options.wall);
  if (options.ranks > 1 && !launched()) {
    check_ranks(options.ranks);
    if (isatty(STDOUT_FILENO)) setenv(terminal_mark, "1", 1);
    return run_mpirun(options.ranks, arguments_of(options));
  }
  if (speaks() && !options.quiet && !loaded.found.list().empty())
    fmt::print(stderr, "{}", loaded.found.text());
  std::optional<RunLock> lock;
  if (simulation.speaks) {
    refuse_foreign(simulation.folder);  // before the lock leaves its file there
    lock.emplace(simulation.folder);
    prepare_folder();
  }
  if (launched())
    prepare_mpi_environment();
  else
    prepare_mpi_alone();
  const parallel::Session session;
  const parallel::World world;
  simulation.threads = threads_of(options, loaded.contents, world.size());
  return simulate_and_report(loaded, simulation, world);
}

/// The checkpoint to go on from. @throws InputError where there is none.
std::filesystem::path find_checkpoint(const ResumeOptions& options) {
  if (!options.from.empty()) {
    if (std::filesystem::exists(options.from)) return options.from;
    const auto inside = std::filesystem::path(options.folder) / "checkpoints" / options.from;
    if (std::filesystem::exists(inside)) return inside;
    throw InputError(fmt::format("error: there is no checkpoint '{}'", options.from));
  }
  require_folder(options.folder);
  const auto all = checkpoints_of(options.folder);
  if (all.empty() && !std::filesystem::exists(std::filesystem::path(options.folder) / "case.resolved.toml"))
    throw InputError(fmt::format("error: {} holds no run\n   = help: `recoil run CASE -o {}` makes one there",
                                 options.folder, options.folder));
  if (all.empty() && std::filesystem::exists(std::filesystem::path(options.folder) / "summary.json"))
    throw InputError(fmt::format(
        "error: the run in {} has ended, and has left no checkpoint to go on from\n   = help: "
        "`recoil run CASE --end TIME -o DIR` runs it for longer; with [output.checkpoint] a run can go "
        "on beyond its end",
        options.folder));
  if (all.empty())
    throw InputError(
        fmt::format("error: {} holds no checkpoint to go on from\n   = help: a run leaves them with "
                    "[output.checkpoint] every-wall = \"10 min\", with --wall, and when it is stopped "
                    "by Ctrl-C, SIGTERM or SIGUSR1",
                    options.folder));
  return all.back();
}

}  // namespace

int run(const RunOptions& options) {
  watch_stop_signals();  // also while the run is set up: it stops after its first step
  SimulationOptions simulation;
  simulation.overrides = options.overrides;
  if (!options.end.empty()) simulation.overrides.push_back("time.end=" + options.end);
  LoadedCase loaded = load_case(options.file, simulation.overrides);
  // One process looks at all cells for all: where it refuses the case, the launcher ends the others.
  if (!loaded.found.has_errors() && speaks()) check_logic(loaded);
  if (loaded.too_large) throw EnvironmentError(loaded.found.text());
  loaded.found.throw_if_errors();
  simulation.folder =
      options.folder.empty() ? "runs/" + short_name(find_case_file(options.file)) : options.folder;
  return start(options, loaded, simulation,
               [&] { prepare_run_folder(simulation.folder, loaded, options.force); });
}

int resume(const ResumeOptions& options) {
  watch_stop_signals();
  SimulationOptions simulation;
  simulation.folder = options.folder;
  simulation.checkpoint = find_checkpoint(options);
  const CheckpointText then = checkpoint_text(BlockFile(simulation.checkpoint).head().text);
  simulation.overrides = then.overrides;
  simulation.overrides.insert(simulation.overrides.end(), options.overrides.begin(), options.overrides.end());
  if (!options.to.empty()) simulation.overrides.push_back("time.end=" + options.to);
  LoadedCase loaded =
      load_case((simulation.folder / "case.toml").string(), simulation.overrides, then.case_file);
  if (!loaded.found.has_errors()) check_expectations(loaded);
  loaded.found.throw_if_errors();
  if (const std::string why = refusal(then, describe(loaded, simulation.overrides)); !why.empty())
    throw InputError(why);
  if (!(then.time < loaded.contents.time.end))
    throw InputError(fmt::format(
        "error: the checkpoint is at {:.6g} us, and the run would end at {:.6g} us\n   = help: --to a later "
        "time, or --from an earlier checkpoint",
        then.time * 1e6, loaded.contents.time.end * 1e6));
  return start(options, loaded, simulation, [&] {
    if (!options.to.empty() || !options.overrides.empty()) write_resolved_case(simulation.folder, loaded);
  });
}

}  // namespace recoil::app
