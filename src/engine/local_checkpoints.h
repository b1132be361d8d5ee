// SPDX-License-Identifier: MIT
// The checkpoints of a run in one process.
#pragma once

#include <mutex>

#include "engine/checkpoint.h"
#include "engine/checkpoints.h"
#include "engine/local_nodes.h"
#include "engine/run_state.h"

namespace grove::detail {

// Writes them. May be used from any thread.
class LocalCheckpoints {
 public:
  // All must outlive this.
  LocalCheckpoints(const SolveOptions& options, const Limits& limits, RunState& run,
                   LocalNodes& nodes)
      : options_(options),
        limits_(limits),
        run_(run),
        nodes_(nodes),
        timer_(options.checkpoints, limits) {}

  // Writes one if it is due and nobody else is at it. To be called between turns.
  void write_if_due();
  // At the end of the run.
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

// Makes the run and its nodes what they were. False if a limit struck: then there is nothing to
// search.
bool restore(CheckpointReader& checkpoint, const Instance& instance, RunState& run,
             LocalNodes& nodes);

}  // namespace grove::detail
