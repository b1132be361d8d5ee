// SPDX-License-Identifier: MIT
// Rows of a scaling study, one per simulated run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mpi/simulator/simulation.h"

namespace grove::detail {

// One simulated run compared with the run of a single rank.
struct ScalingRow {
  int ranks = 0;
  // Status of the solution, or "unfinished" if a limit was reached first; then only ranks, cost,
  // lower_bound and wall_s are set.
  std::string status;
  Cost cost = 0;  // -1: no plan
  Cost lower_bound = 0;
  double wall_s = 0;
  double speed_up = 0;
  double efficiency = 0;  // speed-up / ranks
  // Search overhead: nodes expanded by all ranks, seconds that all ranks together spent on that,
  // and the increase of each over the run of one rank, as a fraction of that run's value.
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
  double communication_share = 0;  // communication time as a fraction of the time of all ranks
  double coordinator_communication_share =
      0;                          // communication time as a fraction of the time of rank 0
  double coordinator_wait_s = 0;  // mean seconds from the arrival of a message to its handling
  // Load balance.
  double max_over_mean = 0;  // maximum / mean over ranks of the seconds spent on expansions
  double idle_share = 0;     // idle time as a fraction of the time of all workers
  double first_node_s = 0;   // mean time at which a rank's worker started its first node
  std::int64_t ranks_without_node = 0;
};

// Compares `run` with `alone`, the run of a single rank. If `alone` did not end, the fields that
// compare the two runs stay 0.
ScalingRow scaling_row(const SimulatedRun& run, const SimulatedRun& alone);

// The column names, and the values of a row: comma-separated, without a line end.
std::string scaling_header();
std::string csv_line(const ScalingRow& row);

}  // namespace grove::detail
