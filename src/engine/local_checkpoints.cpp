// SPDX-License-Identifier: MIT
// Others work on meanwhile. The trees are counted first, then the nodes are looked at, all at one
// moment, then the incumbent. So every plan is in a node that is written, or costs at least the
// bound of what was given up, or is in a tree not counted, or costs at least what the incumbent
// does, for that was posted before the node that led to it, or was pruned by it, was gone. Nodes of
// trees that came in between are left out: these trees will come again.
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
  } catch (const InputError& error) {  // the one before it stands; the run goes on
    report.failure = error.what();
  } catch (const std::bad_alloc&) {
    report.failure = "there is no memory left to write it";
  }
  report.seconds = std::chrono::duration<double>(limits_.now() - begin).count();
  run_.announcements().checkpoint(report);
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
