// SPDX-License-Identifier: MIT
// Ranks hold the nodes of one search and pass them to each other; the coordinator holds the ledger.
// Where there are many ranks it hears them by way of sub-coordinators (hierarchy.h), which merge
// what is said on the way up and spread what is said on the way down. Messages between two ranks
// arrive in the order in which they were sent, others in any order.
//
// *The bound.* Every node that may still lead to a plan is covered, at every moment, by the latest
// status that the coordinator has of some child, by nodes that it has entrusted to one and not yet
// seen covered, or by a tree not yet instantiated. For a rank that is a child:
// - It covers the nodes in its frontier, open or taken. A worker settles a node after what it led
//   to was pushed, and after a plan that it led to was posted; and a rank sends the plans posted
//   before a status made no later. So the coordinator knows of the plan when it hears that the node
//   is gone.
// - A rank that gives nodes away keeps them taken: in custody. The receiver pushes them and then
//   says so in a status; when the coordinator has processed that one, which covers them, it
//   releases the sender, whose later statuses do without. (The minimum of the ranks' own bounds,
//   sampled while nodes travel, would miss those that travel.)
// - What is entrusted to it is covered by the coordinator until the status that says it has been
//   pushed.
// - What is not pushed is pruned by an incumbent that the gate has checked.
// So min(latest statuses, entrusted, next tree) bounds all plans but those pruned, whatever the
// delays, and a rank that says nothing for long only keeps the bound low.
//
// *Sub-coordinators.* Call what is below one coordinator its group. Claim: at every moment the
// least bound of the latest statuses and of what is entrusted, as one coordinator has them, covers
// every node of its group, and every one that somebody of its group has in custody. For level 1
// this is the argument above, for what comes from elsewhere and goes there is in the custody of
// somebody or covered by a status already processed. Above it:
// - A status of a sub-coordinator is that minimum of its own at one moment, so it covers what its
//   group then held. What its group holds later comes from nodes covered then, from what was
//   entrusted to it since, which is covered above until a status says that it has arrived, or from
//   another group, in whose member's custody it still is.
// - A batch is released by the coordinator nearest above both sides, when it has processed a status
//   of the receiver's group that says that the batch was taken over: and covers it, for each
//   coordinator on the way up passes that on in the status that covers it, or a later one. The
//   release goes down to the giver, so what the giver's group says without the batch is processed
//   by that coordinator, and above it, after what covers it on the other side. What is said above
//   in between has both.
// - Plans go up by the same way, each passed on at once, and one is dropped only where an incumbent
//   that the gate has checked is as good. So a plan still comes before the status without the node
//   that led to it.
//
// *The end.* By the same argument no node is live if no latest status knows a live one and nothing
// entrusted is under way. There is no other test for it, and no batch can be under way then.
//
// *A new beginning*, after nodes were given up for want of memory: nothing is live, all forget what
// they gave up, and the roots are pushed again. A rank may be given nodes by one that has begun
// anew before it hears of that itself: batches carry their era, and wait. Until a rank's status is
// of the new era it is not known what it holds; a group is of the era of its last.
//
// *Facts.* What ranks find out about agents they tell each other (knowledge.h). That is never a
// node, is true wherever it comes (search/learned_bounds.cpp), and nobody waits for it or answers.
//
// *Prices.* The Lagrangian bound is rank 0's, beside its nodes. It asks other ranks for prices
// under its multipliers, each for one share of the agents at a time: the next when it has answered.
// An answer that comes late, or of other multipliers, is dropped there (lagrangian_bound.cpp), and
// what is missing is found there; so nothing here waits for prices, and no bound depends on the
// order in which they come. What rank 0 proves by them goes to the coordinator in its statuses.
//
// *Ranks that stand still.* What the latest status of such a rank covers stays covered. So when a
// limit has struck, and nothing has been heard for long since then, the coordinator concludes
// without it. A rank whose worker is in the midst of something tells what it has done so far, again
// and again, as a sign of life.
//
// *Leaving.* After End, and what it was ordered before, a rank says farewell and sends nothing
// more; a sub-coordinator does when all its children have. The coordinator then tells each rank how
// many messages were sent to it directly by others (batches, questions for prices, answers, facts),
// so that nothing is left under way. What went up came before the farewells, what goes down before
// that last word, by the same ways.
#include "mpi/coordinator.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "mpi/overloaded.h"

namespace grove::detail {
namespace {

constexpr std::size_t kNodesEntrusted = 200;  // at a time
// Ranks look at their limits every few milliseconds, and at the network every four at least. One
// whose worker is at a long step has twice that before it is given up, after a checkpoint or not.
constexpr auto kLongSilence = std::chrono::milliseconds(700);

}  // namespace

Coordinator::Coordinator(const Problem& problem, const SolveOptions& options, const Limits& limits,
                         RunObserver& observer, Transport& transport)
    : instance_(problem.instance),
      options_(options),
      limits_(limits),
      transport_(transport),
      hierarchy_(transport.ranks(), options.tuning.coordinator_children),
      children_(transport, hierarchy_, hierarchy_.levels()),
      announcer_(observer, children_),
      nodes_(children_),
      run_(problem, options, limits, announcer_, pool_, nodes_),
      load_balancer_(children_.ranks(), options.tuning),
      timer_(options.checkpoints, limits),
      heard_at_(limits.now()) {
  run_.announcements().survey_by([this] { return survey(); });
}

// An observer may have it written to disk: that comes first.
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

// Spread over those below as they come.
void Coordinator::restore(CheckpointReader& checkpoint) {
  const auto roots = run_.restore(checkpoint.header());
  restored_ = roots.has_value();
  if (!roots) return;
  nodes_.assign({{}, checkpoint.header().evicted_bound});
  std::vector<NodeRecord> nodes;
  const auto send = [&] { nodes_.assign({std::exchange(nodes, {}), kInfiniteCost}); };
  while (auto next = checkpoint.next()) {
    const NodePtr& root = roots->at(next->tree);
    check(*next, *root, instance_);
    nodes_.tell(root->tree());
    nodes.push_back(std::move(*next));
    if (nodes.size() == kNodesEntrusted) send();
  }
  if (!nodes.empty()) send();
  run_.restored();
}

void Coordinator::handle(int from, message::Message&& message) {
  const auto unexpected = [](const auto&) {
    throw std::invalid_argument("a message for a rank came to the coordinator");
  };
  std::visit(
      Overloaded{
          [&](message::Status& status) { heard(children_.with(from), std::move(status)); },
          [&](message::NewPlan& found) { run_.ledger().post(std::move(found.plan), found.source); },
          [&](message::SnapshotTaken& gathered) {
            if (gathering_) gathering_->handle(gathered);  // else it was given up
          },
          [&](message::SnapshotPart& part) {
            if (gathering_) gathering_->handle(std::move(part));
          },
          [&](message::ProcessStatistics& account) {
            for (const auto& [rank, survey] : account.survey.ranks) surveys_[rank] = account.survey;
          },
          [&](message::RankFinished& said) { leave(said); }, unexpected},
      message);
  heard_at_ = limits_.now();  // after that: a checkpoint takes time to be written
}

void Coordinator::heard(int child, message::Status status) {
  load_balancer_.heard(child, status);
  for (const message::BatchReceived& taken : status.taken) {
    load_balancer_.arrived(taken.by);
    children_.tell(children_.with(taken.from),
                   message::ReleaseCustody{taken.from, taken.by, taken.batches});
  }
  if (status.stopped != StopReason::kNone) limits_.stop(status.stopped);
  if (status.proven > 0) run_.ledger().prove(status.proven, status.proven_by);
  nodes_.update(child, std::move(status));
  run_.ledger().nodes_changed();
  run_.announcements().worked();
  if (ending_) return;  // a batch sent after a farewell would be left under way
  run_.trees().instantiate_due_tree();
  while (const auto gift = load_balancer_.next())
    children_.tell(gift->from, message::SendNodes{gift->to, gift->nodes, gift->to_idle});
}

// One at a time; the last one when the search is over, before the ranks are told.
void Coordinator::look_after_checkpoints() {
  if (gathering_ && gathering_->is_done()) gathering_.reset();
  if (gathering_ || options_.checkpoints.directory.empty() || !restored_) return;
  const bool is_last = run_.ledger().over() && !gathered_at_end_;
  if (!is_last && (run_.ledger().over() || !timer_.due())) return;
  gathered_at_end_ = is_last;
  gathering_.emplace(options_.checkpoints, limits_, run_, transport_, children_);
}

void Coordinator::step() {
  if (ending_) return;
  look_after_checkpoints();
  if (gathering_) return;
  if (run_.ledger().over()) {
    ending_ = true;
    children_.broadcast(message::Terminate{});
  } else if (!nodes_.any()) {
    run_.trees().refill_nodes();  // a tree may bring none: then nobody has anything to say
  } else if (run_.trees().claim_preparation()) {
    run_.trees().prepare_tree();
  }
}

void Coordinator::leave(const message::RankFinished& said) {
  add(said, farewell_);
  if (++farewells_ == children_.count()) children_.send_message_counts({farewell_.messages});
}

// What is known of a rank that stands still goes on to hold. Until the limit there may have been
// nothing to say. This rank does not stand still: its worker may be in the midst of something.
std::int64_t Coordinator::check_unresponsive_ranks() {
  if (ended() || !limits_.stop_requested()) return 0;
  const Clock::time_point now = limits_.now();
  if (!stopped_at_) stopped_at_ = now;
  if (now - std::max(heard_at_, *stopped_at_) < kLongSilence) return 0;
  if (gathering_) {
    run_.announcements().checkpoint({.failure = "a rank says nothing any more"});
    gathering_.reset();
    gathered_at_end_ = true;
    return 0;
  }
  if (!ending_ || now - *stopped_at_ < 2 * kLongSilence) return 0;
  const auto& said = farewell_.survey.ranks;
  return transport_.ranks() - std::ssize(said) - (said.contains(0) ? 0 : 1);
}

Solution Coordinator::conclude() {
  run_.end();
  Solution solution = run_.conclude();
  for (const auto& [key, count] : told().whole.counts) solution.stats.counts[key] += count;
  return solution;
}

// A simulated run ends without farewells.
RunStatistics Coordinator::told() const {
  RunStatistics all = farewell_.survey;
  for (const auto& [rank, survey] : surveys_)
    if (!all.ranks.contains(rank)) add(survey, all);
  return all;
}

RunStatistics Coordinator::survey() const {
  RunStatistics survey = told();
  Stats of_plans;
  run_.ledger().add_counts(of_plans);
  for (const auto& [key, count] : of_plans.counts) survey.whole.counts[key] += count;
  survey.rank_count = transport_.ranks();
  return survey;
}

}  // namespace grove::detail
