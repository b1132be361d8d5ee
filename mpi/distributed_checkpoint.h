// SPDX-License-Identifier: MIT
// One checkpoint of a distributed search, while it is being written.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/checkpoint.h"
#include "engine/run_state.h"
#include "mpi/child_links.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail {

// All ranks look at their nodes while search goes on; then one after the other sends them. Why no
// node is missed: gathering.cpp. Of one thread.
class DistributedCheckpoint {
 public:
  // Tells all ranks, by way of the children of the top. All must outlive this.
  DistributedCheckpoint(const Checkpoints& checkpoints, const Limits& limits, RunState& run,
                        Transport& transport, ChildLinks& children);

  bool is_done() const { return done_; }

  void handle(const message::SnapshotTaken& gathered);
  void handle(message::SnapshotPart&& part);

 private:
  using Clock = Limits::Clock;

  void ask_next();
  void send_heartbeat();
  // Calls `what`, which may fail; then nothing more is written.
  template <class Write>
  void write(Write what);

  const Checkpoints& checkpoints_;
  const Limits& limits_;  // for the time
  RunState& run_;
  Transport& transport_;
  ChildLinks& children_;
  const Clock::time_point begin_ = limits_.now();
  Clock::time_point said_ = begin_;  // to all
  const std::int64_t trees_;         // that count as instantiated
  int looked_ = 0;                   // children
  Cost evicted_bound_ = kInfiniteCost;
  int asked_ = -1;  // the rank that sends
  bool done_ = false;
  std::unique_ptr<CheckpointWriter> writer_;  // null before, and once it has failed
  CheckpointReport report_;
};

}  // namespace grove::detail
