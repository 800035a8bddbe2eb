#include "config/section/output.hpp"

#include "config/declare/part.hpp"

namespace recoil::config {

Entries<Output> Output::keys() {
  return {{.name = "fields", .member = part_of<&Output::fields>(), .doc = "fields of the whole domain"},
          {.name = "history", .member = part_of<&Output::history>(), .doc = "sums over each body"},
          {.name = "checkpoint",
           .member = part_of<&Output::checkpoint>(),
           .doc = "files from which a run can go on"},
          {.name = "report",
           .member = &Output::report,
           .doc = "whether a finished run is shown in report.html, one page for the browser",
           .example = "false"}};
}

}  // namespace recoil::config
