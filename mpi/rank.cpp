// SPDX-License-Identifier: MIT
#include "mpi/rank.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "model/assert.h"
#include "mpi/messages.h"

namespace grove::detail {
namespace {

constexpr std::size_t kLevels = 4;
// Number of nodes expanded with BoundingEffort::kCachedOnly at the start, and after nodes were sent
// to an idle rank. (Simulated, 128 ranks: room-32-32-4 with 22 agents and 40 tasks takes 0.178 s
// with 0 nodes, 0.142 s with 2 and 0.152 s with 4; random-32-32-20 with 50 agents takes 0.099,
// 0.090 and 0.091 s.)
constexpr std::int64_t kCachedOnlyNodes = 2;
constexpr std::size_t kNodesInAPart = 500;
constexpr double kBytesPerMegabyte = 1e6;

// Returns the surplus of a rank with these open nodes; see Frontier::take_for_transfer().
std::vector<message::Surplus> spare_of(const std::vector<Frontier::Level>& levels,
                                       bool keeps_next) {
  std::vector<message::Surplus> surplus;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const bool is_best = i == 0;
    const std::int64_t half = (levels[i].open + (is_best ? 0 : 1)) / 2;
    const std::int64_t next = is_best && !keeps_next ? levels[i].open % 2 : 0;
    if (half + next > 0) surplus.push_back({levels[i].bound, half, next});
  }
  return surplus;
}

// Status at the start, when the rank is idle.
message::Status first_status(int rank) {
  message::Status status;
  status.work_requests = {{rank, true, kInfiniteCost}};
  return status;
}

}  // namespace

Rank::Rank(const Problem& problem, const SolveOptions& options, const Limits& limits,
           Transport& transport, const AgentStopsCache& stops)
    : transport_(transport),
      parent_(transport, Hierarchy(transport.ranks(), options.tuning.coordinator_children),
              {transport.rank(), 0}, first_status(transport.rank())),
      trees_{stops, {problem, trees_.stops, nodes_.pool}, {}},
      shared_bounds_(limits, nodes_.frontier),
      components_(problem, options, limits, stops, nodes_, shared_bounds_, at_coordinator_.trees,
                  at_coordinator_.observer, {transport.rank(), transport.ranks()}),
      learned_bounds_(transport.rank(), transport.ranks(),
                      options.tuning.bound_broadcast_rate * kBytesPerMegabyte,
                      components_.memory()) {
  if (transport.ranks() > 1) favor_splitting();
}

void Rank::handle(int from, message::Message&& message) {
  const auto unexpected = [](const auto&) {
    throw std::invalid_argument("rank: unexpected message type");
  };
  std::visit(Overloaded{[&](message::NodeBatch& batch) {
                          direct_messages_.count_received();
                          receive_batch(from, batch);
                        },
                        [&](message::ForComponent& m) {
                          direct_messages_.count_received();
                          components_.receive(from, m.message);
                        },
                        [&](message::LearnedBounds& facts) {
                          direct_messages_.count_received();
                          learned_bounds_.receive(facts, ended_);
                        },
                        [&](message::NewTree& tree) { accept(tree); },
                        [&](message::AssignNodes& assigned) { accept(assigned); },
                        [&](message::SendNodes& order) { send_nodes(order); },
                        [&](message::ReleaseCustody& covered) {
                          custody_.release(covered.to, covered.batches, nodes_.frontier);
                        },
                        [&](message::Incumbent& incumbent) {
                          const Cost cost = incumbent.plan.cost;
                          shared_bounds_.adopt(std::move(incumbent.plan));
                          nodes_.prune(cost);
                        },
                        [&](message::Restart& order) { restart(order.proven); },
                        [&](message::SnapshotRequest&) { gather(); },
                        [&](message::SnapshotNext&) { send_part(); }, [](message::Heartbeat&) {},
                        [&](message::Terminate&) {
                          ended_ = true;
                          parent_.end_reports();
                          shared_bounds_.end();
                        },
                        [&](message::MessageCounts& message_counts) {
                          direct_messages_.expect(message_counts.messages[transport_.rank()]);
                        },
                        unexpected},
             message);
}

// True if a tree of the batch has not arrived yet, or if the batch is of a later epoch, whose
// Restart this rank has not handled yet.
bool Rank::must_defer(const message::NodeBatch& batch) const {
  return batch.epoch > handled_.epoch ||
         std::ranges::any_of(batch.nodes, [&](const NodeRecord& node) {
           return !trees_.roots.contains(node.tree);
         });
}

void Rank::receive_batch(int from, message::NodeBatch& batch) {
  const bool must_wait =
      std::ranges::any_of(deferred_, [&](const DeferredBatch& h) { return h.from == from; });
  if (must_wait || must_defer(batch)) {
    deferred_.push_back({from, std::move(batch)});
    return;
  }
  push(batch.nodes, batch.findings);
  custody_.received(from);
  parent_.mark_urgent();
}

void Rank::receive_deferred() {
  for (auto& [from, batch] : std::exchange(deferred_, {})) receive_batch(from, batch);
}

// The nodes sent stay in this rank's custody: they are taken from the frontier, but not completed.
void Rank::send_nodes(const message::SendNodes& order) {
  if (order.to_idle) favor_splitting();
  const bool keeps = !order.to_idle || keeps_next();
  const auto nodes =
      nodes_.frontier.take_for_transfer(static_cast<std::size_t>(order.count), keeps);
  message::NodeBatch batch;
  batch.epoch = handled_.epoch;
  for (const NodePtr& node : nodes) batch.nodes.push_back(record_of(*node));
  batch.findings = group_bounds_of(nodes, *components_.memory().cache());
  custody_.keep(order.to, nodes);
  send(order.to, batch);
  custody_.confirm_sent(order.to);
  parent_.mark_urgent();
}

// Restricts the bounding of the next nodes to cached bounds, because other ranks wait for nodes.
// Computing the bounds of a node's pairs and groups before the node is split can take 10 ms. The
// first ten generations of nodes would then take most of a short run, and most ranks would be idle
// during that time. It is better to split first, so that each rank computes these bounds for its
// own descendants of the node.
void Rank::favor_splitting() {
  cached_only_until_ = nodes_.expanded + kCachedOnlyNodes;
  components_.tree().set_bounding_effort(BoundingEffort::kCachedOnly);
}

// True if the rank must keep its best open node for its worker. False while a worker expands a
// node, because that can take long and nearly always yields another node.
bool Rank::keeps_next() const {
  return static_cast<std::int64_t>(nodes_.frontier.live()) <=
         static_cast<std::int64_t>(nodes_.frontier.open()) + custody_.nodes();
}

void Rank::accept(const message::NewTree& tree) {
  GROVE_CHECK(!trees_.roots.contains(tree.number), "each tree is announced once");
  const NodePtr& root = trees_.roots[tree.number] = trees_.trees.add(tree.tree, tree.number);
  learned_bounds_.add_tree(root->tree());
  receive_deferred();
}

void Rank::accept(const message::AssignNodes& assigned) {
  push(assigned.nodes, {});
  nodes_.frontier.record_evicted_bound(assigned.evicted_bound);
  ++handled_.assigned;
  parent_.mark_urgent();
}

void Rank::push(const std::vector<NodeRecord>& records, const std::vector<GroupBound>& findings) {
  std::vector<NodePtr> nodes;  // nullptr: pruned
  for (const NodeRecord& record : records) {
    const NodePtr& root = trees_.roots.at(record.tree);
    const bool pruned = record.bound >= shared_bounds_.cutoff();
    nodes.push_back(pruned ? nullptr
                           : node_of(record, root, components_.context().problem.instance));
  }
  merge(findings, nodes, *components_.memory().cache());
  for (NodePtr& node : nodes)
    if (node) nodes_.push(std::move(node));
}

// Takes the snapshot before it sends the plans found: a plan is posted before its node is
// completed, so the plan of every node missing from the snapshot is sent.
void Rank::gather() {
  Frontier::Snapshot snapshot = nodes_.frontier.snapshot();
  send_found();
  gathered_ = std::move(snapshot.live);
  parent_.send(message::SnapshotTaken{snapshot.evicted_bound});
}

void Rank::send_part() {
  message::SnapshotPart part;
  while (!gathered_.empty() && part.nodes.size() < kNodesInAPart) {
    part.nodes.push_back(record_of(*gathered_.back()));
    gathered_.pop_back();
  }
  part.last = gathered_.empty();
  parent_.send_to_top(part);
}

void Rank::restart(Cost proven) {
  nodes_.restart({}, proven);
  ++handled_.epoch;
  parent_.mark_urgent();
  receive_deferred();
}

// Workers run concurrently, so the order of the reads matters. The evicted bound is read after
// `live`, because a status with live == false must cover every evicted node, and no node is evicted
// once none is live.
message::Status Rank::status() const {
  message::Status status;
  const auto live = static_cast<std::int64_t>(nodes_.frontier.live());
  status.live = live > 0;
  status.evicted_bound = nodes_.evicted_bound();
  std::tie(status.proven, status.proven_by) = shared_bounds_.proven();
  status.bound = nodes_.bound();
  std::vector<Frontier::Level> levels = nodes_.frontier.levels(kLevels);
  const bool has_open = !levels.empty();
  std::erase_if(levels, [&](const Frontier::Level& level) { return !is_wanted(level.bound); });
  const bool idle = live == custody_.nodes() || (has_open && levels.empty());
  status.surplus = spare_of(levels, keeps_next());
  status.work_requests = {
      {transport_.rank(), idle, levels.empty() ? kInfiniteCost : levels.front().bound}};
  status.open = static_cast<std::int64_t>(nodes_.frontier.open());
  status.expanded = nodes_.expanded;
  status.epoch = handled_.epoch;
  status.assigned = handled_.assigned;
  const Limits& limits = components_.context().limits;
  limits.stop_requested();  // checks the limits; possibly the only check on this rank
  status.stopped = limits.reason();
  status.taken = custody_.new_receipts(transport_.rank());
  return status;
}

// True if nodes with this bound must be expanded before the run can end, that is, if the incumbent
// is not within omega of the bound. A rank that has only other nodes expands them, but it counts as
// idle and has no surplus. (When nodes that need not be expanded were transferred, too, 128 ranks
// with omega = 1 % took 1.7 times as long.)
bool Rank::is_wanted(Cost bound) const {
  const Cost cutoff = shared_bounds_.cutoff();
  return cutoff == kInfiniteCost || !components_.context().options.omega.accepts(cutoff, bound);
}

// A worker completes a node only after it has posted the plan that the node led to. Therefore the
// status is made before the posted plans are read, and is sent after them.
void Rank::send_updates(double now) {
  if (ended_) return;
  if (nodes_.expanded >= cached_only_until_)
    components_.tree().set_bounding_effort(BoundingEffort::kFull);
  send_component_messages();
  send_learned_bounds(now);
  message::Status status = this->status();
  send_found();
  if (parent_.report(std::move(status), now)) custody_.mark_reported();
}

void Rank::send_component_messages() {
  for (auto& [rank, message] : components_.take_messages())
    send(rank, message::ForComponent{std::move(message)});
}

void Rank::send_learned_bounds(double now) {
  for (auto& [rank, bounds] : learned_bounds_.take_messages(now)) send(rank, bounds);
}

void Rank::send_found() {
  if (auto found = shared_bounds_.take_found())
    parent_.send(message::NewPlan{std::move(found->plan), found->source});
}

RunStatistics Rank::statistics(Counters counters) const {
  components_.add_counts(counters);
  counters[Counter::kMessages] += transport_.messages();
  counters[Counter::kMessageBytes] += transport_.bytes();
  counters[Counter::kNodesSent] += custody_.nodes_sent();
  counters[Counter::kLearnedBoundsSent] += learned_bounds_.sent();
  counters[Counter::kNodeBatches] += custody_.batches_sent();
  RankStatistics mine;
  mine.low_level_calls = counters[Counter::kLowLevelCalls];
  mine.branching_cost_queries = counters[Counter::kBranchingCostQueries];
  mine.expanded = nodes_.expanded;
  mine.open = nodes_.counts().open;
  if (nodes_.any()) mine.bound = nodes_.bound();
  const MemoryUse memory = components_.memory_use();
  mine.memory = memory.process;
  return {{counters.named(), memory}, {{transport_.rank(), mine}}};
}

void Rank::send_statistics(const Counters& counters) {
  parent_.send(message::ProcessStatistics{statistics(counters)});
}

// Sends a plan that was found just when a limit was reached, too.
void Rank::send_finished(const Counters& counters) {
  send_found();
  parent_.send(message::RankFinished{statistics(counters), direct_messages_.sent()});
}

bool Rank::left() const {
  return direct_messages_.all_received();
}

void Rank::send(int rank, const message::Message& message) {
  direct_messages_.count_sent(rank);
  transport_.send(rank, bytes_of(message, 0));
}

}  // namespace grove::detail
