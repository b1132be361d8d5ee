// SPDX-License-Identifier: MIT
// Parameters of the simulated machine.
#pragma once

#include "mpi/polling.h"

namespace grove::detail {

// Messages follow LogGP (Alexandrov et al., SPAA 1995). Sending or receiving a message occupies the
// rank's communication processor for `message_cost` plus the time for the bytes, one message after
// the other. `latency` passes between sending and receiving. Each rank has one processor that
// searches and one that communicates. The communication processor polls the network as in
// polling.h, but not before it has handled the messages of the last poll.
struct Machine {
  double latency = 2e-6;             // seconds
  double bandwidth = 1e9;            // bytes per second, including serialization
  double message_cost = 2e-6;        // seconds
  double poll = kMaxPollInterval_s;  // seconds: maximum interval between two polls
  // Seconds that a work item takes per unit of effort (model/effort.h). 0: a work item takes the
  // processor time that it took in the simulation, so simulations are not repeatable.
  double seconds_per_work = 0;
};

}  // namespace grove::detail
