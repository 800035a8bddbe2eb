#pragma once

#include <functional>

namespace recoil::app {

/// Exit codes that scripts may rely on.
enum ExitCode : int {
  exit_finished = 0,
  exit_our_bug = 1,
  exit_bad_input = 2,
  exit_numerical_failure = 3,
  exit_environment = 4,
  exit_expectation_failed = 5,
  exit_doubtful = 6,
  exit_stopped = 75  // as asked, and `recoil resume` goes on
};

/// Whether a run with this exit code came to its end, so that its results may be compared.
constexpr bool has_results(int code) {
  return code == exit_finished || code == exit_expectation_failed || code == exit_doubtful;
}

/// The whole program: reads the command line, carries it out, returns the exit code. Throws nothing.
int command_line(int argc, const char* const* argv);

/// Calls `body`; what it throws is printed and becomes its exit code. The one place where errors get theirs.
int report_errors(const std::function<int()>& body);

}  // namespace recoil::app
