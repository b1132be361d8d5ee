// SPDX-License-Identifier: MIT
#include "signals.h"

#include <csignal>

namespace grove {

std::atomic<bool> interrupted{false};

namespace {

extern "C" void on_signal(int) {
  interrupted = true;
}

}  // namespace

void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace grove
