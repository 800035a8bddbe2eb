#pragma once

#include <chrono>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/load_case.hpp"
#include "app/run/checkpoint_folder.hpp"
#include "app/run/reporter.hpp"
#include "core/error.hpp"
#include "gauge/due.hpp"
#include "parallel/team.hpp"
#include "parallel/traffic.hpp"
#include "parallel/world.hpp"
#include "record/recorder.hpp"
#include "timestep/part_fragments.hpp"
#include "timestep/regrid.hpp"
#include "timestep/schemes.hpp"

namespace recoil::app {

struct SimulationOptions {
  std::filesystem::path folder;  // of the results; exists
  int threads = 1;
  Display display = Display::plain;
  bool speaks = true;
  bool verbose = false;                // where the time went, too
  double wall_limit = 0;               // s, after which the run stops with a checkpoint; 0: none
  std::filesystem::path checkpoint;    // to go on from; empty: from the start
  std::vector<std::string> overrides;  // that the case was read with
};

/// A run of a case: built from it or from a checkpoint, advanced step by step, and to be asked in between.
/// Every member function that is not const is collective.
template <int Dim>
class Simulation {
 public:
  /// @throws InputError, EnvironmentError.
  Simulation(const LoadedCase& loaded, const SimulationOptions& options, const parallel::World& world);

  const State<Dim>& state() const { return state_; }
  /// Length of the last step [s].
  double last_step() const { return dt_; }
  bool finished() const;
  /// One step, and what is recorded of it. @throws PhysicsError with a crash folder written.
  void advance();
  /// Writes a checkpoint where one is due.
  void save_if_due();
  void save();
  /// The end: last records, expectations, summary.json. @returns what was found; its exit is the exit code.
  Summary finish();
  /// Stops before the end, with a checkpoint. @param why for people.
  void stop(const std::string& why);

 private:
  /// Writes what is known of a failure, and passes it on.
  [[noreturn]] void fail(const PhysicsError& error);
  double wall() const;
  RunFacts facts() const;
  void tell_events();

  const LoadedCase& loaded_;
  const config::Case& case_;
  const SimulationOptions& options_;
  const parallel::World& world_;
  Reporter reporter_;
  parallel::Team team_;
  Engine engine_;
  State<Dim> state_;
  Scheme<Dim> scheme_;
  Refinement<Dim> refinement_;
  std::optional<Recorder<Dim>> recorder_;
  Due checkpoint_due_;
  double dt_ = 0, cells_ = 0, saved_at_ = 0;  // s, cells with matter, s of wall time
  long first_step_ = 0;                       // of this process's life, and what it had sent by then
  parallel::Traffic sent_before_;
  std::chrono::steady_clock::time_point begun_;
  std::clock_t worked_;
};

/// Computes a case to its end, or until it is asked to stop. Collective.
/// @returns the exit code: 0, 5 where an expectation failed, 6 where the verdict is doubtful, 75 where it was
/// stopped with a checkpoint.
/// @throws PhysicsError with a crash folder written, EnvironmentError, InputError.
template <int Dim>
int simulate(const LoadedCase& loaded, const SimulationOptions& options, const parallel::World& world);

}  // namespace recoil::app
