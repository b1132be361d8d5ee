// SPDX-License-Identifier: MIT
// How far a batch is, and how long it will take.
#pragma once

#include <limits>
#include <optional>

#include "batch/progress.h"
#include "batch/row.h"

namespace grove::detail::batch {

// A batch at one moment. Instances that earlier runs finished count as done.
struct BatchState {
  int total = 0;
  int solved = 0;   // before any limit, or proven infeasible
  int limited = 0;  // a limit struck first
  int failed = 0;
  int under_way = 0;
  int groups = 1;          // of ranks
  double solving_s = 0;    // what the instances done took, summed
  double under_way_s = 0;  // for how long those under way have been, summed
  double elapsed_s = 0;    // since this run began
  bool ending = false;     // nothing more is handed out, though there is more
  // Until nothing more is handed out, whatever is left.
  double closes_in_s = std::numeric_limits<double>::infinity();

  int done() const { return solved + limited + failed; }
  void count(const Row& row);
};

// How long until all is done, see progress.h; none before the first instance is.
std::optional<double> seconds_left(const BatchState& state);

// "41/135 done: 36 solved, 4 at a limit, 1 failed; 2:05 gone, about 4:10 left"
ProgressText progress_text(const BatchState& state);

}  // namespace grove::detail::batch
