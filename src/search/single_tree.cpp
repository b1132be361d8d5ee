// SPDX-License-Identifier: MIT
// Why one tree is enough. A node's bound is the sum of the agents' costs, each the least over *all*
// orders of its stops under its constraints; splitting a conflict loses no plan whatever the
// orders. So the tree of the empty-prefixed classes is plain CBS whose low level solves a larger
// problem, and it holds every plan there is.
#include "grove/search/single_tree.h"

#include <stdexcept>
#include <utility>

namespace grove {

SingleTree::SingleTree(const Problem& problem, AgentStopsStore& stops, NodePool& pool,
                       const Limits& limits)
    : problem_(problem), stops_(stops), pool_(pool), limits_(limits) {
  for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent)
    relaxed_bound_ += stops.of(agent).completions().relaxed_bound();
}

// Plans the agents one after the other around those before, which spares conflicts that are mere
// ties.
NodePtr SingleTree::next_root() {
  if (!tree_.empty()) return nullptr;
  PathPlanner planner(problem_, stops_);
  ConflictAvoidanceTable others(problem_.instance.grid());
  std::vector<std::shared_ptr<const AgentOrder>> orders;
  Path path;
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent) {
    AgentOrder open{{}, std::nullopt, PackedPath()};
    const auto outcome = planner.find(agent, open, {}, &others, kNever, limits_, path);
    if (outcome == PathPlanner::Outcome::kStopped) return nullptr;
    if (outcome == PathPlanner::Outcome::kInfeasible)
      throw std::logic_error("internal error: an agent that can reach all its cells has no path");
    open.path = PackedPath(problem_.instance.grid(), path);
    others.add(path);
    orders.push_back(std::make_shared<const AgentOrder>(std::move(open)));
  }
  Tree& tree = tree_.emplace_back(Tree{&pool_, 0, std::move(orders)});
  return Node::root(tree);
}

}  // namespace grove
