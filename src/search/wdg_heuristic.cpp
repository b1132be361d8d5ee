// SPDX-License-Identifier: MIT
// WDG heuristic: weighted pairwise dependencies (Li, Felner, Boyarski, Ma and Koenig, IJCAI 2019).
//
// For two agents whose paths conflict at a node, a small CBS on these two agents computes a lower
// bound on their *excess*: how much more they cost together than the sum of the costs of their
// paths at the node. It uses the same splits as the main search, considers only conflicts between
// these two agents, and starts at the node, so it respects all constraints of the node on them.
// *Claim: in every plan that satisfies the node's constraints, the two agents cost together at
// least the least cost among the open nodes of that search.* *Proof.* Splitting loses no plan, and
// the other agents cannot make the two agents cheaper. *Consequence.* A search that is aborted
// early leaves a valid bound. A search whose least-cost open node is conflict-free yields the exact
// value. Let `slack` be the largest excess below the cutoff. A child that reaches the cutoff is
// pruned and counts as an excess of slack + 1.
//
// *Joint MDDs.* Before that search, the MDDs of the two agents are compared
// (planning/joint_mdd_search.cpp). If all pairs of their paths collide, the excess is at least 1,
// even if no single conflict shows it. If some pair does not collide, the excess is 0, provided
// that agents may follow each other, because the comparison ignores following conflicts.
//
// *Splits on costs.* If a and b cannot both keep their costs A and B, then in every plan a comes to
// rest after A or b comes to rest after B. An agent with a destination comes to rest only there, so
// the constraint "does not come to rest there by A" (kNoRestBy) expresses the first branch, and
// each branch costs at least one more. This does not hold for an agent that must turn to a given
// heading or execute a task at its destination, because it finishes later than it comes to rest. An
// agent that does neither finishes when it arrives, in some plan of no higher cost. Where no cell
// is on all best paths (the rectangle conflicts of Li et al., AAAI 2019, on open ground), such a
// split resolves in one step what splits on cells resolve one by one. It is therefore used where no
// conflict raises the cost of any branch. Where the cost of one branch rises, splitting on the
// conflict is better: with 20 agents in rooms, splits on costs needed 1 to 8 times as many nodes.
// Splits on costs pay only together with paths of fewest conflicts, which show where the delay is
// best spent. *Measured*: of five instances of 100 agents on empty-32-32 without tasks, w = 0, 5 s,
// both together solve 5, either without the other solves 1.
//
// *Sum.* Two pairs that share an agent can owe their excesses to the same additional steps of that
// agent, so their excesses must not be added up. covering_bound() computes the least total that
// satisfies all statements.
//
// *Cache.* The excess of a pair depends only on the two subproblems (agent, sequence class and
// constraint set), so a bound proven at one node holds at every node where both agents have the
// same subproblems. (Which bound was proven depends on the cutoff at that time.) From a node to its
// child one subproblem changes, so nearly all pairs are cached. Pairs that do not conflict at the
// node count as well if they conflicted at another node with the same subproblems.
//
// *Groups.* Even if no pair must cost more, three or more agents may block each other whatever they
// do. If they do not, splits can still move one conflict from pair to pair forever. The same search
// on a connected group of up to six such agents decides whether they block each other, unless it
// reaches its limits. Its result is cached in the same way.
//
// *Joint search.* If this search reaches its limit of expansions without a result, A* over the
// joint states of the pair or group continues (joint_groups.cpp).
//
// *Bounding effort.* Fewer statements give a bound that is weaker but valid. While other ranks wait
// for nodes, only cached statements are used.
#include "search/wdg_heuristic.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "model/assert.h"
#include "search/known_excesses.h"

namespace grove::detail {
namespace {

constexpr std::ptrdiff_t kMaxGroupAgents = 6;     // agents of a group whose joint bound is computed
constexpr std::int64_t kCoveringSteps = 100'000;  // statements examined per covering bound

}  // namespace

WdgHeuristic::WdgHeuristic(const Problem& problem, const SearchOptions& options,
                           PathPlanner& planner, WorkerCache& memory)
    : instance_(problem.instance),
      planner_(planner),
      agents_(problem.instance.agent_count()),
      techniques_(options.techniques),
      tuning_(options.tuning),
      proof_(options.proof),
      memory_(memory),
      group_cbs_(problem, options, planner, memory),
      joint_mdd_search_(problem.instance.world()),
      joint_groups_(problem.instance, tuning_, planner),
      subproblem_(static_cast<std::size_t>(agents_)) {}

WdgHeuristic::Outcome WdgHeuristic::find_bound(const NodePtr& node, NodeView& view, Cost cutoff,
                                               BoundingEffort bounding_effort, const Limits& limits,
                                               Cost& bound) {
  bound = cutoff;
  const Cost slack = cutoff - node->cost() - 1;
  if (slack < 0) return Outcome::kDone;
  load_subproblems(view);
  if (bounding_effort == BoundingEffort::kFull) {
    const Outcome outcome = compute_weights(view, slack, limits);
    if (outcome != Outcome::kDone) return outcome;
  }
  std::vector<GroupExcess> statements;
  collect_excesses(memory_, subproblem_, partners_, statements);
  const auto max_excess = std::ranges::max_element(statements, {}, &GroupExcess::excess);
  // A single statement that reaches the cutoff suffices, so the other statements are not needed.
  if (max_excess != statements.end() && max_excess->excess > slack)
    statements = {*max_excess};
  else
    bound = std::min(cutoff, node->cost() + covering_bound(statements, kCoveringSteps, limits));
  if (proof_ != nullptr && bound > node->bound()) log_bound(view, statements, bound);
  return Outcome::kDone;
}

WdgHeuristic::Outcome WdgHeuristic::compute_weights(NodeView& view, Cost slack,
                                                    const Limits& limits) {
  // If an earlier cache was dropped because it was full, results of this call may be dropped as
  // well before a later call uses them. In that case there is no effort limit, and this call
  // computes all weights.
  abort_at_ = memory_.common()->follows_another ? std::numeric_limits<std::int64_t>::max()
                                                : work() + tuning_.bound_work;
  const Outcome outcome = solve_conflicting_pairs(view, slack, 0, limits);
  if (outcome != Outcome::kDone || !techniques_.has(Technique::kClusters)) return outcome;
  return solve_groups(view, slack, limits);
}

bool WdgHeuristic::help(const NodePtr& node, NodeView& view, Cost cutoff, double share,
                        const Limits& limits) {
  const Cost slack = cutoff - node->cost() - 1;
  if (slack < 0) return false;
  load_subproblems(view);
  const std::int64_t before = work();
  abort_at_ = before + tuning_.bound_work;
  solve_conflicting_pairs(view, slack, share, limits);
  return work() > before;
}

void WdgHeuristic::load_subproblems(NodeView& view) {
  for (AgentIndex agent = 0; agent < agents_; ++agent) {
    subproblem_[agent] = view.subproblem(agent);
    GROVE_ASSERT(may_cost(agent, view.cost_of(agent)),
                 "an agent's path at a node is a cheapest path of its subproblem");
  }
}

// The excess of a pair or group is relative to the costs of its agents' paths at the node where it
// was proven. It is valid at other nodes because the paths cost the same there, which this function
// checks.
bool WdgHeuristic::may_cost(AgentIndex agent, Time cost) const {
  const SubproblemTable::CostBound known = memory_.known(subproblem_[agent]);
  return known.exact ? cost == known.lower_bound : cost >= known.lower_bound;
}

// Bounds the excess of every pair that conflicts at the node.
WdgHeuristic::Outcome WdgHeuristic::solve_conflicting_pairs(NodeView& view, Cost slack,
                                                            double share, const Limits& limits) {
  std::vector<std::pair<AgentIndex, AgentIndex>> pairs;
  for (const Conflict& c : view.conflicts()) pairs.emplace_back(c.first, c.second);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  const auto first = static_cast<std::ptrdiff_t>(share * static_cast<double>(pairs.size()));
  std::rotate(pairs.begin(), pairs.begin() + first, pairs.end());
  for (const auto& [a, b] : pairs) {
    ExcessBound known = this->known(a, b);
    if (known.exact || known.excess > slack || known.expansions > 0) continue;
    if (work() >= abort_at_) return Outcome::kUnfinished;
    if (techniques_.has(Technique::kJointMdd) && known.excess == 0) {
      const auto dependence = compare(view, a, b, limits);
      if (!dependence) return Outcome::kStopped;
      // The comparison ignores following conflicts.
      known.exact = *dependence == Dependence::kIndependent && instance_.may_follow();
      known.excess = *dependence == Dependence::kDependent ? 1 : 0;
      if (proof_ != nullptr && known.excess > 0) log_lemma(view, std::array{a, b}, 1);
    }
    const bool solved =
        known.exact || solve(view, std::array{a, b}, slack, tuning_.pair_expansions, limits, known);
    if (!solved) return Outcome::kStopped;
    GROVE_ASSERT(known.exact || known.excess > slack || known.expansions > 0,
                 "no pair is examined twice");
    memory_.merge_pair(subproblem_[a], subproblem_[b], b, known);
  }
  return Outcome::kDone;
}

// Tests whether both agents can keep their costs. Returns nullopt where the caller must return
// kStopped.
std::optional<Dependence> WdgHeuristic::compare(NodeView& view, AgentIndex a, AgentIndex b,
                                                const Limits& limits) {
  const Mdd* of_a = mdd(view, a, limits);
  const Mdd* of_b = mdd(view, b, limits);
  if (!of_a || !of_b) return std::nullopt;
  if (of_a->empty() || of_b->empty()) return Dependence::kUnknown;
  const Dependence dependence = joint_mdd_search_.find(
      *of_a, *of_b, static_cast<std::size_t>(tuning_.joint_mdd_nodes), limits);
  if (limits.stop_requested()) return std::nullopt;
  return dependence;
}

const Mdd* WdgHeuristic::mdd(NodeView& view, AgentIndex agent, const Limits& limits) {
  const Time cost = view.cost_of(agent);
  return memory_.paths(subproblem_[agent], agent, view.order(agent), view.constraints(agent), cost,
                       limits);
}

// Bounds the excess of the groups of groups_in_conflict() that have 3 to kMaxGroupAgents agents.
WdgHeuristic::Outcome WdgHeuristic::solve_groups(NodeView& view, Cost slack, const Limits& limits) {
  for (const auto& group : groups_in_conflict(view)) {
    if (group.size() < 3 || std::ssize(group) > kMaxGroupAgents) continue;
    const auto subproblems = key(group);
    ExcessBound known = memory_.of_group(subproblems);
    if (known.exact || known.expansions > 0) continue;
    if (work() >= abort_at_) return Outcome::kUnfinished;
    if (!solve(view, group, slack, tuning_.group_expansions, limits, known))
      return Outcome::kStopped;
    memory_.merge_group(group, subproblems, known);
  }
  return Outcome::kDone;
}

// Components of two or more agents in the graph of conflicting pairs without a known positive
// excess. Each component is in ascending order.
std::vector<std::vector<AgentIndex>> WdgHeuristic::groups_in_conflict(const NodeView& view) const {
  std::vector<AgentIndex> leader(static_cast<std::size_t>(agents_));
  std::iota(leader.begin(), leader.end(), 0);
  for (const Conflict& c : view.conflicts()) {
    if (known(c.first, c.second).excess > 0) continue;
    const AgentIndex from = std::max(leader[c.first], leader[c.second]);
    const AgentIndex to = std::min(leader[c.first], leader[c.second]);
    std::ranges::replace(leader, from, to);
  }
  std::vector<AgentIndex> size(leader.size());
  for (const AgentIndex first : leader) ++size[first];
  std::vector<std::vector<AgentIndex>> groups;
  for (AgentIndex first = 0; first < agents_; ++first) {
    if (size[first] < 2) continue;  // most agents have no such conflict
    auto& group = groups.emplace_back();
    for (AgentIndex agent = first; agent < agents_; ++agent)
      if (leader[agent] == first) group.push_back(agent);
  }
  return groups;
}

std::vector<SubproblemTable::Id> WdgHeuristic::key(std::span<const AgentIndex> group) const {
  std::vector<SubproblemTable::Id> ids;
  for (AgentIndex agent : group) ids.push_back(subproblem_[agent]);
  return ids;
}

// Raises `known`, the excess of a pair or group, by splits and then by joint search. Returns false
// where the caller must return kStopped.
bool WdgHeuristic::solve(const NodeView& view, std::span<const AgentIndex> group, Cost slack,
                         std::int64_t max_expansions, const Limits& limits, ExcessBound& known) {
  if (!group_cbs_.solve(view.node(), group, slack, max_expansions, limits, known)) return false;
  if (known.exact || known.excess > slack || !techniques_.has(Technique::kJointGroups)) return true;
  const Cost by_splits = known.excess;
  if (!joint_groups_.solve(view, group, slack, limits, known)) return false;
  if (proof_ != nullptr && known.excess > by_splits) log_lemma(view, group, known.excess);
  return true;
}

// Logs a lemma that is proven by enumeration of all joint paths of its agents.
void WdgHeuristic::log_lemma(const NodeView& view, std::span<const AgentIndex> group, Cost excess) {
  proof_->lemma(lemma_at(view, group, excess), kNoProof, {});
}

void WdgHeuristic::log_bound(const NodeView& view, std::span<const GroupExcess> statements,
                             Cost bound) {
  std::vector<ProofExcess> excesses;
  for (const GroupExcess& s : statements)
    excesses.push_back({lemma_at(view, s.agents, s.excess).key(), s.agents, s.excess});
  proof_->bound(proof_key(*view.node()), view.node()->cost(), bound, excesses);
}

ProofKey WdgHeuristic::lemma_key(NodeView& view, const Split& split) {
  load_subproblems(view);
  const auto [a, b] = std::minmax(split[0].agent, split[1].agent);
  return lemma_at(view, std::array{a, b}, known(a, b).excess).key();
}

void WdgHeuristic::splits(NodeView& view, std::vector<Split>& splits) {
  load_subproblems(view);
  const auto finishes_on_arrival = [&](AgentIndex i) {
    const Agent& agent = instance_.agent(i);
    const auto works_there = [&](TaskIndex t) {
      return instance_.task(t).duration > 0 && instance_.task(t).cell == *agent.goal;
    };
    return agent.goal && !agent.goal_heading && std::ranges::none_of(agent.tasks, works_there);
  };
  const auto later = [&](AgentIndex agent) {
    const Time cost = view.cost_of(agent);
    return AgentConstraint{
        agent, {*instance_.agent(agent).goal, kNoPlace, 0, cost, ConstraintKind::kNoRestBy}};
  };
  std::pair<AgentIndex, AgentIndex> last{-1, -1};
  for (const Conflict& c : view.conflicts()) {
    if (std::pair(c.first, c.second) == last) continue;
    last = {c.first, c.second};
    const bool apply = known(c.first, c.second).excess > 0 && finishes_on_arrival(c.first) &&
                       finishes_on_arrival(c.second);
    if (apply) splits.push_back({later(c.first), later(c.second)});
  }
}

}  // namespace grove::detail
