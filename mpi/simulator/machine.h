// SPDX-License-Identifier: MIT
// Parameters of the simulated machine.
#pragma once

#include "mpi/polling.h"

namespace grove::detail {

// Messages follow LogGP (Alexandrov et al., SPAA 1995). A rank that sends or receives a message is
// busy for `message_cost` plus the time for its bytes, one message after the other. `latency`
// passes between sending and receiving. A rank has one processor that searches and one that
// communicates. The latter polls the network as in polling.h, or as soon as it has handled the
// messages of the last poll.
struct Machine {
  double latency = 2e-6;             // seconds
  double bandwidth = 1e9;            // bytes per second, serialization included
  double message_cost = 2e-6;        // seconds
  double poll = kMaxPollInterval_s;  // seconds: maximum interval between two polls
  // Seconds that a work item takes per unit of its work (search/work.h). 0: a work item takes the
  // processor time that it really took here; then no two runs are the same.
  double seconds_per_work = 0;
};

}  // namespace grove::detail
