#pragma once

namespace recoil::app {

/// From here on SIGINT, SIGTERM, SIGUSR1 and, unless it is ignored (nohup), SIGHUP ask to stop: a run after
/// the step in hand, a command with many runs after those in hand have stopped. A second SIGINT ends the
/// process at once, as usual. A pipe without a reader does not end it.
void watch_stop_signals();

/// Whether one of them has come. Of this process only.
bool stop_requested();

}  // namespace recoil::app
