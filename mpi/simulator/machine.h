// SPDX-License-Identifier: MIT
// The machine that a simulation takes for granted.
#pragma once

#include "mpi/polling.h"

namespace grove::detail {

// Messages as in LogGP (Alexandrov et al., SPAA 1995): whoever sends or receives one is busy for
// `message_cost` and the time its bytes take, one message after the other, and `latency` passes in
// between. A rank has a processor that searches and another that speaks, which looks at the network
// as looks.h says, or as soon as it has dealt with what it found there last.
struct Machine {
  double latency = 2e-6;             // seconds
  double bandwidth = 1e9;            // bytes per second, packing and unpacking included
  double message_cost = 2e-6;        // seconds
  double poll = kMaxPollInterval_s;  // seconds: the longest nap between two looks
  // A turn takes so many seconds per unit of its work (search/work.h), or, if 0, the processor time
  // that it really took here, with which no two runs are the same.
  double seconds_per_work = 0;
};

}  // namespace grove::detail
