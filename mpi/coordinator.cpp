// SPDX-License-Identifier: MIT
// Ranks hold the nodes of one search and pass them to each other; the coordinator holds the ledger.
// Messages between two ranks arrive in the order in which they were sent, others in any order.
//
// *The bound.* Every node that may still lead to a plan is covered, at every moment, by the latest
// status that the coordinator has of some rank, by a root that it has sent and not yet seen
// covered, or by a tree not yet instantiated:
// - A rank covers the nodes in its frontier, open or taken. A worker settles a node after what
//   it led to was pushed, and after a plan that it led to was posted; and a rank sends the plans
//   posted before a status made no later. So the coordinator knows of the plan when it hears that
//   the node is gone.
// - A rank that gives nodes away keeps them taken: in custody. The receiver pushes them and then
//   says so in a status; when the coordinator has processed that one, which covers them, it
//   releases the sender, whose later statuses do without. (The minimum of the ranks' own bounds,
//   sampled while nodes travel, would miss those that travel.)
// - A root is covered by the coordinator until the status that says it has been pushed.
// - What is not pushed is pruned by an incumbent that the gate has checked.
// So min(latest statuses, roots under way, next tree) bounds all plans but those pruned, whatever
// the delays, and a rank that says nothing for long only keeps the bound low.
//
// *The end.* By the same argument no node is live if no latest status knows a live one and no root
// is under way. There is no other test for it, and no batch can be under way then.
//
// *A new beginning*, after nodes were given up for want of memory: nothing is live, all forget what
// they gave up, and the roots are pushed again. A rank may be given nodes by one that has begun
// anew before it hears of that itself: batches carry their era, and wait. Until a rank's status is
// of the new era it is not known what it holds.
//
// *Prices.* The Lagrangian bound is rank 0's, beside its nodes. It asks other ranks for prices
// under its multipliers, each for one share of the agents at a time: the next when it has answered.
// An answer that comes late, or of other multipliers, is dropped there (lagrangian_bound.cpp), and
// what is missing is found there; so nothing here waits for prices, and no bound depends on the
// order in which they come. What rank 0 proves by them goes to the coordinator in its statuses.
//
// *Leaving.* After End, and what it was ordered before, a rank says farewell and sends nothing
// more; the coordinator then tells each how many batches were sent to it, so that nothing is left
// under way. The last question for prices arrives before that, for it was sent before by the same
// rank, and the last answer before the farewell of who gave it.
#include "mpi/coordinator.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::size_t kNodesEntrusted = 200;  // at a time

}  // namespace

Coordinator::Coordinator(const Problem& problem, const SolveOptions& options, const Limits& limits,
                         RunObserver& observer, Transport& transport)
    : instance_(problem.instance),
      options_(options),
      limits_(limits),
      transport_(transport),
      announcer_(observer, transport),
      nodes_(transport),
      run_(problem, options, limits, announcer_, pool_, nodes_),
      broker_(transport.ranks(), options.tuning),
      timer_(options.checkpoints),
      batches_to_(static_cast<std::size_t>(transport.ranks())),
      accounts_(static_cast<std::size_t>(transport.ranks())) {
  run_.announcements().survey_by([this] { return survey(); });
}

// An observer may have it written to disk: that comes first.
void Coordinator::Announcer::on_incumbent(const Plan& plan, PlanSource source,
                                          const Progress& progress) {
  ForwardingObserver::on_incumbent(plan, source, progress);
  tell_all(transport_, message::Incumbent{plan});
}

void Coordinator::begin() {
  if (options_.resume)
    restore(*options_.resume);
  else
    run_.begin();
}

// Spread over the ranks as they come.
void Coordinator::restore(CheckpointReader& checkpoint) {
  const auto roots = run_.restore(checkpoint.header());
  restored_ = roots.has_value();
  if (!roots) return;
  nodes_.entrust(0, {}, checkpoint.header().evicted_bound);
  std::vector<NodeRecord> nodes;
  int rank = 0;
  const auto send = [&] {
    nodes_.entrust(rank, std::exchange(nodes, {}));
    rank = (rank + 1) % transport_.ranks();
  };
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

bool Coordinator::is_for_coordinator(const message::Message& message) {
  return std::holds_alternative<message::Status>(message) ||
         std::holds_alternative<message::Found>(message) ||
         std::holds_alternative<message::Gathered>(message) ||
         std::holds_alternative<message::Part>(message) ||
         std::holds_alternative<message::Account>(message) ||
         std::holds_alternative<message::Farewell>(message);
}

void Coordinator::handle(int from, message::Message&& message) {
  if (auto* status = std::get_if<message::Status>(&message))
    heard(from, std::move(*status));
  else if (auto* found = std::get_if<message::Found>(&message))
    run_.ledger().post(std::move(found->plan), found->source);
  else if (const auto* gathered = std::get_if<message::Gathered>(&message))
    gathering_.value().handle(*gathered);
  else if (auto* part = std::get_if<message::Part>(&message))
    gathering_.value().handle(std::move(*part));
  else if (auto* account = std::get_if<message::Account>(&message))
    accounts_.at(static_cast<std::size_t>(from)) = std::move(account->account);
  else if (auto* farewell = std::get_if<message::Farewell>(&message))
    leave(from, std::move(*farewell));
  else
    throw std::invalid_argument("a message for a rank came to the coordinator");
}

void Coordinator::heard(int from, message::Status status) {
  broker_.heard(from, status);
  for (const auto& [giver, batches] : status.batches) {
    broker_.arrived(from);
    transport_.send(giver, bytes_of(message::Release{from, batches}));
  }
  if (status.stopped != StopReason::kNone) limits_.stop(status.stopped);
  if (status.proven > 0) run_.ledger().prove(status.proven, status.proven_by);
  nodes_.update(from, std::move(status));
  run_.ledger().nodes_changed();
  run_.announcements().worked();
  if (ending_) return;  // a batch sent after a farewell would be left under way
  run_.trees().bring_due_tree();
  while (const auto gift = broker_.next())
    transport_.send(gift->from, bytes_of(message::Order{gift->to, gift->nodes}));
}

// One at a time; the last one when the search is over, before the ranks are told.
void Coordinator::look_after_checkpoints() {
  if (gathering_ && gathering_->is_done()) gathering_.reset();
  if (gathering_ || options_.checkpoints.directory.empty() || !restored_) return;
  const bool is_last = run_.ledger().over() && !gathered_at_end_;
  if (!is_last && (run_.ledger().over() || !timer_.due())) return;
  gathered_at_end_ = is_last;
  gathering_.emplace(options_.checkpoints, run_, transport_);
}

void Coordinator::step() {
  if (ending_) return;
  look_after_checkpoints();
  if (gathering_) return;
  if (run_.ledger().over()) {
    ending_ = true;
    tell_all(transport_, message::End{});
  } else if (!nodes_.any()) {
    run_.trees().bring_nodes();  // a tree may bring none: then nobody has anything to say
  } else if (run_.trees().claim_preparation()) {
    run_.trees().prepare_tree();
  }
}

void Coordinator::leave(int from, message::Farewell&& farewell) {
  for (const auto& [to, batches] : farewell.batches)
    batches_to_.at(static_cast<std::size_t>(to)) += batches;
  accounts_.at(static_cast<std::size_t>(from)) = std::move(farewell.account);
  if (++farewells_ < transport_.ranks()) return;
  for (int rank = 0; rank < transport_.ranks(); ++rank)
    transport_.send(rank, bytes_of(message::Goodbye{batches_to_[static_cast<std::size_t>(rank)]}));
}

Solution Coordinator::conclude() {
  run_.end();
  Solution solution = run_.conclude();
  for (const auto& account : accounts_) {
    if (!account) continue;  // a simulated run ends without farewells
    for (const auto& [key, count] : account->counts) solution.stats.counts[key] += count;
  }
  return solution;
}

Survey Coordinator::survey() const {
  Survey survey;
  Stats of_plans;
  run_.ledger().add_counts(of_plans);
  survey.whole.counts = std::move(of_plans.counts);
  for (int rank = 0; rank < transport_.ranks(); ++rank) {
    survey.ranks.push_back(nodes_.survey(rank));
    auto& account = survey.ranks.back().account;
    account = accounts_[static_cast<std::size_t>(rank)];
    if (account) add(*account, survey.whole);
  }
  return survey;
}

}  // namespace grove::detail
