// SPDX-License-Identifier: MIT
// Algorithm 1 of the paper, lines 9-22: validate the node's paths; on a conflict make one child for
// each agent involved, which replans under the *child's* constraints (the paper's line 17 plans
// under the parent's and would repeat the conflict for ever).
#include "grove/search/expander.h"

namespace grove {

Expander::Expander(const Problem& problem, std::uint64_t seed)
    : problem_(problem),
      conflicts_(problem.instance.grid(), seed),
      others_(problem.instance.grid()),
      planner_(problem) {}

Expansion Expander::expand(const NodePtr& node, const Limits& limits) {
  Expansion expansion;
  node->paths(problem_, paths_);
  const std::optional<Conflict> conflict = conflicts_.first(paths_);
  if (!conflict) {
    expansion.plan = plan(*node);
    return expansion;
  }

  show_others();
  for (const AgentConstraint& added : split(*conflict)) {
    others_.remove(paths_[added.agent]);
    const bool done = branch(node, added, limits, expansion);
    others_.add(paths_[added.agent]);
    if (done) continue;
    Expansion stopped;
    stopped.stopped = true;
    return stopped;
  }
  return expansion;
}

// The plan of paths_, the conflict-free paths of `node`.
Plan Expander::plan(const Node& node) {
  Plan plan;
  for (AgentIndex i = 0; i < problem_.instance.agent_count(); ++i) {
    const Sequence sequence = planner_.sequence(i, *node.tree().orders[i], paths_[i]);
    const auto cost = static_cast<Time>(paths_[i].size() - 1);
    plan.cost += cost;
    plan.agents.push_back({cost, tasks_in_order(problem_.instance.agent(i), sequence), paths_[i]});
  }
  return plan;
}

// Brings the table up to the node's paths. Most are those of the node expanded before.
void Expander::show_others() {
  shown_.resize(paths_.size());
  for (std::size_t agent = 0; agent < paths_.size(); ++agent) {
    if (shown_[agent] == paths_[agent]) continue;
    others_.remove(shown_[agent]);
    others_.add(paths_[agent]);
    shown_[agent] = paths_[agent];
  }
}

// Adds the child that obeys `added`, if it has a path. False when a limit struck.
bool Expander::branch(const NodePtr& node, const AgentConstraint& added, const Limits& limits,
                      Expansion& expansion) {
  const AgentIndex agent = added.agent;
  constraints_.assign(1, added.constraint);
  node->constraints(agent, constraints_);

  ++expansion.low_level_calls;
  const LowLevelSearch::Outcome outcome =
      planner_.find(agent, *node->tree().orders[agent], constraints_, &others_, limits, path_);
  if (outcome == LowLevelSearch::Outcome::kStopped) return false;
  if (outcome == LowLevelSearch::Outcome::kInfeasible) return true;

  const auto old_cost = static_cast<Cost>(paths_[agent].size());
  const Cost cost = node->cost() - old_cost + static_cast<Cost>(path_.size());
  expansion.children.push_back(Node::child(node, problem_.instance.grid(), added, path_, cost));
  return true;
}

}  // namespace grove
