// SPDX-License-Identifier: MIT
// Requests to a run by signals.
#pragma once

#include <atomic>

namespace grove::detail {

// Set by the first Ctrl-C, SIGTERM or SIGHUP after stop_on_signals().
extern std::atomic<bool> interrupted;

// Set by SIGUSR1; the code that writes the checkpoint resets it.
extern std::atomic<bool> checkpoint_requested;

// From now on SIGUSR1 requests a checkpoint, even if the program was started with this signal
// blocked or ignored. Without this call SIGUSR1 ends the process. Call it first in main(), so that
// a job script may send the signal at any time.
void accept_checkpoint_signal();

// Like accept_checkpoint_signal(). In addition the first Ctrl-C, SIGTERM or SIGHUP ends the search.
// A second Ctrl-C has its default effect; a second SIGTERM has not, because batch systems send it
// twice. A closed pipe of the log (`| head`) does not end the process, so the plan is still
// written.
void stop_on_signals();

}  // namespace grove::detail
