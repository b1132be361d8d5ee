// SPDX-License-Identifier: MIT
// The checkpoints of a run in one process.
#pragma once

#include <mutex>

#include "grove/engine/central_ledger.h"
#include "grove/engine/checkpoint.h"
#include "grove/engine/checkpoints.h"
#include "grove/engine/local_nodes.h"

namespace grove {

// Writes them. May be used from any thread.
class LocalCheckpoints {
 public:
  // All must outlive this.
  LocalCheckpoints(const SolveOptions& options, CentralLedger& ledger, LocalNodes& nodes)
      : options_(options), ledger_(ledger), nodes_(nodes), timer_(options.checkpoints) {}

  // Writes one if it is due and nobody else is at it. To be called between turns.
  void write_if_due();
  // At the end of the run.
  void write_last();

 private:
  void write();

  const SolveOptions& options_;
  CentralLedger& ledger_;
  LocalNodes& nodes_;
  std::mutex mutex_;
  CheckpointTimer timer_;
};

// Makes the ledger and the nodes what they were. False if a limit struck: then there is nothing to
// search.
bool restore(CheckpointReader& checkpoint, const Instance& instance, CentralLedger& ledger,
             LocalNodes& nodes);

}  // namespace grove
