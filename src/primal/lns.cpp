// SPDX-License-Identifier: MIT
// Where it is crowded the low level's heuristic, blind to the others, lets it expand every label
// with f below the best path's cost. A greedy order finds good paths much sooner there, and
// somewhat worse ones elsewhere. So each order is a way of its own, with what it gained of late and
// what work that took; mostly the one with the better rate is used.
//
// A call that takes many times the labels of those that find a path is given up: mostly there is
// none to be found, and the time is better spent elsewhere. So is one that takes long before any
// has found a path; the next may take twice as many.
//
// Where prices are known, each agent may leave to others what they would pay for: its cheapest path
// is found first, and gives way to the one that is cheapest with all penalties.
//
// It ends in a local optimum soon. So when as many neighbourhoods as there are agents were in vain,
// plans are gone on with that cost a little more than the best one met: a share of what that costs
// above all agents alone, for where much is lost by crowding it takes more to get out. Until then
// nothing dearer is taken, else a plan that still improves quickly improves more slowly
// (random-32-32-20, 200 agents, ten seconds: 5,202 to 5,238 instead of 5,149), and where it is so
// crowded that plans improve for as long as one looks, nothing dearer at all.
//
// The cutoff of a call is what is left of the old cost, less what the agents still to come need at
// least: beyond it the neighbourhood is lost anyway.
//
// Two or three agents at once, by joint search around the others, where one by one gained nothing:
// a fifth of those that are not too large gain, but the time is better spent otherwise. Medians of
// three seeds, 5 s on a busy machine, without and with: random-32-32-20, 150 agents 3,861 and
// 3,921, 100 agents 2,361 and 2,364; room-32-32-4, 60 agents 1,756 and 1,764, 80 agents 2,415 and
// 2,432; empty-32-32, 200 agents 4,358 and 4,360. Only where all have been in vain for long, 8 s:
// room, 60 agents, 1,756 and 1,759, 1,646 and 1,646.
#include "primal/lns.h"

#include <algorithm>
#include <span>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::int64_t kMostFirstLabels = std::int64_t{1} << 40;

}  // namespace

void LargeNeighborhoodSearch::step(const Limits& limits) {
  ++steps_;
  const std::vector<AgentIndex>& agents = neighborhoods_.choose();
  RepairOperator& way = choose_repair();
  const std::int64_t work_before = router_.work();
  Cost old_cost = 0;
  old_paths_.clear();
  for (AgentIndex agent : agents) {
    old_cost += paths_.cost(agent);
    old_paths_.push_back(paths_.take(agent));
  }
  const Cost others = paths_.cost();
  if (!plan_anew(agents, old_cost + worse_allowed(others + old_cost), way, limits)) restore(agents);
  const Cost gain = std::max<Cost>(0, others + old_cost - paths_.cost());
  neighborhoods_.reward(gain);
  const std::int64_t work = router_.work() - work_before;
  way.gain = tuning_.way_memory * way.gain + static_cast<double>(gain);
  way.work = tuning_.way_memory * way.work + static_cast<double>(work);
}

LargeNeighborhoodSearch::RepairOperator& LargeNeighborhoodSearch::choose_repair() {
  const std::span<RepairOperator> ways(
      repair_operators_.data(), repair_operators_.size() - (router_.prices() == nullptr ? 1 : 0));
  if (random_.below(tuning_.neighborhoods_per_trial) == 0) return ways[random_.below(ways.size())];
  return *std::ranges::max_element(
      ways, {}, [](const RepairOperator& way) { return (way.gain + 1) / way.work; });
}

// How much more than `cost`, that of the plan as it is, the next one may cost.
Cost LargeNeighborhoodSearch::worse_allowed(Cost cost) {
  if (cost < least_) {
    least_ = cost;
    in_vain_ = 0;
  }
  if (++in_vain_ <= tuning_.neighborhoods_before_worse * std::ssize(paths_.paths())) return 0;
  const auto loss = static_cast<double>(least_ - own_costs_);
  if (loss > tuning_.worse_plans_loss * static_cast<double>(own_costs_)) return 0;
  const double more = tuning_.worse_plans * loss;
  return std::max<Cost>(0, least_ + static_cast<Cost>(more + random_.unit()) - cost);
}

// False if the agents cannot be planned at `most` or less, at least not in this order.
bool LargeNeighborhoodSearch::plan_anew(const std::vector<AgentIndex>& agents, Cost most,
                                        RepairOperator& way, const Limits& limits) {
  Cost left = most;
  for (AgentIndex agent : agents) left -= router_.individual_cost(agent);
  for (AgentIndex agent : agents) {
    const Cost cutoff = left + router_.individual_cost(agent);
    if (!find(agent, cutoff, way, limits)) return false;
    paths_.put(agent, std::move(path_));
    path_.clear();
    left = cutoff - paths_.cost(agent);
  }
  return true;
}

bool LargeNeighborhoodSearch::find(AgentIndex agent, Cost cutoff, RepairOperator& way,
                                   const Limits& limits) {
  const double of_others =
      tuning_.replan_labels + tuning_.replan_labels_of_found * way.labels / way.found;
  const PathQuery query{
      .cutoff = static_cast<Time>(cutoff),
      .label_limit = way.found > 0 ? static_cast<std::int64_t>(of_others) : way.first_labels,
      .reservations = &paths_.reservations(),
      .inflation_percent = way.inflation_percent,
      .known_sequences = true};
  const std::int64_t before = router_.expanded();
  if (router_.find(agent, query, limits, path_) != PathOutcome::kFound) {
    if (way.found <= 0 && way.first_labels < kMostFirstLabels) way.first_labels *= 2;
    return false;
  }
  if (way.priced)
    router_.improve(agent, paths_.reservations(), static_cast<Time>(cutoff), limits, path_);
  way.labels = tuning_.way_memory * way.labels + static_cast<double>(router_.expanded() - before);
  way.found = tuning_.way_memory * way.found + 1;
  return true;
}

void LargeNeighborhoodSearch::restore(const std::vector<AgentIndex>& agents) {
  for (AgentIndex agent : agents)
    if (!paths_.path(agent).empty()) paths_.take(agent);
  for (std::size_t i = 0; i < agents.size(); ++i) paths_.put(agents[i], std::move(old_paths_[i]));
}

}  // namespace grove::detail
