// SPDX-License-Identifier: MIT
// The ranks take their snapshots at different times, while nodes are in transit. *Claim:* no node
// is missed. *Proof.* SnapshotRequest, ReleaseCustody and AssignNodes reach a rank along the same
// path, in sending order.
// - *A node that one rank transferred to another* is either still in the sender's custody at the
//   sender's snapshot, or the lowest coordinator above both ranks sent the release before it
//   forwarded SnapshotRequest. In the second case a status from the receiver that covered the node
//   had reached that coordinator before. The receiver got SnapshotRequest later than that
//   coordinator, so at its snapshot it held the node or the node's descendants.
// - *A node assigned before SnapshotRequest* arrives at the rank before SnapshotRequest, because
//   each coordinator forwards assigned nodes at once.
//
// A node can be recorded twice, which does no harm.
//
// The rest of the proof is that of engine/local_checkpoints.cpp. The trees are counted before the
// snapshots, and nodes of later trees are omitted. The incumbent is read after all ranks have taken
// their snapshots and have sent the plans that they had found before.
#include "mpi/distributed_checkpoint.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <stdexcept>

#include "io/input_error.h"
#include "model/assert.h"

namespace grove::detail {

namespace {

constexpr auto kMaxPause = std::chrono::milliseconds(500);

}  // namespace

DistributedCheckpoint::DistributedCheckpoint(const Checkpoints& checkpoints, const Limits& limits,
                                             RunState& run, Transport& transport,
                                             ChildLinks& children)
    : checkpoints_(checkpoints),
      limits_(limits),
      run_(run),
      transport_(transport),
      children_(children),
      trees_(run.trees().count()) {
  children.broadcast(message::SnapshotRequest{});
}

// If writing fails, the previous checkpoint stays valid and the run continues.
template <class Write>
void DistributedCheckpoint::write(Write what) {
  if (!report_.failure.empty()) return;
  try {
    what();
  } catch (const InputError& error) {
    report_.failure = error.what();
  } catch (const std::bad_alloc&) {
    report_.failure = "not enough memory to write it";
  }
  if (!report_.failure.empty()) writer_.reset();
}

void DistributedCheckpoint::handle(const message::SnapshotTaken& gathered) {
  GROVE_CHECK(snapshots_taken_ < children_.count(), "each child takes one snapshot");
  evicted_bound_ = std::min(evicted_bound_, gathered.evicted_bound);
  if (++snapshots_taken_ < children_.count()) return;
  write([&] {
    writer_ = std::make_unique<CheckpointWriter>(checkpoints_.directory,
                                                 run_.checkpoint_header(trees_, evicted_bound_));
  });
  ask_next();
}

// Sends a heartbeat if none was sent recently. Without heartbeats, a rank that has sent its
// snapshot, or waits for SnapshotNext, would consider rank 0 unresponsive.
void DistributedCheckpoint::send_heartbeat() {
  if (limits_.now() - announced_at_ < kMaxPause) return;
  children_.broadcast(message::Heartbeat{});
  announced_at_ = limits_.now();
}

void DistributedCheckpoint::handle(message::SnapshotPart&& part) {
  GROVE_CHECK(asked_ >= 0 && asked_ < transport_.ranks(),
              "a part of a snapshot comes from a rank that was asked");
  send_heartbeat();
  write([&] {
    for (NodeRecord& node : part.nodes) {
      if (node.tree >= trees_) continue;
      writer_->add(std::move(node));
      ++report_.nodes;
    }
  });
  if (part.last)
    ask_next();
  else
    transport_.send(asked_, bytes_of(message::SnapshotNext{}, 0));
}

void DistributedCheckpoint::ask_next() {
  if (++asked_ < transport_.ranks()) {
    transport_.send(asked_, bytes_of(message::SnapshotNext{}, 0));
    return;
  }
  GROVE_CHECK(!done_, "a checkpoint ends once");
  write([&] { writer_->finish(); });
  report_.seconds = std::chrono::duration<double>(limits_.now() - begin_).count();
  run_.run_events().checkpoint(report_);
  done_ = true;
}

}  // namespace grove::detail
