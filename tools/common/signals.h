// SPDX-License-Identifier: MIT
// Requests to a run that arrive as signals: stop, or write a checkpoint.
#pragma once

#include <atomic>

namespace grove::detail {

// Set by the first Ctrl-C, SIGTERM or SIGHUP after stop_on_signals().
extern std::atomic<bool> interrupted;

// Set by SIGUSR1; the code that writes the checkpoint resets it.
extern std::atomic<bool> checkpoint_requested;

// Makes SIGUSR1 request a checkpoint, even if the program was started with this signal blocked or
// ignored. By default SIGUSR1 ends the process. Therefore call it first in main(), so that a job
// script can send the signal at any time.
void accept_checkpoint_signal();

// Like accept_checkpoint_signal(). In addition, Ctrl-C, SIGTERM or SIGHUP sets `interrupted`, and
// the search stops. A second Ctrl-C ends the process. A second SIGTERM or SIGHUP does not, because
// batch systems send SIGTERM twice. SIGPIPE is ignored, so if the reader of the log ends (`| head`)
// the plan is still written.
void stop_on_signals();

}  // namespace grove::detail
