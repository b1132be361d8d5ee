// SPDX-License-Identifier: MIT
#include "search/child_costs.h"

#include "model/assert.h"

namespace grove::detail {

// The label limit is needed because cells that are forbidden forever act as time windows. With
// these the low-level problem is NP-hard, so a single call could use up all the time.
ChildCosts::Outcome ChildCosts::increase(NodeView& view, const AgentConstraint& constraint,
                                         Cost slack, const Limits& limits, Cost& increase) {
  increase = 0;
  view.affected_agents(constraint, affected_);
  for (AgentIndex agent : affected_) {
    const Time cutoff = cutoff_for(view, agent, slack - increase);
    Time least = 0;
    const Outcome outcome =
        cost(view, agent, *constraint_on(agent, constraint), cutoff, label_limit_, limits, least);
    if (outcome != Outcome::kDone) return outcome;
    GROVE_ASSERT(least >= view.cost_of(agent), "a constraint lowers the cost of no agent");
    if (least > cutoff) {
      increase = kInfiniteCost;
      break;
    }
    increase += least - view.cost_of(agent);
    GROVE_ASSERT(increase <= slack,
                 "an increase within the cutoffs of the agents is within the slack");
  }
  return Outcome::kDone;
}

ChildCosts::Outcome ChildCosts::cost(NodeView& view, AgentIndex agent, const Constraint& more,
                                     Time cutoff, std::int64_t label_limit, const Limits& limits,
                                     Time& cost) {
  const auto constraints = view.constraints_with(agent, more);
  const SubproblemTable::Id id = memory_.id(agent, view.order(agent), constraints);
  SubproblemTable::CostBound known = memory_.known(id);
  const Time known_before = known.lower_bound;
  ++asked_;
  if (known.exact || known.lower_bound > cutoff) {
    ++known_;
  } else {
    if (known.was_aborted && label_limit < PathQuery::kUnlimited) return Outcome::kTooHard;
    const PathQuery query{.constraints = constraints, .cutoff = cutoff, .label_limit = label_limit};
    switch (planner_.find(agent, view.order(agent), query, limits, path_)) {
      case PathOutcome::kFound:
        known = {static_cast<Time>(path_.size()) - 1, true};
        break;
      case PathOutcome::kAboveCutoff:
        known = {cutoff + 1, false};
        break;
      case PathOutcome::kInfeasible:
        known = {kNever, true};
        break;
      case PathOutcome::kStopped:
        if (limits.stop_requested()) return Outcome::kStopped;
        known.was_aborted = true;
        break;
    }
    GROVE_ASSERT(known.lower_bound >= known_before, "a search finds no cost below a known bound");
    GROVE_ASSERT(!known.exact || known.lower_bound <= cutoff || known.lower_bound == kNever,
                 "a path that was found costs at most the cutoff");
    memory_.merge(id, known);
    if (known.was_aborted) return Outcome::kTooHard;
  }
  cost = known.lower_bound;
  return Outcome::kDone;
}

}  // namespace grove::detail
