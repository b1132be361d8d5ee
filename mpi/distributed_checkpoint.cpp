// SPDX-License-Identifier: MIT
// The ranks do not look at the same moment, and nodes travel. Yet none is missed. Gather comes to a
// rank by the same way as the releases from custody and what is entrusted to it, in order. So a
// node that one rank gave to another is still in its custody when it looks; or the release was sent
// before Gather was, by the coordinator that is nearest above both: because a status that covered
// the node had come from the receiver by then, which heard of Gather later than that coordinator,
// and so held the node, or what it led to, when it looked. What was entrusted before Gather comes
// to a rank before it, for a coordinator passes on at once what is entrusted to it. A node seen
// twice does no harm.
//
// The rest is as in engine/local_checkpoints.cpp: trees are counted before anybody looks, nodes of
// later ones left out, and the incumbent is asked for when all have looked and said what plans they
// had found by then.
#include "mpi/distributed_checkpoint.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <stdexcept>

#include "io/input_error.h"

namespace grove::detail {

namespace {

constexpr auto kLongestPause = std::chrono::milliseconds(500);

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

// The one before it stands if this one fails, and the run goes on.
template <class Write>
void DistributedCheckpoint::write(Write what) {
  if (!report_.failure.empty()) return;
  try {
    what();
  } catch (const InputError& error) {
    report_.failure = error.what();
  } catch (const std::bad_alloc&) {
    report_.failure = "there is no memory left to write it";
  }
  if (!report_.failure.empty()) writer_.reset();
}

void DistributedCheckpoint::handle(const message::SnapshotTaken& gathered) {
  evicted_bound_ = std::min(evicted_bound_, gathered.evicted_bound);
  if (++looked_ < children_.count()) return;
  write([&] {
    writer_ = std::make_unique<CheckpointWriter>(checkpoints_.directory,
                                                 run_.checkpoint_header(trees_, evicted_bound_));
  });
  ask_next();
}

// Who has sent its part, or is still to be asked, would take rank 0 for one that stands still.
void DistributedCheckpoint::send_heartbeat() {
  if (limits_.now() - said_ < kLongestPause) return;
  children_.broadcast(message::Heartbeat{});
  said_ = limits_.now();
}

void DistributedCheckpoint::handle(message::SnapshotPart&& part) {
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
  write([&] { writer_->finish(); });
  report_.seconds = std::chrono::duration<double>(limits_.now() - begin_).count();
  run_.announcements().checkpoint(report_);
  done_ = true;
}

}  // namespace grove::detail
