#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/launch.hpp"
#include "app/load_case.hpp"
#include "app/run_folder.hpp"
#include "app/simulation.hpp"
#include "core/error.hpp"

namespace recoil::app {

namespace {

/// Set for the processes of a run with -n that was started at a terminal.
constexpr const char* terminal_mark = "RECOIL_TERMINAL";

int default_threads(const config::Case& c, int ranks) {
  if (c.domain.geometry == config::Geometry::line) return 1;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / ranks);
}

/// Under mpirun, whose processes always write to something like a terminal, only -n says whether there is
/// one.
Display display_of(const RunOptions& options) {
  if (options.quiet) return Display::none;
  const bool terminal = launched() ? std::getenv(terminal_mark) != nullptr : isatty(STDOUT_FILENO) == 1;
  return !options.plain && terminal ? Display::live : Display::plain;
}

/// The command line of one of the processes under mpirun: ours without -n.
std::vector<std::string> arguments_of(const RunOptions& o) {
  std::vector<std::string> words{"run", o.file};
  if (!o.folder.empty()) words.insert(words.end(), {"-o", o.folder});
  if (o.threads > 0) words.insert(words.end(), {"-j", std::to_string(o.threads)});
  for (const std::string& change : o.overrides) words.insert(words.end(), {"--set", change});
  if (!o.end.empty()) words.insert(words.end(), {"--end", o.end});
  if (o.force) words.push_back("--force");
  if (o.quiet) words.push_back("--quiet");
  if (o.verbose) words.push_back("--verbose");
  if (o.plain) words.push_back("--plain");
  return words;
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

int run(const RunOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (!options.end.empty()) overrides.push_back("time.end=" + options.end);
  LoadedCase loaded = load_case(options.file, overrides);
  if (!loaded.found.has_errors()) check_logic(loaded);
  loaded.found.throw_if_errors();
  if (options.ranks > 1 && !launched()) {
    if (isatty(STDOUT_FILENO)) setenv(terminal_mark, "1", 1);
    become_mpirun(options.ranks, arguments_of(options));
  }
  if (speaks() && !options.quiet && !loaded.found.list().empty())
    fmt::print(stderr, "{}", loaded.found.text());

  SimulationOptions simulation;
  simulation.folder =
      options.folder.empty() ? "runs/" + short_name(find_case_file(options.file)) : options.folder;
  simulation.speaks = speaks();
  simulation.display = display_of(options);
  simulation.verbose = options.verbose;
  if (simulation.speaks) prepare_run_folder(simulation.folder, loaded, options.force);
  prepare_mpi_environment();
  const parallel::Session session;
  const parallel::World world;
  simulation.threads = options.threads > 0 ? options.threads : default_threads(loaded.contents, world.size());
  return simulate_together(loaded, simulation, world);
}

}  // namespace recoil::app
