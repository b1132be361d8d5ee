// SPDX-License-Identifier: MIT
// Algorithm 1 of the paper, lines 9-22: validate the node's paths; if they conflict, first see what
// more can be said about the node's bound - a node whose bound rises goes back to the frontier,
// where others may now be better - then branch.
#include "grove/search/expander.h"

#include <numeric>

namespace grove {

struct Expander::Leaving {
  Expander& expander;
  ~Leaving() {
    expander.brancher_.leave();
    expander.dependencies_.leave();
  }
};

Expander::Expander(const Problem& problem, AgentStopsStore& stops, Techniques techniques,
                   std::uint64_t seed, std::shared_ptr<CommonMemory> memory)
    : problem_(problem),
      techniques_(techniques),
      planner_(problem, stops),
      memory_(planner_, std::move(memory)),
      brancher_(problem, techniques, seed, planner_, memory_),
      dependencies_(problem, techniques, seed, planner_, memory_),
      all_(static_cast<std::size_t>(problem.instance.agent_count())) {
  std::iota(all_.begin(), all_.end(), 0);
}

Expansion Expander::expand(const NodePtr& node, Cost cutoff, const Limits& limits) {
  const Leaving at_last{*this};
  Expansion expansion;
  const auto stopped = [] {
    Expansion nothing;
    nothing.stopped = true;
    return nothing;
  };
  brancher_.enter(node, all_);
  if (brancher_.conflict_free()) {
    expansion.plan = plan(*node);
    return expansion;
  }
  if (techniques_.has(Technique::kDependencies) && !node->is_bounded()) {
    Cost bound = 0;
    switch (dependencies_.find_bound(node, brancher_, cutoff, limits, bound)) {
      case Dependencies::Outcome::kStopped:
        return stopped();
      case Dependencies::Outcome::kUnfinished:
        expansion.unfinished = true;
        return expansion;
      case Dependencies::Outcome::kDone:
        break;
    }
    if (bound >= cutoff) return expansion;
    if (bound > node->bound()) {
      Change change;
      change.cost = node->cost();
      change.bound = bound;
      change.conflicts = node->conflicts();
      change.bounded = true;
      expansion.children.push_back(Node::child(node, problem_.instance.grid(), change));
      return expansion;
    }
  }
  splits_.clear();
  if (techniques_.has(Technique::kCostSplits)) dependencies_.splits(brancher_, splits_);
  switch (brancher_.branch(cutoff, splits_, limits, expansion.children)) {
    case Brancher::Outcome::kStopped:
      return stopped();
    case Brancher::Outcome::kConflictFree:
      expansion.plan = plan(*node);
      break;
    case Brancher::Outcome::kBranched:
      break;
  }
  return expansion;
}

bool Expander::help(const NodePtr& node, Cost cutoff, double share, const Limits& limits) {
  const Leaving at_last{*this};
  brancher_.enter(node, all_);
  return dependencies_.help(node, brancher_, cutoff, share, limits);
}

// The plan of the brancher's paths, which are conflict-free.
Plan Expander::plan(const Node& node) {
  Plan plan;
  for (AgentIndex i = 0; i < problem_.instance.agent_count(); ++i) {
    const Path& path = brancher_.path(i);
    const Sequence sequence = planner_.sequence(i, *node.tree().orders[i], {}, path);
    const auto cost = static_cast<Time>(path.size() - 1);
    plan.cost += cost;
    plan.agents.push_back({cost, tasks_in_order(problem_.instance.agent(i), sequence), path});
  }
  return plan;
}

ExpansionCounts Expander::counts() const {
  const Brancher& pairs = dependencies_.pair_view();
  return {planner_.calls(),
          planner_.expanded(),
          dependencies_.expansions(),
          planner_.optimal_nodes() + brancher_.optimal_nodes() + pairs.optimal_nodes(),
          dependencies_.joint_pairs(),
          memory_.asked(),
          memory_.groups_asked(),
          brancher_.steps() + pairs.steps()};
}

}  // namespace grove
