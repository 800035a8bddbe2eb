#pragma once

namespace recoil::app {

/// From here on SIGINT, SIGTERM, SIGUSR1 and, unless it is ignored (nohup), SIGHUP ask the run to stop after
/// the step in hand; a second SIGINT ends the process at once, as usual. A pipe without a reader does not end
/// it.
void watch_stop_signals();

/// Whether one of them has come. Of this process only.
bool stop_requested();

}  // namespace recoil::app
