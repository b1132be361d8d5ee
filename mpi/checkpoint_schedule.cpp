// SPDX-License-Identifier: MIT
#include "mpi/checkpoint_schedule.h"

#include "model/assert.h"

namespace grove::detail {

void CheckpointSchedule::update() {
  if (current_ && current_->is_done()) current_.reset();
  if (current_ || checkpoints_.directory.empty() || !enabled_) return;
  const bool is_last = run_.shared_bounds().over() && !wrote_last_;
  if (!is_last && (run_.shared_bounds().over() || !timer_.due())) return;
  wrote_last_ = is_last;
  current_.emplace(checkpoints_, limits_, run_, transport_, children_);
}

void CheckpointSchedule::abort() {
  GROVE_CHECK(in_progress(), "only a checkpoint in progress is aborted");
  run_.run_events().checkpoint({.failure = "a rank is unresponsive"});
  current_.reset();
  wrote_last_ = true;
}

}  // namespace grove::detail
