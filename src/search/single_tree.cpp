// SPDX-License-Identifier: MIT
// *Claim: one tree holds every plan.* *Proof.* A node's bound is the sum of the agents' costs, each
// of which is the minimum over *all* orders of the agent's stops under its constraints. Splitting a
// conflict loses no plan, in whatever order agents visit their stops. So the tree of the classes
// with empty prefix is plain CBS whose low level solves a larger problem.
#include "search/single_tree.h"

#include <stdexcept>
#include <utility>

#include "model/assert.h"
#include "planning/free_order_sipp.h"

namespace grove::detail {

SingleTree::SingleTree(const Problem& problem, AgentStopsCache& stops, NodePool& pool,
                       const Limits& limits, std::unique_ptr<AgentPlanner> planner)
    : problem_(problem),
      stops_(stops),
      pool_(pool),
      limits_(limits),
      planner_(planner ? std::move(planner)
                       : std::make_unique<FreeOrderSipp>(problem.instance.world())) {
  for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent)
    relaxed_bound_ += stops.of(agent).cost_to_go().relaxed_bound();
}

// Plans the agents one after the other, each around the paths of the earlier ones, which avoids
// conflicts caused by mere ties.
NodePtr SingleTree::next_root() {
  if (!tree_.empty()) return nullptr;
  ConflictAvoidanceTable others(problem_.instance.world());
  std::vector<std::shared_ptr<const AgentSequencing>> orders;
  Path path;
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent) {
    SequenceStages goals(stops_.of(agent), SequenceClass());
    const PathOutcome outcome = planner_->find(goals, {.others = &others}, limits_, path);
    if (outcome == PathOutcome::kStopped) return nullptr;
    if (outcome != PathOutcome::kFound)
      throw std::logic_error("internal error: an agent that can reach all its cells has no path");
    others.add(path);
    orders.push_back(std::make_shared<const AgentSequencing>(
        AgentSequencing{{}, std::nullopt, PackedPath(problem_.instance.world(), path)}));
  }
  planner_.reset();
  Tree& tree = tree_.emplace_back(Tree{&problem_.instance.world(), &pool_, 0, std::move(orders)});
  NodePtr root = Node::root(tree);
  GROVE_CHECK(root->cost() >= relaxed_bound_,
              "the root costs at least the bound of the relaxation");
  return root;
}

}  // namespace grove::detail
