// SPDX-License-Identifier: MIT
// What signals ask of a run.
#pragma once

#include <atomic>

namespace grove::detail {

// Set by the first Ctrl-C, SIGTERM or hang-up after stop_on_signals().
extern std::atomic<bool> interrupted;

// Set by SIGUSR1, likewise; whoever writes the checkpoint resets it.
extern std::atomic<bool> checkpoint_asked;

// SIGUSR1 asks for a checkpoint. The first Ctrl-C, SIGTERM or hang-up ends the search; a second
// Ctrl-C has its usual effect (batch systems send SIGTERM twice, so that one has not). A reader of
// the log that goes away (`| head`) must not take the plan with it.
void stop_on_signals();

}  // namespace grove::detail
