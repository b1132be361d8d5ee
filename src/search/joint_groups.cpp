// SPDX-License-Identifier: MIT
// Lower bound on the cost of a group by A* over joint states (joint/epea_star.cpp). Each agent of
// the group has a graph of all its paths that satisfy the node's constraints and cost at most
// `max_excess` more than its path at the node (joint/time_expanded_graphs.h). *Claim: in every plan
// that satisfies the node's constraints the group costs at least the computed bound.* *Proof.* In
// such a plan no two paths of the group collide. If all its paths are in the graphs, they cost at
// least the bound of the joint search, even if that search ends early. Otherwise one agent costs
// over `max_excess` more than its path at the node. The paths at the node are cheapest under the
// node's constraints, so no other agent costs less than its path there, and the group costs at
// least `max_excess` + 1 more. The constraints are those of the agents' subproblems
// (subproblem_table.h); the result does not depend on other agents.
//
// Graphs grow with `max_excess`, and most groups have a small excess. So `max_excess` starts at the
// known excess + 1, and its distance from the known excess doubles in each round, up to `slack`.
//
// *Where it helps.* Splits solve nearly all pairs of agents that neither turn nor execute tasks,
// and few of the other pairs. *Measured* on room-32-32-4 with 40 agents: if joint search is also
// applied to groups with pairs that must cost more already, it needs 6 % fewer nodes in 1.6 times
// the time (for groups of at most four agents 1 % fewer nodes in 1.1 times the time). Joint search
// in place of splits needs 5 % more nodes in 1.7 times the time.
#include "search/joint_groups.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "joint/epea_star.h"
#include "model/assert.h"
#include "model/effort.h"
#include "model/omega.h"

namespace grove::detail {
namespace {

// Nodes of one agent's graph; a larger graph is not built.
constexpr std::size_t kMaxAgentGraphNodes = 32'000;

constexpr std::int64_t kStatesAtOnce = 16;
constexpr std::size_t kMaxBytes = std::size_t{1} << 28;

}  // namespace

std::int64_t JointGroups::work() const {
  return joint_work_ + planner_.timed_nodes() / effort::kTimedNodes;
}

bool JointGroups::solve(const NodeView& view, std::span<const AgentIndex> group, Cost slack,
                        const Limits& limits, ExcessBound& known) {
  if (std::ssize(group) > tuning_.joint_group_agents) return true;
  abort_at_ = work() + tuning_.joint_group_work;
  for (Cost more = 1; !known.exact && known.excess <= slack; more *= 2) {
    const Cost max_excess = std::min(slack, known.excess + more);
    GROVE_ASSERT(max_excess >= known.excess, "the graphs of a round allow for the known excess");
    const Outcome outcome = solve_up_to(max_excess, view, group, limits, known);
    GROVE_ASSERT(known.excess <= max_excess + 1,
                 "graphs prove at most the excess that they exceed");
    GROVE_ASSERT(outcome != Outcome::kSolved || known.exact || known.excess > max_excess,
                 "a solved round has an exact excess, or one above its graphs");
    if (outcome == Outcome::kStopped) return false;
    if (outcome == Outcome::kAborted) return true;
  }
  return true;
}

JointGroups::Outcome JointGroups::solve_up_to(Cost max_excess, const NodeView& view,
                                              std::span<const AgentIndex> group,
                                              const Limits& limits, ExcessBound& known) {
  Cost apart = 0;
  std::vector<AgentGraph> graphs(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) {
    const AgentIndex agent = group[i];
    const Cost max_cost = view.cost_of(agent) + max_excess;
    apart += view.cost_of(agent);
    if (max_cost >= kNever || work() >= abort_at_) return Outcome::kAborted;
    const auto made = planner_.timed_graph(
        agent, view.order(agent), view.constraints(agent), static_cast<Time>(max_cost),
        static_cast<std::size_t>(kMaxAgentGraphNodes), limits, graphs[i]);
    if (made == TimeExpandedGraphs::Outcome::kStopped) return Outcome::kStopped;
    if (made == TimeExpandedGraphs::Outcome::kTooLarge) return Outcome::kAborted;
  }
  EpeaStar search(instance_, std::move(graphs), kMaxBytes, apart + known.excess);
  const Cost cutoff = apart + max_excess + 1;
  const std::int64_t max_work = abort_at_ - work();
  auto outcome = EpeaStar::Outcome::kWorking;
  while (outcome == EpeaStar::Outcome::kWorking && search.work() < max_work)
    outcome = search.run(kStatesAtOnce, cutoff, limits);
  states_ += search.states();
  joint_work_ += search.work();
  known.excess = std::max(known.excess, std::min(search.lower_bound(), cutoff) - apart);
  known.exact = search.paths().has_value();
  if (limits.stop_requested()) return Outcome::kStopped;
  return outcome == EpeaStar::Outcome::kEnded ? Outcome::kSolved : Outcome::kAborted;
}

}  // namespace grove::detail
