// SPDX-License-Identifier: MIT
// A checkpoint of a distributed search while it is being written.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/checkpoint.h"
#include "engine/run_state.h"
#include "mpi/hierarchy_links.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail {

// All ranks take snapshots of their nodes while the search continues; then one rank after the other
// sends its snapshot to rank 0, which writes it. The proof that no node is missed is in
// distributed_checkpoint.cpp. One thread at a time.
class DistributedCheckpoint {
 public:
  // Requests the snapshots of all ranks, through the children of the top coordinator. All arguments
  // must outlive this object.
  DistributedCheckpoint(const Checkpoints& checkpoints, const Limits& limits, RunState& run,
                        Transport& transport, ChildLinks& children);

  bool is_done() const { return done_; }

  void handle(const message::SnapshotTaken& gathered);
  void handle(message::SnapshotPart&& part);

 private:
  using Clock = Limits::Clock;

  void ask_next();
  void send_heartbeat();
  // Calls `what`. After a failure later calls do nothing.
  template <class Write>
  void write(Write what);

  const Checkpoints& checkpoints_;
  const Limits& limits_;  // only used for its clock
  RunState& run_;
  Transport& transport_;
  ChildLinks& children_;
  const Clock::time_point begin_ = limits_.now();
  Clock::time_point announced_at_ = begin_;  // time of the last broadcast to all ranks
  const std::int64_t trees_;  // number of trees that the checkpoint records as instantiated
  int snapshots_taken_ = 0;   // number of children that have taken their snapshots
  Cost evicted_bound_ = kInfiniteCost;
  int asked_ = -1;  // rank that is sending its snapshot; -1: none yet
  bool done_ = false;
  std::unique_ptr<CheckpointWriter> writer_;  // nullptr before the start and after a failure
  CheckpointReport report_;
};

}  // namespace grove::detail
