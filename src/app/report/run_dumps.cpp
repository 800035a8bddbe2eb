#include "app/report/run_dumps.hpp"

#include <utility>

#include "core/error.hpp"
#include "format/vtkhdf.hpp"

namespace recoil::app {

RunDumps dumps_of(const std::filesystem::path& run) {
  RunDumps dumps;
  try {
    for (ChosenDump& dump : all_dumps(run))
      if (can_read_vtkhdf(dump.path))
        dumps.whole.push_back(std::move(dump));
      else
        dumps.damaged.push_back(std::move(dump.path));
  } catch (const InputError&) {
    return {};  // a run without fields
  }
  return dumps;
}

}  // namespace recoil::app
