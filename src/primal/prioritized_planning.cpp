// SPDX-License-Identifier: MIT
// Prioritised planning (Erdmann and Lozano-Perez 1987; Silver 2005). Paths of agents planned
// earlier are obstacles, including the rest at their ends, and an agent must not come to rest where
// one of these paths still passes. Planning fails for an agent if the obstacles enclose it, mostly
// because a few agents were planned too late.
//
// *Order after a failure.* The agent that failed is moved to the front of the order, and planning
// restarts. (Bennewitz et al. 2002 exchange random agents instead. In measurements, moving to the
// front succeeded on far denser instances than random orders.) Two agents that enclose each other
// would alternate forever, so the order is shuffled whenever the number of failures is a multiple
// of the number of agents.
//
// *Partial re-planning.* If the current order has taken many labels (pp_resume_labels), planning
// does not restart at the first failure of an agent. Only the agents that block its individual path
// are re-planned, after it. At the agent's next failure planning restarts. The resulting plans cost
// a little more: on room-64-64-8, 100 agents, 300 tasks, scenarios 2, 3 and 5, they cost 0.4 to 3 %
// more, and they are not found sooner there.
//
// *Label limit.* A proof that an agent is enclosed can take a hundred times the labels of any
// successful call. Therefore a call fails after many times the maximum number of labels of a
// successful call. The limit doubles after every n failures, where n is the number of agents, so
// that an agent that is only hard to plan is planned eventually.
//
// *Ties.* Among paths of equal cost, the low level prefers paths that have few conflicts with the
// individual paths of the agents that have no path yet (effect: head of lns.cpp).
//
// *Greedy search.* The low level's heuristic ignores the agents planned before. If there are many
// of them and the distance is long, many labels have f below the cost of the best path: on a map of
// 256x256 cells with 1,000 agents, the last agents took a million labels each, all earlier ones a
// thousand or two. Therefore exact search has a lower label limit. If it is reached, a greedy
// search (kGreedPercent) looks for any path. It is mostly needed for an agent whose destination
// others pass long after the agent's individual cost.
#include "primal/prioritized_planning.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "planning/planned_paths.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kPlanningLabels = 200'000;  // base of the label limit per call
// Multiple of the maximum number of labels of successful calls that is added to this base.
constexpr std::int64_t kPlanningLabelsFactor = 8;

constexpr int kGreedPercent = 30;

}  // namespace

void PrioritizedPlanning::begin(std::vector<AgentIndex> order) {
  GROVE_CHECK(order.size() == paths_.paths().size(), "an order holds every agent");
  order_.agents = std::move(order);
  failures_ = 0;
  greedily_ = false;
  begin_again();
}

void PrioritizedPlanning::begin_again() {
  paths_.clear();
  unplanned_.clear();
  for (AgentIndex agent : order_.agents) unplanned_.add(low_level_.individual_path(agent));
  order_.next = 0;
  order_.labels = 0;
  order_.has_failed.assign(order_.agents.size(), false);
  ++attempts_;
}

std::int64_t PrioritizedPlanning::label_limit() const {
  const std::int64_t draws = failures_ / std::ssize(order_.agents);
  return (kPlanningLabels + kPlanningLabelsFactor * labels_of_found_.max)
         << std::min<std::int64_t>(draws, 30);
}

std::int64_t PrioritizedPlanning::max_exact_labels() const {
  return tuning_.pp_exact_labels + tuning_.pp_exact_labels_factor * labels_of_found_.exact /
                                       std::max(labels_of_found_.exact_calls, std::int64_t{1});
}

PrioritizedPlanning::Outcome PrioritizedPlanning::step(const Limits& limits,
                                                       std::int64_t max_labels) {
  if (is_done()) return Outcome::kDone;
  const AgentIndex agent = order_.agents[order_.next];
  const std::int64_t before = low_level_.expanded();
  const std::int64_t most = greedily_ ? label_limit() : std::min(label_limit(), max_exact_labels());
  const PathQuery query{.others = &unplanned_,
                        .label_limit = std::min(max_labels, most),
                        .reservations = &paths_.reservations(),
                        .inflation_percent = greedily_ ? kGreedPercent : 0,
                        .known_sequences_only = true};
  unplanned_.remove(low_level_.individual_path(agent));
  const PathOutcome outcome = low_level_.find(agent, query, limits, path_);
  const std::int64_t labels = low_level_.expanded() - before;
  order_.labels += labels;
  if (outcome == PathOutcome::kFound) {
    note_labels(labels);
    paths_.put(agent, std::move(path_));
    path_.clear();
    greedily_ = false;
    ++order_.next;
    return is_done() ? Outcome::kDone : Outcome::kWorking;
  }
  unplanned_.add(low_level_.individual_path(agent));
  if (limits.stop_requested()) return Outcome::kStopped;
  if (max_labels < most && labels >= max_labels) return Outcome::kPostponed;
  if (!greedily_ && most < label_limit() && labels >= most) {
    greedily_ = true;
    return Outcome::kWorking;
  }
  ++failures_;
  greedily_ = false;
  if (order_.labels < tuning_.pp_resume_labels || order_.has_failed[agent])
    restart_with_failed_first();
  else
    remove_blocking_agents(agent);
  return Outcome::kWorking;
}

// Removes the paths of the agents that block the individual path of `agent`, and moves these agents
// behind `agent` in the order.
void PrioritizedPlanning::remove_blocking_agents(AgentIndex agent) {
  std::vector<AgentIndex>& agents = order_.agents;
  order_.has_failed[agent] = true;
  std::vector<bool> gone(agents.size(), false);
  for_each_blocking_agent(world_, paths_.reservations(), agent, low_level_.individual_path(agent),
                          0, [&](AgentIndex other) {
                            gone[other] = true;
                            return true;
                          });
  const auto planned = agents.begin() + static_cast<std::ptrdiff_t>(order_.next);
  const auto first_gone = std::stable_partition(agents.begin(), planned,
                                                [&](AgentIndex other) { return !gone[other]; });
  for (auto other = first_gone; other != planned; ++other) {
    paths_.take(*other);
    unplanned_.add(low_level_.individual_path(*other));
  }
  std::rotate(first_gone, planned, planned + 1);
  order_.next = static_cast<std::size_t>(first_gone - agents.begin());
  GROVE_ASSERT(agents[order_.next] == agent, "the agent that failed is planned next");
}

void PrioritizedPlanning::restart_with_failed_first() {
  std::vector<AgentIndex>& agents = order_.agents;
  const auto failed = agents.begin() + static_cast<std::ptrdiff_t>(order_.next);
  if (failures_ % std::ssize(agents) == 0)
    random_.shuffle(agents);
  else
    std::rotate(agents.begin(), failed, failed + 1);
  begin_again();
}

void PrioritizedPlanning::note_labels(std::int64_t labels) {
  labels_of_found_.max = std::max(labels_of_found_.max, labels);
  if (greedily_) return;
  labels_of_found_.exact += labels;
  ++labels_of_found_.exact_calls;
}

}  // namespace grove::detail
