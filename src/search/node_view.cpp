// SPDX-License-Identifier: MIT
#include "search/node_view.h"

#include <algorithm>

#include "model/assert.h"
#include "search/audit.h"

namespace grove::detail {
namespace {

Cost sum_of_costs(std::span<const Path> paths) {
  Cost sum = 0;
  for (const Path& path : paths) sum += std::ssize(path) - 1;
  return sum;
}

}  // namespace

NodeView::NodeView(const Problem& problem, const SearchOptions& options, WorkerCache& memory)
    : problem_(problem),
      audit_(options.audit),
      memory_(memory),
      finder_(problem.instance.world(), problem.instance.may_follow()) {}

void NodeView::enter(const NodePtr& node, std::span<const AgentIndex> scope) {
  GROVE_ASSERT(node && std::ranges::is_sorted(scope),
               "the agents of a scope are in ascending order");
  if (audit_) audit(problem_, *node, scope);
  node_ = node;
  scope_.assign(scope.begin(), scope.end());
  rerouted_.clear();
  node->paths(problem_, scope_, paths_);
  GROVE_ASSERT(scope_.size() < paths_.size() || sum_of_costs(paths_) == node->cost(),
               "a node costs as much as its paths");
  update_constraints();
  find_conflicts();
}

// Updates only agents whose constraints differ from those at the last node. Most agents have the
// same constraints at both.
void NodeView::update_constraints() {
  node_->constraints(constraints_);
  for (auto* by_agent : {&agent_cache_.node_constraints, &agent_cache_.constraints})
    by_agent->resize(constraints_.size());
  agent_cache_.subproblems.resize(constraints_.size());
  for (const AgentIndex agent : scope_) {
    if (constraints_[agent] == agent_cache_.node_constraints[agent]) continue;
    agent_cache_.constraints[agent] = constraints_[agent];
    canonical(agent_cache_.constraints[agent]);
    agent_cache_.subproblems[agent] = {};
    std::swap(constraints_[agent],
              agent_cache_.node_constraints[agent]);  // last: the rest may throw
  }
}

void NodeView::find_conflicts() {
  finder_.all(paths_, scope_, conflicts_);
  GROVE_ASSERT(std::ranges::is_sorted(conflicts_, {}, &Conflict::time),
               "conflicts are in order of time");
  GROVE_ASSERT(std::ranges::all_of(conflicts_,
                                   [&](const Conflict& c) {
                                     return c.first < c.second && is_in_scope(c.first) &&
                                            is_in_scope(c.second);
                                   }),
               "a conflict is of two agents in scope, the smaller index first");
  for (const AgentIndex agent : scope_) steps_ += std::ssize(paths_[agent]);
}

SubproblemTable::Id NodeView::subproblem(AgentIndex agent) {
  GROVE_ASSERT(is_in_scope(agent), "only agents in scope are up to date");
  AgentCache::CachedSubproblem& known = agent_cache_.subproblems[agent];
  const AgentSequencing& order = this->order(agent);
  if (known.order != &order || known.numbering != memory_.numbering())
    known = {&order, memory_.numbering(),
             memory_.id(agent, order, agent_cache_.constraints[agent])};
  return known.id;
}

std::span<const Constraint> NodeView::constraints_with(AgentIndex agent, const Constraint& more) {
  extended_ = agent_cache_.constraints[agent];
  add_to_canonical(extended_, more);
  return extended_;
}

const Conflict* NodeView::conflict_between(AgentIndex a, AgentIndex b) const {
  const auto found = std::ranges::find_if(conflicts_, [&](const Conflict& c) {
    return c.first == std::min(a, b) && c.second == std::max(a, b);
  });
  return found == conflicts_.end() ? nullptr : &*found;
}

void NodeView::affected_agents(const AgentConstraint& constraint,
                               std::vector<AgentIndex>& agents) const {
  agents.clear();
  for_each_implied_constraint(constraint, scope_, [&](AgentIndex agent, const Constraint& c) {
    if (!satisfies(problem_.instance.world(), paths_[agent], c, problem_.corridors))
      agents.push_back(agent);
  });
}

void NodeView::reroute(std::span<const AgentIndex> agents, std::span<const Path> paths) {
  for (std::size_t i = 0; i < agents.size(); ++i) {
    GROVE_ASSERT(paths[i].size() == paths_[agents[i]].size(),
                 "a new path costs as much as the one that it replaces");
    paths_[agents[i]] = paths[i];
    if (std::ranges::count(rerouted_, agents[i]) == 0) rerouted_.push_back(agents[i]);
  }
  find_conflicts();
}

NodePtr NodeView::node_with_current_paths() const {
  if (rerouted_.empty()) return node_;
  std::vector<NewPath> paths;
  for (AgentIndex agent : rerouted_) paths.push_back({agent, &paths_[agent]});
  NodeDelta change;
  change.paths = paths;
  change.cost = node_->cost();
  return Node::child(node_, change);
}

}  // namespace grove::detail
