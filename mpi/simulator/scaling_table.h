// SPDX-License-Identifier: MIT
// What a scaling study says of simulated runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mpi/simulator/simulation.h"

namespace grove::detail {

// One run beside the one of a single rank. Values.
struct ScalingRow {
  int ranks = 0;
  std::string status;  // of the answer; "unfinished": limits struck, only what was counted is set
  Cost cost = 0;       // -1: no plan
  Cost lower_bound = 0;
  double wall_s = 0;
  double speed_up = 0;
  double efficiency = 0;  // speed-up / ranks
  // Search overhead: what all ranks expanded, and how long that took them together; and how much
  // more that is than with one rank, as a share of it.
  std::int64_t nodes = 0;
  double nodes_overhead = 0;
  double expanding_s = 0;
  double expanding_overhead = 0;
  // Communication overhead.
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
  double messages_per_node = 0;
  double bytes_per_node = 0;
  std::int64_t nodes_sent = 0;
  double talking_share = 0;              // of the time of all ranks
  double coordinator_talking_share = 0;  // of the time of rank 0
  double coordinator_wait_s = 0;         // of a message, between its arrival and its turn; the mean
  // Load balance.
  double max_over_mean = 0;  // seconds of expanding, over ranks
  double idle_share = 0;     // of the time of all workers
  double first_node_s = 0;   // when a rank's worker began with its first node; the mean
  std::int64_t ranks_without_node = 0;
};

// `alone`: the run of one rank.
ScalingRow scaling_row(const SimulatedRun& run, const SimulatedRun& alone);

// The columns' names, and a row of their values; with commas, in one line without its end.
std::string scaling_header();
std::string csv_line(const ScalingRow& row);

}  // namespace grove::detail
