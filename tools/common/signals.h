// SPDX-License-Identifier: MIT
// What signals ask of a run.
#pragma once

#include <atomic>

namespace grove::detail {

// Set by the first Ctrl-C, SIGTERM or hang-up after stop_on_signals().
extern std::atomic<bool> interrupted;

// Set by SIGUSR1, likewise; whoever writes the checkpoint resets it.
extern std::atomic<bool> checkpoint_asked;

// From now on SIGUSR1 asks for a checkpoint, also if the program was started with this signal
// blocked or ignored: without that it ends the process. The first line of main(), so that a job
// script may send it at any time.
void accept_checkpoint_signal();

// As accept_checkpoint_signal(); and the first Ctrl-C, SIGTERM or hang-up ends the search; a second
// Ctrl-C has its usual effect (batch systems send SIGTERM twice, so that one has not). A reader of
// the log that goes away (`| head`) must not take the plan with it.
void stop_on_signals();

}  // namespace grove::detail
