#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "config/case.hpp"
#include "record/balance/budget.hpp"
#include "record/events.hpp"
#include "record/fragment_table.hpp"
#include "record/quantities.hpp"
#include "record/validity.hpp"
#include "state/averaged_states.hpp"

namespace recoil {

/// What the recorder is told.
struct RunFacts {
  std::string version;
  int exit = 0;  ///< in place of 0 come 3 of a stopped run, 5 of a failed expectation, 6 of a doubtful run
  double wall_s = 0;                         ///< of the time loop
  double cpu_s = 0;                          ///< of all processes and threads, in the time loop
  std::vector<config::Expectation> expect;   ///< beyond those of the case, of expected.toml
  const AveragedStates* averaged = nullptr;  ///< null: bodies' shares are not known
};

/// The main column of a gauge in short.
struct GaugeSummary {
  std::string name, column, unit;
  double to_unit = 1;
  Peak peak;           ///< SI
  double arrival = 0;  ///< s
};

/// The contents of summary.json. Complete on rank 0; elsewhere only `exit` and `passed`.
struct Summary {
  std::string version, case_name;
  int exit = 0;
  bool passed = true;  ///< every expectation
  Verdict verdict;     ///< on rank 0
  double time = 0;     ///< s
  long steps = 0;
  std::int64_t cells = 0;  ///< with matter, at the end
  double cell_steps = 0;   ///< cells with matter, summed over the steps
  double wall_s = 0, cpu_s = 0,
         rate = 0;                 ///< since the start or the resumption: s, s; million cell stages a second
  std::vector<Drift> budgets;      ///< of `total`, then of every deformable body
  std::vector<CentreOff> centres;  ///< of every deformable body
  std::vector<std::string> turns;  ///< axes of angular momentum; none where there is none
  std::string turning_unit;
  std::vector<Turning> turning;  ///< in the order of `budgets`
  std::vector<GaugeSummary> gauges;
  std::vector<Event> events;
  std::vector<BodyFragments> fragments;  // at the end
  std::vector<std::pair<std::string, std::int64_t>> floors;
  std::vector<CheckResult> expect;
};

/// Writes summary.json, in one step. @throws EnvironmentError.
void write_summary(const std::filesystem::path& path, const Summary& summary);

/// How a run stands, for `recoil status` and the live line.
struct Status {
  std::string state;                 ///< "running", "finished", "failed", "stopped"
  double time = 0, end = 0, dt = 0;  ///< s
  long steps = 0;
  double wall_s = 0, left_s = 0;  ///< s, left: estimated
  std::vector<Drift> budgets;
};

/// Writes status.json, in one step. @throws EnvironmentError.
void write_status(const std::filesystem::path& path, const Status& status);

}  // namespace recoil
