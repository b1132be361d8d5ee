// SPDX-License-Identifier: MIT
// A checkpoint is written while other threads search, in this order: count the trees, take a
// snapshot of all nodes at one time, read the incumbent.
//
// Claim: every plan is in a written node, or in a tree not counted, or costs at least the bound of
// an evicted node, or costs at least as much as the incumbent. Proof: a node disappears only after
// the plan that it led to was posted, or because the incumbent pruned it. The incumbent is read
// after the snapshot, so it costs at most as much as the posted plan and as the incumbent that
// pruned the node. Nodes of trees instantiated after the count are omitted, because a resumed run
// instantiates these trees again.
#include "engine/local_checkpoints.h"

#include <chrono>
#include <new>

#include "io/input_error.h"

namespace grove::detail {

void LocalCheckpoints::write_if_due() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock && timer_.due()) write();
}

void LocalCheckpoints::write_last() {
  if (!options_.checkpoints.directory.empty()) write();
}

void LocalCheckpoints::write() {
  const Limits::Clock::time_point begin = limits_.now();
  CheckpointReport report;
  try {
    const std::int64_t trees = run_.trees().count();
    const Frontier::Snapshot snapshot = nodes_.frontier.snapshot();
    CheckpointWriter writer(options_.checkpoints.directory,
                            run_.checkpoint_header(trees, snapshot.evicted_bound));
    for (const NodePtr& node : snapshot.live) {
      if (node->tree().number >= trees) continue;
      writer.add(record_of(*node));
      ++report.nodes;
    }
    writer.finish();
  } catch (const InputError& error) {  // the previous checkpoint remains, and the run continues
    report.failure = error.what();
  } catch (const std::bad_alloc&) {
    report.failure = "not enough memory to write it";
  }
  report.seconds = std::chrono::duration<double>(limits_.now() - begin).count();
  run_.run_events().checkpoint(report);
}

bool restore(CheckpointReader& checkpoint, const Instance& instance, RunState& run,
             LocalNodes& nodes) {
  const auto roots = run.restore(checkpoint.header());
  if (!roots) return false;
  while (const auto next = checkpoint.next())
    nodes.push(node_of(*next, roots->at(next->tree), instance));
  nodes.frontier.record_evicted_bound(checkpoint.header().evicted_bound);
  run.restored();
  return true;
}

}  // namespace grove::detail
