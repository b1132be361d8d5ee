// SPDX-License-Identifier: MIT
// Expansion of a node: Algorithm 1 of the paper, lines 9-22. Finds the conflicts of the node's
// paths; if there are none, the node yields a plan. Otherwise the WDG heuristic first tries to
// raise the node's bound, unless it has done so before. A node whose bound rises returns to the
// frontier, where other nodes may now be better, or is dropped if the bound reaches the cutoff. If
// the bound does not rise, the node is split.
#include "search/expander.h"

#include <array>
#include <numeric>

#include "model/assert.h"
#include "model/effort.h"

namespace grove::detail {
namespace {

// By kind of the second constraint of a split; nullopt: no split has this kind.
const std::array<std::optional<Counter>, kConstraintKinds>& split_counters() {
  static const auto counters = [] {
    std::array<std::optional<Counter>, kConstraintKinds> found;
    for (std::uint8_t kind = 0; kind < kConstraintKinds; ++kind)
      if (const auto known = constraint_kind(kind))
        found[kind] = counter_named("splits_", split_name(*known));
    return found;
  }();
  return counters;
}

}  // namespace

ExpansionCounts& ExpansionCounts::operator+=(const ExpansionCounts& more) {
  reported += more.reported;
  mdd_nodes += more.mdd_nodes;
  group_work += more.group_work;
  subproblems += more.subproblems;
  groups += more.groups;
  path_steps += more.path_steps;
  return *this;
}

ExpansionCounts& ExpansionCounts::operator-=(const ExpansionCounts& less) {
  reported -= less.reported;
  mdd_nodes -= less.mdd_nodes;
  group_work -= less.group_work;
  subproblems -= less.subproblems;
  groups -= less.groups;
  path_steps -= less.path_steps;
  return *this;
}

struct Expander::Leaving {
  Expander& expander;
  ~Leaving() {
    expander.view_.leave();
    expander.dependencies_.leave();
  }
};

Expander::Expander(const Problem& problem, AgentStopsCache& stops, const SearchOptions& options,
                   std::shared_ptr<SharedCache> memory, std::unique_ptr<AgentPlanner> planner)
    : problem_(problem),
      techniques_(options.techniques),
      proof_(options.proof),
      planner_(problem, stops, std::move(planner), options.repeatable),
      memory_(planner_, std::move(memory), options.tuning.mdd_nodes),
      view_(problem, options, memory_),
      brancher_(problem, options, planner_, memory_),
      dependencies_(problem, options, planner_, memory_),
      all_(static_cast<std::size_t>(problem.instance.agent_count())) {
  std::iota(all_.begin(), all_.end(), 0);
}

void Expander::enter(const NodePtr& node) {
  view_.enter(node, all_);
  work_on_nodes_ += node->cost() / effort::kScannedSteps + 1;
}

Expansion Expander::expand(const NodePtr& node, Cost cutoff, const Limits& limits,
                           BoundingEffort bounding_effort) {
  const Leaving at_last{*this};
  Expansion expansion;
  expansion.cutoff = cutoff;
  const auto stopped = [] {
    Expansion nothing;
    nothing.stopped = true;
    return nothing;
  };
  enter(node);
  if (view_.conflict_free()) {
    expansion.plan = plan(*node);
    return expansion;
  }
  if (techniques_.has(Technique::kWdg) && !node->is_bounded()) {
    Cost bound = 0;
    switch (dependencies_.find_bound(node, view_, cutoff, bounding_effort, limits, bound)) {
      case WdgHeuristic::Outcome::kStopped:
        return stopped();
      case WdgHeuristic::Outcome::kUnfinished:
        expansion.unfinished = true;
        return expansion;
      case WdgHeuristic::Outcome::kDone:
        break;
    }
    GROVE_CHECK(bound == cutoff || (bound >= node->cost() && bound < cutoff),
                "a node's bound is the cutoff, or from its cost to the cutoff");
    if (bound >= cutoff) return expansion;
    if (bound > node->bound()) {
      NodeDelta change;
      change.cost = node->cost();
      change.bound = bound;
      change.conflicts = node->conflicts();
      change.bounded = true;
      expansion.children.push_back(Node::child(node, change));
      return expansion;
    }
  }
  splits_.clear();
  if (techniques_.has(Technique::kCostSplits)) dependencies_.splits(view_, splits_);
  switch (brancher_.branch(view_, cutoff, splits_, limits, expansion.children)) {
    case Brancher::Outcome::kStopped:
      return stopped();
    case Brancher::Outcome::kConflictFree:
      expansion.plan = plan(*node);
      break;
    case Brancher::Outcome::kBranched:
      expansion.branching = brancher_.branching();
      if (proof_ != nullptr && expansion.branching)
        log_proof(*expansion.branching, node, expansion.children, cutoff);
      break;
  }
  return expansion;
}

// Logs the split. A branch without a child gets the cost `cutoff`, because it holds no plan cheaper
// than the cutoff.
void Expander::log_proof(const Branching& branching, const NodePtr& node,
                         std::span<const NodePtr> children, Cost cutoff) {
  const Split& split = branching.split;
  ProofSplit written{proof_key(*node), split, {cutoff, cutoff}};
  for (const NodePtr& child : children) {
    GROVE_CHECK(child->added() == split[0] || child->added() == split[1],
                "a child adds one side of the split");
    written.costs[child->added() == split[0] ? 0 : 1] = child->cost();
  }
  GROVE_CHECK(std::ranges::min(written.costs) >= node->cost(),
              "neither side of a split costs less than the node");
  if (splits_on_costs(split)) written.lemma = dependencies_.lemma_key(view_, split);
  proof_->split(written);
}

bool Expander::help(const NodePtr& node, Cost cutoff, double share, const Limits& limits) {
  const Leaving at_last{*this};
  enter(node);
  return dependencies_.help(node, view_, cutoff, share, limits);
}

// The plan that consists of the paths in the view, which are conflict-free.
Plan Expander::plan(const Node& node) {
  Plan plan;
  for (AgentIndex i = 0; i < problem_.instance.agent_count(); ++i) {
    const Path& path = view_.path(i);
    const AgentSequencing& order = *node.tree().orders[i];
    plan.agents.push_back(
        order.visits ? agent_plan_of_visits(problem_.instance, i, *order.visits, path)
                     : agent_plan(problem_.instance, i, planner_.sequence(i, order, path), path));
    plan.cost += plan.agents.back().cost;
  }
  GROVE_CHECK(plan.cost == node.cost(), "the plan of a node has the node's cost");
  return plan;
}

double Expander::whole_work() const {
  const auto times = [](double rate, std::int64_t of) { return rate * static_cast<double>(of); };
  return static_cast<double>(planner_.work() + dependencies_.joint_groups().work()) +
         times(effort::kPerOptimalNode,
               planner_.mdd_nodes() + brancher_.mdd_nodes() + dependencies_.mdd_nodes()) +
         times(effort::kPerJointPair, dependencies_.joint_mdd_nodes()) +
         times(effort::kPerSubproblem, memory_.asked()) +
         times(effort::kPerGroup, memory_.groups_asked()) +
         times(effort::kPerStepSeen, view_.steps() + dependencies_.steps());
}

ExpansionCounts Expander::counts() const {
  ExpansionCounts counts;
  Counters& reported = counts.reported;
  reported[Counter::kLowLevelCalls] = planner_.calls();
  reported[Counter::kLowLevelExpanded] = planner_.expanded();
  reported[Counter::kPairExpansions] = dependencies_.expansions();
  reported[Counter::kJointMddNodes] = dependencies_.joint_mdd_nodes();
  reported[Counter::kGroupStates] = dependencies_.joint_groups().states();
  for (std::size_t kind = 0; kind < kConstraintKinds; ++kind)
    if (const std::int64_t splits = brancher_.splits()[kind]; splits > 0)
      reported[split_counters()[kind].value()] += splits;
  reported[Counter::kBypasses] = brancher_.bypasses();
  reported[Counter::kBranchingCostQueries] = brancher_.child_costs().asked();
  reported[Counter::kBranchingCostHits] = brancher_.child_costs().known();
  reported[Counter::kMddQueries] = memory_.mdd_queries();
  reported[Counter::kMddHits] = memory_.mdd_hits();
  counts.mdd_nodes = planner_.mdd_nodes() + brancher_.mdd_nodes() + dependencies_.mdd_nodes();
  counts.group_work = dependencies_.joint_groups().work();
  counts.subproblems = memory_.asked();
  counts.groups = memory_.groups_asked();
  counts.path_steps = view_.steps() + dependencies_.steps();
  return counts;
}

}  // namespace grove::detail
