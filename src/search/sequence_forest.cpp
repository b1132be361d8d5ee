// SPDX-License-Identifier: MIT
// A root's paths are shortest for its sequences and do not depend on constraints. They are
// therefore planned once per (agent, rank) and shared by all trees that use them. The first tree
// that uses a path plans it around the paths of other agents that are known by then, which avoids
// conflicts caused by mere ties.
#include "search/sequence_forest.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {
namespace {

std::vector<CostMatrix> cost_matrices(const Problem& problem) {
  std::vector<CostMatrix> matrices;
  for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent)
    matrices.push_back(cost_matrix(problem.instance, agent, problem.distances));
  return matrices;
}

KBestJointSequences joint_sequences(const std::vector<CostMatrix>& matrices, RtspBackend backend,
                                    const Limits& limits) {
  std::vector<KBestSequences> agents;
  for (const CostMatrix& matrix : matrices)
    agents.emplace_back(make_rtsp_solver(backend, matrix, limits), matrix, limits);
  return KBestJointSequences(std::move(agents), limits);
}

}  // namespace

SequenceForest::SequenceForest(const Problem& problem, NodePool& pool, RtspBackend backend,
                               const Limits& limits)
    : problem_(problem),
      pool_(pool),
      limits_(limits),
      matrices_(cost_matrices(problem)),
      sequences_(joint_sequences(matrices_, backend, limits)),
      orders_(problem.instance.agent_count()),
      low_level_(problem.instance.world()),
      others_(problem.instance.world()) {}

Cost SequenceForest::next_bound() const {
  const Cost rest = sequences_.lower_bound();
  return pending_ ? std::min(pending_->cost, rest) : rest;
}

NodePtr SequenceForest::next_root() {
  if (!pending_) {
    const Cost bound = sequences_.lower_bound();
    pending_ = sequences_.next();
    GROVE_CHECK(
        !pending_ || (pending_->cost >= bound && sequences_.lower_bound() >= pending_->cost),
        "joint sequences come in ascending order of cost");
  }
  if (!pending_ || !plan_missing_orders(*pending_)) return nullptr;

  Tree& tree = trees_.emplace_back();
  tree.world = &problem_.instance.world();
  tree.pool = &pool_;
  tree.number = count_;
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent)
    tree.orders.push_back(slot(agent, pending_->ranks[agent]));
  GROVE_ASSERT(std::ranges::count(trees_, tree.orders, &Tree::orders) == 1,
               "no two trees fix the same sequences");
  NodePtr root = Node::root(tree);
  GROVE_CHECK(root->cost() >= pending_->cost, "a root costs at least its joint sequence");
  ++count_;
  pending_.reset();  // last: an exception before this line loses no tree
  return root;
}

std::shared_ptr<const AgentSequencing>& SequenceForest::slot(AgentIndex agent, std::uint32_t rank) {
  auto& ranks = orders_[agent];
  if (ranks.size() <= rank) ranks.resize(rank + 1);
  return ranks[rank];
}

// Plans the paths that no earlier tree has used. Returns false if a limit was reached.
bool SequenceForest::plan_missing_orders(const JointSequence& joint) {
  std::vector<AgentIndex> missing;
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent)
    if (!slot(agent, joint.ranks[agent])) missing.push_back(agent);
  if (missing.empty()) return true;

  others_.clear();
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent)
    if (const auto& order = slot(agent, joint.ranks[agent])) avoid(agent, order->path.view());
  for (AgentIndex agent : missing)
    if (!plan_order(agent, joint.ranks[agent])) return false;
  return true;
}

bool SequenceForest::plan_order(AgentIndex agent, std::uint32_t rank) {
  const Instance& instance = problem_.instance;
  const Sequence& sequence = sequences_.sequence(agent, rank);
  GoalSequence goals = goals_in_order(problem_, agent, sequence);
  const PathOutcome outcome = low_level_.find(goals, {.others = &others_}, limits_, path_);
  if (outcome == PathOutcome::kStopped) return false;
  if (outcome != PathOutcome::kFound)
    throw std::logic_error("internal error: a sequence of finite cost has no path");
  GROVE_CHECK(static_cast<Time>(path_.size()) - 1 >= goals.distance(goals.start(), 0),
              "no path through the goals is shorter than their distances");
  PackedPath packed(instance.world(), path_);
  others_.add(path_);
  slot(agent, rank) = std::make_shared<const AgentSequencing>(
      AgentSequencing{{sequence, 0}, std::move(goals), std::move(packed)});
  return true;
}

void SequenceForest::avoid(AgentIndex agent, const PackedSteps& path) {
  path.unpack(problem_.instance.world(), problem_.instance.agent(agent).start, path_);
  others_.add(path_);
}

}  // namespace grove::detail
