#include "app/run/stop_request.hpp"

#include <csignal>
#include <initializer_list>

namespace recoil::app {

namespace {

volatile std::sig_atomic_t requested = 0;

extern "C" void take_note(int signal) {
  requested = 1;
  if (signal == SIGINT) std::signal(SIGINT, SIG_DFL);
}

}  // namespace

void watch_stop_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, take_note);
  if (std::signal(SIGHUP, take_note) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  std::signal(SIGPIPE, SIG_IGN);
}

bool stop_requested() { return requested != 0; }

}  // namespace recoil::app
