// SPDX-License-Identifier: MIT
// Branching: Algorithm 1 of the paper, lines 13-22. Chooses a conflict of the node, creates one
// child for each way to resolve it, and re-plans under the *child's* constraints. (The paper's line
// 17 plans under the parent's constraints, which would repeat the conflict forever.)
//
// *Choice of the conflict.* Strong branching, as in integer programming (Applegate et al. 1995; for
// CBS the idea behind cardinal conflicts, Boyarski et al. 2015). For every split that the node's
// conflicts allow, the increase of the sum of costs is computed exactly for both branches; a split
// for which a computation exceeds the label limit is not considered. The split whose smaller
// increase is largest is chosen; the larger increase breaks ties. The increases are differences of
// costs of single agents under constraints. These costs are cached, because most conflicts of a
// node were already evaluated at its parent. The increase of a branch that cannot lead to a plan
// cheaper than the cutoff counts as infinite; a split with two such branches closes the node.
//
// *Fewest conflicts.* Of the cheapest paths of a branch, one with the fewest conflicts is computed
// (fewest_conflicts.cpp), unless their MDD would be too large, because the low level by itself
// examines few of the ways to spend a delay.
//
// *Bypassing* (Boyarski et al. 2015). If the paths of a branch cost no more than those of the node
// and have fewer conflicts, they replace the node's paths, and the node is not split. This is sound
// because they satisfy all constraints of the node at the node's cost.
//
// *Claim: no plan is lost.* *Proof.* A split is a pair of constraints such that every conflict-free
// plan satisfies at least one of them (see conflict.cpp, target.cpp, corridor.cpp). This holds
// whichever split is chosen and whatever the paths are. A branch is closed only if the sum of costs
// reaches the cutoff under its constraint and those of the node. For each agent that is
// not re-planned, the sum contains its cost at the node, which is a lower bound.
#include "search/brancher.h"

#include <algorithm>
#include <array>
#include <utility>

#include "model/assert.h"
#include "search/audit.h"
#include "search/splits.h"

namespace grove::detail {
namespace {

constexpr int kMaxBypasses = 64;  // bypasses per call

// Pseudo-random priority of the pair of agents (the finaliser of SplitMix64, Steele et al. 2014).
std::uint64_t priority(const Conflict& conflict, std::uint64_t seed) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15 + (static_cast<std::uint64_t>(conflict.first) << 32) +
                    static_cast<std::uint64_t>(conflict.second);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

}  // namespace

Brancher::Brancher(const Problem& problem, const SearchOptions& options, PathPlanner& planner,
                   WorkerCache& memory)
    : problem_(problem),
      options_(options),
      planner_(planner),
      memory_(memory),
      child_costs_(planner, memory, options.tuning.strong_branching_labels),
      avoidance_table_(problem.instance.world()),
      table_paths_(problem.instance.agent_count()) {}

// The number of bypasses per call is limited. Each bypass lowers the counted number of conflicts,
// but this count is not symmetric for two agents that rest on one cell, so it does not prove that
// the bypasses end.
Brancher::Outcome Brancher::branch(NodeView& view, Cost cutoff,
                                   std::span<const Split> fallback_splits, const Limits& limits,
                                   std::vector<NodePtr>& children) {
  branching_.reset();
  const Task task{view, cutoff - view.node()->cost() - 1, limits};
  if (task.slack < 0) return Outcome::kBranched;
  for (std::int64_t round = 0; !view.conflict_free(); ++round) {
    update_avoidance_table(view);
    Branching chosen;
    if (!choose(task, fallback_splits, chosen)) return Outcome::kStopped;
    const Split& split = chosen.split;
    for (int i = 0; i < 2; ++i)
      if (!evaluate_branch(task, split[i], branches_[i])) return Outcome::kStopped;
    if (round < kMaxBypasses && (bypass(view, branches_[0]) || bypass(view, branches_[1])))
      continue;
    ++splits_made_[static_cast<std::size_t>(split[1].constraint.kind)];
    branching_ = chosen;
    const NodePtr parent = view.node_with_current_paths();
    for (int i = 0; i < 2; ++i)
      if (branches_[i].open) children.push_back(child(view, parent, split[i], branches_[i]));
    return Outcome::kBranched;
  }
  return Outcome::kConflictFree;
}

// Updates the conflict avoidance table to the paths in scope. Most paths are the same as at the
// previous node.
void Brancher::update_avoidance_table(const NodeView& view) {
  for (std::size_t agent = 0; agent < table_paths_.size(); ++agent) {
    const Path& path = view.paths()[agent];
    if (table_paths_[agent] == path) continue;
    avoidance_table_.remove(table_paths_[agent]);
    avoidance_table_.add(path);
    table_paths_[agent] = path;
  }
  if (options_.audit) audit(problem_, avoidance_table_, view.paths());
}

// Chooses the split that raises the bounds most. Without strong branching, or if no split could be
// evaluated, chooses the preferred split of an earliest conflict.
bool Brancher::choose(const Task& task, std::span<const Split> fallback_splits, Branching& chosen) {
  const Techniques techniques = options_.techniques;
  if (!techniques.has(Technique::kStrongBranching)) {
    chosen = earliest(task.view);
    return true;
  }
  Choice best;
  for (const Conflict& conflict : task.view.conflicts()) {
    splits_.clear();
    splits_of(conflict, task.view.paths(), problem_, techniques, splits_);
    for (const Split& split : splits_)
      if (!improve(best, {conflict, split}, task)) return false;
  }
  for (const Split& split : fallback_splits) {
    if (best.gain.second > 0) break;
    const Conflict* conflict = task.view.conflict_between(split[0].agent, split[1].agent);
    if (conflict && !improve(best, {*conflict, split}, task)) return false;
  }
  chosen = best.gain.first >= 0 ? best.branching : earliest(task.view);
  return true;
}

bool Brancher::improve(Choice& choice, const Branching& by, const Task& task) {
  std::array<Cost, 2> increases{};
  for (int i = 0; i < 2; ++i) {
    const auto outcome =
        child_costs_.increase(task.view, by.split[i], task.slack, task.limits, increases[i]);
    if (outcome != ChildCosts::Outcome::kDone) return outcome == ChildCosts::Outcome::kTooHard;
  }
  const std::pair<Cost, Cost> gain = std::minmax(increases[0], increases[1]);
  if (gain > choice.gain) choice = {gain, by};
  return true;
}

Branching Brancher::earliest(const NodeView& view) {
  const Conflict* best = &view.conflicts().front();
  for (const Conflict& conflict : view.conflicts()) {
    if (conflict.time > best->time) break;
    if (priority(conflict, options_.seed) < priority(*best, options_.seed)) best = &conflict;
  }
  splits_.clear();
  splits_of(*best, view.paths(), problem_, options_.techniques, splits_);
  return {*best, splits_[splits_.size() > 1 ? 1 : 0]};
}

// Re-plans the agents of one branch, preferring few conflicts with the paths of other agents.
// evaluate_branch(), replan() and replan_one() return false where branch() must return kStopped.
bool Brancher::evaluate_branch(const Task& task, const AgentConstraint& constraint, Branch& side) {
  side.open = true;
  side.increase = 0;
  side.conflicts = 0;
  side.paths.clear();
  task.view.affected_agents(constraint, side.agents);
  for (AgentIndex agent : side.agents) {
    avoidance_table_.remove(task.view.path(agent));
    side.conflicts -= avoidance_table_.conflicts_of(task.view.path(agent));
  }
  const bool done = replan(task, constraint, side);
  GROVE_ASSERT(!done || !side.open || side.paths.size() == side.agents.size(),
               "an open branch has a new path for each agent that it affects");
  GROVE_ASSERT(!done || !side.open || (side.increase >= 0 && side.increase <= task.slack),
               "the cost of an open branch rises by at most the slack");
  for (const Path& path : side.paths) avoidance_table_.remove(path);
  for (AgentIndex agent : side.agents) avoidance_table_.add(task.view.path(agent));
  return done;
}

bool Brancher::replan(const Task& task, const AgentConstraint& constraint, Branch& side) {
  for (AgentIndex agent : side.agents) {
    const Time cutoff = cutoff_for(task.view, agent, task.slack - side.increase);
    if (!replan_one(task, agent, *constraint_on(agent, constraint), cutoff, side.open))
      return false;
    if (!side.open) return true;
    GROVE_ASSERT(static_cast<Time>(path_.size()) - 1 >= task.view.cost_of(agent),
                 "no new path of an agent costs less than its path at the node");
    GROVE_ASSERT(satisfies(problem_.instance.world(), path_, *constraint_on(agent, constraint),
                           problem_.corridors),
                 "a new path satisfies the constraint of its branch");
    side.increase += static_cast<Cost>(path_.size()) - 1 - task.view.cost_of(agent);
    side.conflicts += avoidance_table_.conflicts_of(path_);
    avoidance_table_.add(path_);
    side.paths.push_back(path_);
  }
  return true;
}

// Writes a cheapest path under the additional constraint `more` to path_ if it costs at most
// `cutoff`, and sets `found` to whether it does.
bool Brancher::replan_one(const Task& task, AgentIndex agent, const Constraint& more, Time cutoff,
                          bool& found) {
  const AgentSequencing& order = task.view.order(agent);
  if (options_.techniques.has(Technique::kFewestConflicts)) {
    Time cost = 0;
    if (child_costs_.cost(task.view, agent, more, cutoff, PathQuery::kUnlimited, task.limits,
                          cost) != ChildCosts::Outcome::kDone)
      return false;
    found = cost <= cutoff;
    if (!found) return true;
    const auto constraints = task.view.constraints_with(agent, more);
    const SubproblemTable::Id id = memory_.id(agent, order, constraints);
    const Mdd* paths = memory_.paths(id, agent, order, constraints, cost, task.limits);
    if (!paths) return false;
    if (!paths->empty()) {
      fewest_conflicts_.find(*paths, avoidance_table_, path_);
      return true;
    }
  }
  const PathQuery query{.constraints = task.view.constraints_with(agent, more),
                        .others = &avoidance_table_,
                        .cutoff = cutoff};
  const PathOutcome outcome = planner_.find(agent, order, query, task.limits, path_);
  found = outcome == PathOutcome::kFound;
  return outcome != PathOutcome::kStopped;
}

// Replaces the node's paths by those of a branch if this costs nothing and leaves fewer conflicts.
// Returns whether it did.
bool Brancher::bypass(NodeView& view, const Branch& side) {
  if (!options_.techniques.has(Technique::kBypass)) return false;
  if (!side.open || side.increase > 0 || side.conflicts >= 0) return false;
  view.reroute(side.agents, side.paths);
  ++bypasses_;
  return true;
}

NodePtr Brancher::child(const NodeView& view, const NodePtr& parent,
                        const AgentConstraint& constraint, const Branch& side) const {
  std::vector<NewPath> paths;
  for (std::size_t i = 0; i < side.agents.size(); ++i)
    paths.push_back({side.agents[i], &side.paths[i]});
  NodeDelta change;
  change.added = constraint;
  change.paths = paths;
  change.cost = view.node()->cost() + side.increase;
  const int conflicts = static_cast<int>(view.conflicts().size()) + side.conflicts;
  change.conflicts = static_cast<std::uint32_t>(std::max(0, conflicts));
  GROVE_ASSERT(parent->cost() == view.node()->cost() && change.cost >= parent->cost(),
               "a child costs at least as much as its parent");
  return Node::child(parent, change);
}

}  // namespace grove::detail
