#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace recoil::app {

inline constexpr double usual_report_mb = 10;

/// What was written.
struct WrittenReport {
  std::uintmax_t bytes = 0;
  std::vector<std::string> omissions;  // what did not fit, in words
  std::vector<std::string> damaged;    // files that cannot be read, in words
};

/// Writes one page that shows runs: a file that needs nothing else.
/// @param most_mb how large it may become; fields are stored less exactly and then left out to keep to it.
/// @throws InputError for a folder that holds no run, EnvironmentError where the disk refuses or the program
/// was built without the page.
WrittenReport write_report(const std::filesystem::path& file, const std::vector<std::filesystem::path>& runs,
                           double most_mb);

/// Writes report.html of a run that has ended, if its case wants it and the program has the page. What goes
/// wrong is told, but fails no run.
void leave_report(const std::filesystem::path& run, bool quiet);

}  // namespace recoil::app
