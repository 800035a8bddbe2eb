#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace recoil::app {

/// One expectation of a case and what the run gave, as people read it.
struct VerifiedValue {
  std::string quantity, reference, source, ours, error, tolerance;
  bool pass = false;
  bool has_source = false;       // compared with something that comes from elsewhere
  double value = 0, target = 0;  // in `unit`; NaN: none. A truth counts as 1 or 0
  std::string unit, kind;        // "value", "at-most", "at-least" or "flag"
};

/// One case that was run.
struct VerifiedCase {
  std::string name, title, version;
  std::string problem;  // why there are no values; empty: there are
  int exit_code = 0;
  double cpu_s = 0;  // processor time
  long steps = 0, cells = 0;
  std::vector<VerifiedValue> values;
  std::vector<std::string> doubts;  // why the run is doubtful; empty: it is valid

  /// Of its values; a case that did not run to its end counts as one failure.
  long failures() const;
};

/// Reads what a run left. @returns a case with `problem` where summary.json is missing or torn.
VerifiedCase read_verified(const std::filesystem::path& run);

/// How many values, values against references, failures, and cases.
struct VerifyCount {
  long cases = 0, values = 0, references = 0, failures = 0;
};
VerifyCount count(const std::vector<VerifiedCase>& cases);

/// The table for people: one section a case.
/// @param overrides what was set in every case, as PATH=VALUE.
std::string verify_markdown(const std::vector<VerifiedCase>& cases,
                            const std::vector<std::string>& overrides = {});
/// One line a value.
std::string verify_csv(const std::vector<VerifiedCase>& cases);
std::string verify_json(const std::vector<VerifiedCase>& cases);

}  // namespace recoil::app
