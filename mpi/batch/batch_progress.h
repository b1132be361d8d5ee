// SPDX-License-Identifier: MIT
// Progress of a batch and an estimate of the time left.
#pragma once

#include <limits>
#include <optional>

#include "batch/progress.h"
#include "batch/row.h"

namespace grove::detail::batch {

// State of a batch at one time. Instances that earlier runs of the batch finished count as done.
struct BatchState {
  int total = 0;
  int solved = 0;   // ended by itself with a plan, or proven infeasible
  int limited = 0;  // a limit was reached first
  int failed = 0;
  int under_way = 0;
  int groups = 1;          // groups of ranks
  double solving_s = 0;    // sum of the solve times of the instances done
  double under_way_s = 0;  // sum of the elapsed times of the instances in progress
  double elapsed_s = 0;    // time since the start of this run
  bool ending = false;     // no more instances are assigned, although some are left
  // Seconds left until the total time limit, after which no more instances are assigned.
  double closes_in_s = std::numeric_limits<double>::infinity();

  int done() const { return solved + limited + failed; }
  void count(const Row& row);
};

// Returns the estimated seconds until all instances are done (see progress.h), or nullopt if no
// instance is done yet.
std::optional<double> seconds_left(const BatchState& state);

// Returns the progress line, for example "41/135 done: 36 solved, 4 at a limit, 1 failed; 2:05
// elapsed, about 4:10 left"
ProgressText progress_text(const BatchState& state);

}  // namespace grove::detail::batch
