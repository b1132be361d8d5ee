// SPDX-License-Identifier: MIT
// The checkpoints of a distributed search: their schedule, and the one in progress.
#pragma once

#include <optional>

#include "engine/checkpoint.h"
#include "engine/run_state.h"
#include "mpi/distributed_checkpoint.h"
#include "mpi/hierarchy_links.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail {

// Starts due checkpoints, one at a time. The last one is written when the search is over. One
// thread at a time.
class CheckpointSchedule {
 public:
  // All arguments must outlive this object.
  CheckpointSchedule(const Checkpoints& checkpoints, const Limits& limits, RunState& run,
                     Transport& transport, ChildLinks& children)
      : checkpoints_(checkpoints),
        limits_(limits),
        run_(run),
        transport_(transport),
        children_(children),
        timer_(checkpoints, limits) {}

  // Starts no checkpoint from now on. Called if the run is not restored completely.
  void disable() { enabled_ = false; }
  // Starts a due checkpoint if none is in progress.
  void update();
  bool in_progress() const { return current_.has_value(); }
  // Aborts the checkpoint in progress, which must exist. Afterwards no last checkpoint is written.
  void abort();

  // Handles a part of the checkpoint in progress. Ignores it if that checkpoint was aborted.
  void handle(const message::SnapshotTaken& taken) {
    if (current_) current_->handle(taken);
  }
  void handle(message::SnapshotPart&& part) {
    if (current_) current_->handle(std::move(part));
  }

 private:
  const Checkpoints& checkpoints_;
  const Limits& limits_;
  RunState& run_;
  Transport& transport_;
  ChildLinks& children_;
  CheckpointTimer timer_;
  std::optional<DistributedCheckpoint> current_;
  bool enabled_ = true;
  bool wrote_last_ = false;
};

}  // namespace grove::detail
