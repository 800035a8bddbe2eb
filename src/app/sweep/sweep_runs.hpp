#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "app/study/child_runs.hpp"
#include "app/sweep/condition.hpp"
#include "app/sweep/sweep_table.hpp"

namespace recoil::app {

/// What a sweep looks for in its runs.
struct SweepQuestion {
  std::vector<std::string> quantities;  // none: all that a run has
  Condition condition;                  // no quantity: none
};

/// The runs of a sweep: computed several at a time, or taken from their folders where they are finished, and
/// put into one table.
class SweepRuns {
 public:
  SweepRuns(std::filesystem::path case_file, std::filesystem::path folder, SweepQuestion question, int jobs);

  /// One more run. @param values of all keys, as texts. @returns its number.
  /// @throws InputError for a case that cannot be computed with them.
  std::size_t add(const std::vector<SweptKey>& keys, const std::vector<std::string>& values);
  /// Computes what was added since the last call, and prints a line for each.
  /// @returns false: a request to stop came before all were done.
  /// @throws InputError for a quantity that the runs do not have.
  bool compute();
  /// What has become of the runs then.
  std::string told_stopped() const;

  /// 0, or the exit code of the last run without results.
  int worst() const { return worst_; }
  /// Whether run n has results, and what the condition says of it.
  bool has_results(std::size_t n) const { return results_[n].problem.empty(); }
  const std::string& problem(std::size_t n) const { return results_[n].problem; }
  bool holds(std::size_t n) const { return holds_.contains(n); }

  /// Number of runs that had been finished before.
  std::size_t reused() const;
  /// All runs, in the order of their values along the keys.
  SweepTable table(std::string title, std::vector<SweptKey> keys) const;
  /// Positions of the columns that are shown to people: those that were asked for, or the peaks of gauges.
  std::vector<std::size_t> shown() const { return shown_; }

 private:
  void compute_one(std::size_t n, std::size_t of);
  void take(std::size_t n);
  void choose_columns(const RunQuantities& run);
  double number(const RunQuantities& run, const SweepColumn& column) const;

  std::filesystem::path case_file_, folder_;
  SweepQuestion question_;
  int jobs_;
  std::vector<ChildRun> runs_;
  std::vector<ChildResult> results_;
  std::vector<std::vector<std::string>> values_;
  std::vector<std::vector<double>> numbers_;
  std::set<std::size_t> holds_;
  std::set<std::string> names_;  // of folders
  std::vector<SweepColumn> columns_;
  std::vector<std::size_t> shown_;
  std::filesystem::path case_folder_;
  std::size_t computed_ = 0, told_ = 0;
  int worst_ = 0;
  std::mutex speaking_;
};

}  // namespace recoil::app
