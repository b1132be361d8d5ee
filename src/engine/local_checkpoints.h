// SPDX-License-Identifier: MIT
// Checkpoints of a run in one process.
#pragma once

#include <mutex>

#include "engine/checkpoint.h"
#include "engine/checkpoints.h"
#include "engine/live_nodes.h"
#include "engine/run_state.h"

namespace grove::detail {

// Writes the checkpoints of a run. write_if_due() is thread-safe.
class LocalCheckpoints {
 public:
  // All arguments must outlive this object.
  LocalCheckpoints(const SolveOptions& options, const Limits& limits, RunState& run,
                   LocalNodes& nodes)
      : options_(options),
        limits_(limits),
        run_(run),
        nodes_(nodes),
        timer_(options.checkpoints, limits) {}

  // Writes a checkpoint if one is due and no other thread is writing one. Must be called between
  // work items.
  void write_if_due();
  // Writes the last checkpoint. Must be called after the workers have stopped.
  void write_last();

 private:
  void write();

  const SolveOptions& options_;
  const Limits& limits_;
  RunState& run_;
  LocalNodes& nodes_;
  std::mutex mutex_;
  CheckpointTimer timer_;
};

// Restores the run and its nodes. Returns false if a limit was reached before that was complete;
// the run must then not search.
bool restore(CheckpointReader& checkpoint, const Instance& instance, RunState& run,
             LocalNodes& nodes);

}  // namespace grove::detail
