// SPDX-License-Identifier: MIT
// Algorithm 1 of the paper, lines 13-22: on a conflict make one child for each way to resolve it,
// which replans under the *child's* constraints (the paper's line 17 plans under the parent's and
// would repeat the conflict for ever).
//
// Which conflict. *Strong branching*, as in integer programming (Applegate et al. 1995; for CBS the
// idea behind cardinal conflicts, Boyarski et al. 2015): of every split that the node's conflicts
// allow, both sides are priced exactly - by how much does the sum of costs rise? - and the one
// whose cheaper side rises most is taken. The prices are costs of single agents under constraints,
// which the memory keeps: among the conflicts of a node most were priced at its parent. A side
// that cannot lead to a plan cheaper than the cutoff counts as infinitely dear, and a split with
// two such sides ends the node.
//
// *Fewest conflicts.* Of the paths of the side taken, all as cheap, one with the fewest conflicts
// is found (fewest_conflicts.cpp): the low level alone sees few of the ways to spend a delay.
//
// Bypassing (Boyarski et al. 2015). If a side costs nothing and its paths have fewer conflicts,
// they obey all that the node demands, at the node's cost: they replace the node's paths, and
// nothing is split.
//
// Why no plan is lost: a split is two demands of which every conflict-free plan meets one (see
// conflict.cpp, target.cpp, traversal.cpp), whichever of them is chosen and whatever the paths. A
// side is closed only if its demand, with the node's, makes single agents so dear that the sum -
// each other agent costing at least what it costs at the node - reaches the cutoff.
#include "grove/search/brancher.h"

#include <algorithm>
#include <array>
#include <utility>

#include "grove/conflicts/target.h"
#include "grove/conflicts/traversal.h"

namespace grove {
namespace {

// Each bypass saves conflicts, but by a count in which two rests on one cell are not symmetric, so
// that alone does not prove that bypasses end.
constexpr int kMostBypasses = 64;

// A split that takes longer to price is not considered: with time windows, which is what cells
// barred for ever make, the low level is NP-hard, and one call could take all the time there is.
constexpr std::int64_t kMostLabelsForAPrice = 1 << 18;

// A hash of the pair (the finaliser of SplitMix64, Steele et al. 2014).
std::uint64_t priority(const Conflict& conflict, std::uint64_t seed) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15 + (static_cast<std::uint64_t>(conflict.first) << 32) +
                    static_cast<std::uint64_t>(conflict.second);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

}  // namespace

Brancher::Brancher(const Problem& problem, Techniques techniques, std::uint64_t seed,
                   PathPlanner& planner, Memory& memory)
    : problem_(problem),
      techniques_(techniques),
      seed_(seed),
      planner_(planner),
      memory_(memory),
      finder_(problem.instance.grid()),
      others_(problem.instance.grid()),
      shown_(problem.instance.agent_count()) {}

void Brancher::enter(const NodePtr& node, std::span<const AgentIndex> scope) {
  node_ = node;
  scope_.assign(scope.begin(), scope.end());
  bypassed_.clear();
  node->paths(problem_, scope_, paths_);
  node->constraints(constraints_);
  for (AgentIndex agent : scope_) canonical(constraints_[agent]);
  find_conflicts();
}

void Brancher::find_conflicts() {
  finder_.all(paths_, scope_, conflicts_);
  for (const AgentIndex agent : scope_) steps_ += std::ssize(paths_[agent]);
}

Situations::Id Brancher::situation(AgentIndex agent) {
  return memory_.id(agent, order(agent), constraints_[agent]);
}

Brancher::Outcome Brancher::branch(Cost cutoff, std::span<const Split> last_resorts,
                                   const Limits& limits, std::vector<NodePtr>& children) {
  const Cost slack = cutoff - node_->cost() - 1;  // a child's cost may rise by so much
  if (slack < 0) return Outcome::kBranched;
  for (int round = 0; !conflict_free(); ++round) {
    show_others();
    Split split;
    if (choose(slack, last_resorts, limits, split) == Step::kStopped) return Outcome::kStopped;
    for (int i = 0; i < 2; ++i)
      if (make_side(split[i], slack, limits, sides_[i]) == Step::kStopped) return Outcome::kStopped;
    if (round < kMostBypasses && (bypass(sides_[0]) || bypass(sides_[1]))) continue;
    const NodePtr parent = with_bypasses();
    for (int i = 0; i < 2; ++i)
      if (sides_[i].open) children.push_back(child(parent, split[i], sides_[i]));
    return Outcome::kBranched;
  }
  return Outcome::kConflictFree;
}

// Brings the table up to the paths in scope. Most are those of the node before.
void Brancher::show_others() {
  for (std::size_t agent = 0; agent < paths_.size(); ++agent) {
    if (shown_[agent] == paths_[agent]) continue;
    others_.remove(shown_[agent]);
    others_.add(paths_[agent]);
    shown_[agent] = paths_[agent];
  }
}

// Every split that a conflict allows.
void Brancher::collect_splits() {
  splits_.clear();
  for (const Conflict& conflict : conflicts_) {
    splits_.push_back(split(conflict));
    if (techniques_.has(Technique::kTarget))
      if (const auto by_target = target_split(conflict, paths_)) splits_.push_back(*by_target);
    if (techniques_.has(Technique::kTraversal))
      if (const auto by_traversal = traversal_split(conflict, paths_, problem_.chains))
        splits_.push_back(*by_traversal);
  }
}

bool Brancher::in_conflict(AgentIndex a, AgentIndex b) const {
  return std::ranges::any_of(conflicts_, [&](const Conflict& c) {
    return c.first == std::min(a, b) && c.second == std::max(a, b);
  });
}

// The split to make: the one that raises the bounds most, or that of a conflict of least time.
Brancher::Step Brancher::choose(Cost slack, std::span<const Split> last_resorts,
                                const Limits& limits, Split& chosen) {
  if (!techniques_.has(Technique::kStrongBranching)) {
    chosen = earliest();
    return Step::kDone;
  }
  collect_splits();
  Choice best;
  for (const Split& split : splits_)
    if (improve(best, split, slack, limits) == Step::kStopped) return Step::kStopped;
  for (const Split& split : last_resorts) {
    if (best.gain.second > 0) break;
    if (!in_conflict(split[0].agent, split[1].agent)) continue;
    if (improve(best, split, slack, limits) == Step::kStopped) return Step::kStopped;
  }
  if (techniques_.has(Technique::kSequenceSplits) && best.gain.first == 0)
    if (improve_by_sequences(best, slack, limits) == Step::kStopped) return Step::kStopped;
  chosen = best.gain.first >= 0 ? best.split : earliest();
  return Step::kDone;
}

// The same with splits on the next stops of the agents in conflict, where no conflict raises the
// cost of both sides. Not usual: on 19 rooms and random maps of 10 and 20 agents it took up to
// twice as many nodes; only where no conflict raises the cost of either side, as many as without.
Brancher::Step Brancher::improve_by_sequences(Choice& choice, Cost slack, const Limits& limits) {
  in_conflict_.clear();
  for (const Conflict& c : conflicts_) in_conflict_.insert(in_conflict_.end(), {c.first, c.second});
  std::ranges::sort(in_conflict_);
  in_conflict_.erase(std::ranges::unique(in_conflict_).begin(), in_conflict_.end());
  for (AgentIndex agent : in_conflict_) {
    const auto split =
        planner_.sequence_split(agent, order(agent), constraints_[agent], paths_[agent]);
    if (split && improve(choice, *split, slack, limits) == Step::kStopped) return Step::kStopped;
  }
  return Step::kDone;
}

Brancher::Step Brancher::improve(Choice& choice, const Split& split, Cost slack,
                                 const Limits& limits) {
  std::array<Cost, 2> increases{};
  for (int i = 0; i < 2; ++i)
    if (const Step step = estimate(split[i], slack, limits, increases[i]); step != Step::kDone)
      return step == Step::kTooHard ? Step::kDone : step;
  const std::pair<Cost, Cost> gain = std::minmax(increases[0], increases[1]);
  if (gain > choice.gain) choice = {gain, split};
  return Step::kDone;
}

Split Brancher::earliest() const {
  const Conflict* best = &conflicts_.front();
  for (const Conflict& conflict : conflicts_) {
    if (conflict.time > best->time) break;
    if (priority(conflict, seed_) < priority(*best, seed_)) best = &conflict;
  }
  if (techniques_.has(Technique::kTarget))
    if (const auto by_target = target_split(*best, paths_)) return *by_target;
  if (techniques_.has(Technique::kTraversal))
    if (const auto by_traversal = traversal_split(*best, paths_, problem_.chains))
      return *by_traversal;
  return split(*best);
}

// By how much the sum of costs rises when `demand` is made; kInfiniteCost if by more than `slack`.
Brancher::Step Brancher::estimate(const AgentConstraint& demand, Cost slack, const Limits& limits,
                                  Cost& increase) {
  increase = 0;
  if (demand.constraint.kind == ConstraintKind::kStopIs) return Step::kDone;  // the path obeys it
  affected(demand, affected_);
  for (AgentIndex agent : affected_) {
    const Time cutoff =
        static_cast<Time>(std::min<Cost>(cost_of(agent) + slack - increase, kNever - 1));
    Time cost = 0;
    const Step step =
        least_cost(agent, *demand_on(agent, demand), cutoff, kMostLabelsForAPrice, limits, cost);
    if (step != Step::kDone) return step;
    if (cost > cutoff) {
      increase = kInfiniteCost;
      break;
    }
    increase += cost - cost_of(agent);
  }
  return Step::kDone;
}

// What the agent costs under one constraint more; if that is above `cutoff`, anything above it.
Brancher::Step Brancher::least_cost(AgentIndex agent, const Constraint& more, Time cutoff,
                                    std::int64_t most_labels, const Limits& limits, Time& cost) {
  const auto constraints = constraints_with(agent, more);
  const Situations::Id id = memory_.id(agent, order(agent), constraints);
  Situations::Known known = memory_.known(id);
  if (!known.exact && known.at_least <= cutoff) {
    if (known.hard && most_labels < FreeLowLevelSearch::kUnlimited) return Step::kTooHard;
    switch (planner_.find(agent, order(agent), constraints, nullptr, cutoff, limits, path_,
                          most_labels)) {
      case PathPlanner::Outcome::kFound:
        known = {static_cast<Time>(path_.size()) - 1, true};
        break;
      case PathPlanner::Outcome::kAbove:
        known = {cutoff + 1, false};
        break;
      case PathPlanner::Outcome::kInfeasible:
        known = {kNever, true};
        break;
      case PathPlanner::Outcome::kStopped:
        if (limits.stop_requested()) return Step::kStopped;
        known.hard = true;
        break;
    }
    memory_.learn(id, known);
    if (known.hard) return Step::kTooHard;
  }
  cost = known.at_least;
  return Step::kDone;
}

// Who in scope must go another way: whose path does not obey what `demand` asks of it.
void Brancher::affected(const AgentConstraint& demand, std::vector<AgentIndex>& agents) const {
  agents.clear();
  const Constraint& c = demand.constraint;
  if (c.kind != ConstraintKind::kRestBy) {
    agents.push_back(demand.agent);
    return;
  }
  for (AgentIndex agent : scope_) {
    const Path& path = paths_[agent];
    const auto begin = path.begin() + std::min<std::ptrdiff_t>(c.end, std::ssize(path) - 1);
    if (agent != demand.agent && std::find(begin, path.end(), c.cell) != path.end())
      agents.push_back(agent);
  }
}

// The agent's constraints at the node and one more, in canonical order; until the next call.
std::span<const Constraint> Brancher::constraints_with(AgentIndex agent, const Constraint& more) {
  extended_ = constraints_[agent];
  extended_.push_back(more);
  canonical(extended_);
  return extended_;
}

// The paths of one side of the split, around those of the others.
Brancher::Step Brancher::make_side(const AgentConstraint& demand, Cost slack, const Limits& limits,
                                   Side& side) {
  side.open = true;
  side.increase = 0;
  side.conflicts = 0;
  side.paths.clear();
  affected(demand, side.agents);
  for (AgentIndex agent : side.agents) {
    others_.remove(paths_[agent]);
    side.conflicts -= others_.conflicts_of(paths_[agent]);
  }
  const Step step = replan(demand, slack, limits, side);
  for (const Path& path : side.paths) others_.remove(path);
  for (AgentIndex agent : side.agents) others_.add(paths_[agent]);
  return step;
}

Brancher::Step Brancher::replan(const AgentConstraint& demand, Cost slack, const Limits& limits,
                                Side& side) {
  for (AgentIndex agent : side.agents) {
    const Time cutoff =
        static_cast<Time>(std::min<Cost>(cost_of(agent) + slack - side.increase, kNever - 1));
    const Step step = replan_one(agent, *demand_on(agent, demand), cutoff, limits, side.open);
    if (step == Step::kStopped || !side.open) return step;
    side.increase += static_cast<Cost>(path_.size()) - static_cast<Cost>(paths_[agent].size());
    side.conflicts += others_.conflicts_of(path_);
    others_.add(path_);
    side.paths.push_back(path_);
  }
  return Step::kDone;
}

// Writes a cheapest path under one constraint more to path_, if it costs at most `cutoff`.
Brancher::Step Brancher::replan_one(AgentIndex agent, const Constraint& more, Time cutoff,
                                    const Limits& limits, bool& found) {
  if (techniques_.has(Technique::kFewestConflicts)) {
    Time cost = 0;
    if (least_cost(agent, more, cutoff, FreeLowLevelSearch::kUnlimited, limits, cost) !=
        Step::kDone)
      return Step::kStopped;
    found = cost <= cutoff;
    if (!found) return Step::kDone;
    const auto constraints = constraints_with(agent, more);
    const Situations::Id id = memory_.id(agent, order(agent), constraints);
    const OptimalPaths* paths = memory_.paths(id, agent, order(agent), constraints, cost, limits);
    if (!paths) return Step::kStopped;
    if (!paths->empty()) {
      fewest_conflicts_.find(*paths, others_, path_);
      return Step::kDone;
    }
  }
  const auto constraints = constraints_with(agent, more);
  const auto outcome =
      planner_.find(agent, order(agent), constraints, &others_, cutoff, limits, path_);
  found = outcome == PathPlanner::Outcome::kFound;
  return outcome == PathPlanner::Outcome::kStopped ? Step::kStopped : Step::kDone;
}

// Takes the paths of a side for the node's own, if that costs nothing and saves conflicts.
bool Brancher::bypass(const Side& side) {
  if (!techniques_.has(Technique::kBypass)) return false;
  if (!side.open || side.increase > 0 || side.conflicts >= 0) return false;
  for (std::size_t i = 0; i < side.agents.size(); ++i) {
    const AgentIndex agent = side.agents[i];
    paths_[agent] = side.paths[i];
    if (std::ranges::count(bypassed_, agent) == 0) bypassed_.push_back(agent);
  }
  find_conflicts();
  return true;
}

// The node as it is after the bypasses.
NodePtr Brancher::with_bypasses() const {
  if (bypassed_.empty()) return node_;
  std::vector<NewPath> paths;
  for (AgentIndex agent : bypassed_) paths.push_back({agent, &paths_[agent]});
  Change change;
  change.paths = paths;
  change.cost = node_->cost();
  return Node::child(node_, problem_.instance.grid(), change);
}

NodePtr Brancher::child(const NodePtr& parent, const AgentConstraint& demand,
                        const Side& side) const {
  std::vector<NewPath> paths;
  for (std::size_t i = 0; i < side.agents.size(); ++i)
    paths.push_back({side.agents[i], &side.paths[i]});
  Change change;
  change.added = demand;
  change.paths = paths;
  change.cost = node_->cost() + side.increase;
  change.conflicts =
      static_cast<std::uint32_t>(std::max(0, static_cast<int>(conflicts_.size()) + side.conflicts));
  return Node::child(parent, problem_.instance.grid(), change);
}

}  // namespace grove
