// SPDX-License-Identifier: MIT
#include "tools/common/signals.h"

#include <csignal>
#include <initializer_list>

namespace grove::detail {

std::atomic<bool> interrupted{false};
std::atomic<bool> checkpoint_requested{false};

namespace {

extern "C" void on_signal(int signal) {
  (signal == SIGUSR1 ? checkpoint_requested : interrupted) = true;
}

}  // namespace

namespace {

// Unblocks signals. A signal that is already pending is delivered now.
void unblock(std::initializer_list<int> signals) {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int signal : signals) ::sigaddset(&set, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

void handle(int signal, unsigned flags) {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(flags);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void accept_checkpoint_signal() {
  handle(SIGUSR1, SA_RESTART);
  unblock({SIGUSR1});
}

void stop_on_signals() {
  accept_checkpoint_signal();
  handle(SIGINT, SA_RESETHAND);
  handle(SIGTERM, SA_RESTART);
  handle(SIGHUP, SA_RESTART);
  std::signal(SIGPIPE, SIG_IGN);
  unblock({SIGINT, SIGTERM, SIGHUP});
}

}  // namespace grove::detail
