#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/load_case.hpp"
#include "app/report/report_page.hpp"
#include "core/error.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

int report(const ReportOptions& o) {
  if (!(o.most_mb > 0)) throw InputError("--max-mb is not above zero\n   = help: --max-mb 10");
  const std::vector<fs::path> runs(o.folders.begin(), o.folders.end());
  for (const fs::path& run : runs) require_folder(run);
  fs::path file = o.file;
  if (file.empty()) file = runs.size() == 1 ? runs.front() / "report.html" : fs::path("report.html");
  if (const std::string suffix = file.extension().string(); suffix != ".html" && suffix != ".htm")
    throw InputError(
        fmt::format("a report cannot be written as '{}': it is a page for the browser\n   = help: end its "
                    "name in .html; browsers print it as a PDF",
                    file.filename().string()));
  const WrittenReport written = write_report(file, runs, o.most_mb);
  fmt::print("{}  {:.2f} MB\n", file.string(), static_cast<double>(written.bytes) * 1e-6);
  for (const std::string& line : written.damaged)
    fmt::print(stderr, "warning: {}\n   = help: the page does without it; run the case again for it\n", line);
  for (const std::string& line : written.omissions)
    fmt::print("  {}; --max-mb {:.0f} would show more\n", line, 4 * std::max(o.most_mb, 1.0));
  return 0;
}

}  // namespace recoil::app
