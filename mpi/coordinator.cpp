// SPDX-License-Identifier: MIT
// Protocol of the distributed search, and proof that its lower bound is valid. The ranks hold the
// nodes of one search and transfer them to each other. The coordinator holds the global bounds.
// With many ranks, sub-coordinators (hierarchy.h) stand between the ranks and the coordinator; they
// merge messages on the way up and distribute messages on the way down. Messages with the same
// sender and receiver arrive in sending order. No other order is guaranteed.
//
// *Invariant (lower bound).* At every moment, each node that may still lead to a plan is covered by
// the latest status that the coordinator holds of some child, or by nodes that it has assigned to a
// child and not yet seen covered, or by a tree that is not yet instantiated. For a child that is a
// rank:
// - *Own nodes.* The status covers the nodes in its frontier, open or taken. A worker completes a
//   node only after it has pushed the children and posted a plan that the node led to. A rank sends
//   the plans posted before a status no later than the status. So the coordinator knows the plan
//   when it learns that the node is gone.
// - *Custody.* A rank that transfers nodes keeps them taken. The receiver pushes them and then
//   reports this in a status, which covers them. When the coordinator has processed that status, it
//   releases the sender, whose later statuses omit the nodes. (Without custody, the minimum of the
//   bounds of all ranks would miss nodes in transit.)
// - *Assigned nodes* are covered by the coordinator until the status that reports them pushed.
// - *Nodes never pushed* were pruned by an incumbent that GlobalBounds has checked.
//
// Hence min(latest statuses, assigned nodes, next tree) is a lower bound on all plans that were not
// pruned, whatever the message delays. A rank that is silent for long only keeps the bound low.
//
// *Sub-coordinators.* The group of a coordinator is the set of ranks below it. *Claim:* at every
// moment, the minimum over the latest statuses and the assigned nodes that one coordinator holds
// covers every node of its group, and every node that a rank of its group has in custody. *Proof.*
// For level 1 this is the argument above: a node that comes from another group or goes there is in
// the custody of some rank, or covered by a status already processed. For a higher level:
// - A status from a sub-coordinator is its own minimum at one time, so it covers the nodes that its
//   group held at that time. A node that its group holds later comes from one of three sources:
//   from a node that the status covers; from nodes assigned to the group since, which the
//   coordinator above covers until a status reports that they have arrived; or from another group,
//   in which a rank still has the node in custody.
// - The lowest coordinator above both the sender and the receiver of a batch releases the batch. It
//   does so when it has processed a status of the receiver's group that reports the batch as
//   received. That status covers the batch, because each coordinator on the way up forwards the
//   report in the status that covers the batch, or in a later one. The release then travels down to
//   the sender. So this coordinator, and those above it, process the first status without the batch
//   from the sender's group after the status that covers the batch on the receiver's side. Statuses
//   sent upwards in between cover both.
// - Plans travel up along the same path. A sub-coordinator forwards each plan at once, unless an
//   incumbent that GlobalBounds has checked is at least as good. Therefore a plan still arrives
//   before the first status without the node that led to it.
//
// *Termination.* By the same argument, no node is live and no batch is in transit if no latest
// status reports a live node and no assigned nodes are in transit. No other termination test is
// needed.
//
// *Restart.* If no node is live but nodes were evicted because memory was short, all ranks forget
// their evicted bounds, and the roots are pushed again. A rank can receive nodes from a rank that
// has already restarted before it receives Restart itself. Therefore a batch carries its epoch, and
// a rank defers a batch of a later epoch. Until a rank's status has the new epoch, its nodes count
// as unknown. The epoch of a group is the lowest epoch of its ranks.
//
// *Learned bounds* are sent from rank to rank (bound_broadcast.h). A learned bound is never a node
// and is valid on every rank (search/learned_bounds.cpp). No rank waits for one or replies to one.
//
// *Remote pricing.* Rank 0 computes the Lagrangian bound and also searches its nodes. It requests
// subproblem values under its multipliers from other ranks. Each request is for some of the agents;
// a rank gets the next request after it has replied. Rank 0 drops a reply that is late or has other
// multipliers (remote_pricing.cpp), and computes missing values itself. Therefore no part of this
// protocol waits for subproblem values, and no bound depends on their order of arrival. Rank 0
// reports the bounds that it proves by these values in its statuses.
//
// *Unresponsive ranks.* The latest status of an unresponsive rank still covers its nodes.
// Therefore, if a limit was reached and no message has arrived for kMaxSilence since then, the
// coordinator can conclude without the unresponsive ranks. A rank whose worker is in a long step
// sends its statistics repeatedly, as a heartbeat.
//
// *Shutdown.* After Terminate a rank lets its workers end, sends RankFinished, and then sends
// nothing more. A sub-coordinator sends RankFinished when all its children have sent it. When the
// coordinator has received it from all children, it sends each rank the number of messages that
// other ranks sent to it directly (batches, pricing requests, pricing replies, learned bounds). The
// rank waits for all of these, so that no message is left in transit. Messages on the way up arrive
// before RankFinished, and messages on the way down before MessageCounts, because they travel along
// the same paths.
#include "mpi/coordinator.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "model/assert.h"
#include "mpi/messages.h"

namespace grove::detail {
namespace {

constexpr std::size_t kNodesPerAssignment = 200;  // nodes per AssignNodes message
// Silence after a limit from which on ranks count as unresponsive. Ranks poll their limits every
// few milliseconds, and the network at least every four milliseconds. The run concludes without
// unresponsive ranks no earlier than twice this time after the limit, so a worker in a long step
// has that much time, whether or not a checkpoint is written.
constexpr auto kMaxSilence = std::chrono::milliseconds(700);

ChildLinks links_of_top(Transport& transport, std::int64_t max_children) {
  const Hierarchy hierarchy(transport.ranks(), max_children);
  return {transport, hierarchy, hierarchy.levels()};
}

}  // namespace

Coordinator::Coordinator(const Problem& problem, const SolveOptions& options, const Limits& limits,
                         RunObserver& observer, Transport& transport)
    : instance_(problem.instance),
      options_(options),
      limits_(limits),
      transport_(transport),
      children_(links_of_top(transport, options.tuning.coordinator_children)),
      announcer_(observer, children_),
      nodes_(children_),
      run_(problem, options, limits, announcer_, pool_, nodes_),
      load_balancer_(children_.ranks(), options.tuning),
      checkpoints_(options.checkpoints, limits, run_, transport, children_),
      silence_(limits.now()) {
  run_.run_events().set_statistics_source([this] { return statistics(); });
}

// Calls the observer before the broadcast, because the observer can write the plan to disk.
void Coordinator::Announcer::on_incumbent(const Plan& plan, PlanSource source,
                                          const Progress& progress) {
  ForwardingObserver::on_incumbent(plan, source, progress);
  children_.broadcast(message::Incumbent{plan});
}

void Coordinator::begin() {
  if (options_.resume)
    restore(*options_.resume);
  else
    run_.begin();
}

// Restores the run, and assigns the nodes to the children while it reads them.
void Coordinator::restore(CheckpointReader& checkpoint) {
  const auto roots = run_.restore(checkpoint.header());
  if (!roots) return checkpoints_.disable();
  nodes_.assign({{}, checkpoint.header().evicted_bound});
  std::vector<NodeRecord> nodes;
  const auto send = [&] { nodes_.assign({std::exchange(nodes, {}), kInfiniteCost}); };
  while (auto next = checkpoint.next()) {
    const NodePtr& root = roots->at(next->tree);
    check(*next, *root, instance_);
    nodes_.send(root->tree());
    nodes.push_back(std::move(*next));
    if (nodes.size() == kNodesPerAssignment) send();
  }
  if (!nodes.empty()) send();
  run_.restored();
}

void Coordinator::handle(int from, message::Message&& message) {
  const auto unexpected = [](const auto&) {
    throw std::invalid_argument("coordinator: unexpected message type");
  };
  std::visit(
      Overloaded{[&](message::Status& status) { update(children_.with(from), std::move(status)); },
                 [&](message::NewPlan& found) {
                   run_.shared_bounds().post(std::move(found.plan), found.source);
                 },
                 [&](message::SnapshotTaken& taken) { checkpoints_.handle(taken); },
                 [&](message::SnapshotPart& part) { checkpoints_.handle(std::move(part)); },
                 [&](message::ProcessStatistics& report) { statistics_.update(report); },
                 [&](message::RankFinished& finished) { leave(finished); }, unexpected},
      message);
  silence_.heard(limits_.now());  // after the handling, because writing a checkpoint takes time
}

void Coordinator::update(int child, message::Status status) {
  GROVE_CHECK(!ended(), "no child reports after all have finished");
  load_balancer_.update(child, status);
  for (const message::BatchReceived& taken : status.taken) {
    load_balancer_.arrived(taken.by);
    children_.send(children_.with(taken.from),
                   message::ReleaseCustody{taken.from, taken.by, taken.batches});
  }
  if (status.stopped != StopReason::kNone) limits_.stop(status.stopped);
  if (status.proven > 0) run_.shared_bounds().prove(status.proven, status.proven_by);
  nodes_.update(child, std::move(status));
  run_.shared_bounds().nodes_changed();
  run_.run_events().worked();
  if (ending_) return;  // a batch ordered now could be left in transit at the end
  run_.trees().instantiate_due_tree();
  while (const auto transfer = load_balancer_.next())
    children_.send(transfer->from,
                   message::SendNodes{transfer->to, transfer->nodes, transfer->to_idle});
}

void Coordinator::step() {
  if (ending_) return;
  checkpoints_.update();
  if (checkpoints_.in_progress()) return;  // the last one is written before Terminate is sent
  if (run_.shared_bounds().over()) {
    ending_ = true;
    children_.broadcast(message::Terminate{});
  } else if (!nodes_.any()) {
    run_.trees().refill_nodes();  // a pruned tree has no node, so no rank has a reason to report
  } else if (run_.trees().claim_preparation()) {
    run_.trees().prepare_tree();
  }
}

void Coordinator::leave(const message::RankFinished& message) {
  GROVE_CHECK(ending_ && !ended(), "each child finishes once, after Terminate");
  statistics_.finish(message);
  if (ended()) children_.send_message_counts({statistics_.messages()});
}

// The last status of an unresponsive rank stays valid. Rank 0 is never counted, because its worker
// can be in a long step.
std::int64_t Coordinator::check_unresponsive_ranks() {
  if (ended() || !limits_.stop_requested()) return 0;
  const Clock::time_point now = limits_.now();
  silence_.limit_is_reached(now);
  if (silence_.silence(now) < kMaxSilence) return 0;
  if (checkpoints_.in_progress()) {
    checkpoints_.abort();
    return 0;
  }
  if (!ending_ || silence_.since_limit(now) < 2 * kMaxSilence) return 0;
  return transport_.ranks() - statistics_.finished_ranks() - (statistics_.has_finished(0) ? 0 : 1);
}

Solution Coordinator::conclude() {
  run_.end();
  Solution solution = run_.conclude();
  for (const auto& [key, count] : statistics_.all().whole.counts)
    solution.stats.counts[key] += count;
  return solution;
}

RunStatistics Coordinator::statistics() const {
  RunStatistics statistics = statistics_.all();
  Counters of_plans;
  run_.shared_bounds().add_counts(of_plans);
  add(of_plans, statistics.whole.counts);
  statistics.rank_count = transport_.ranks();
  return statistics;
}

}  // namespace grove::detail
