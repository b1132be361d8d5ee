// SPDX-License-Identifier: MIT
#include "tools/common/signals.h"

#include <csignal>

namespace grove::detail {

std::atomic<bool> interrupted{false};
std::atomic<bool> checkpoint_asked{false};

namespace {

extern "C" void on_signal(int signal) {
  (signal == SIGUSR1 ? checkpoint_asked : interrupted) = true;
}

}  // namespace

void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGHUP, &action, nullptr);
  ::sigaction(SIGUSR1, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace grove::detail
