// SPDX-License-Identifier: MIT
// Repair operators and acceptance of large neighbourhood search.
//
// *Exact and greedy search.* The low level's heuristic ignores the other agents. In dense instances
// the search therefore expands every label with f below the cost of the best path. A greedy order
// (inflation_percent) finds good paths much sooner there, and slightly worse paths elsewhere. So
// each order is a repair operator with its recent gain and work; usually the operator with the best
// ratio gain / work is used.
//
// *Label limit.* A call is abandoned after many times the labels of calls that find a path, because
// mostly there is no path, and the time is better spent elsewhere. Until an operator has found a
// path, its limit is first_labels, which doubles after each failure.
//
// *Penalised costs.* With a dual solution, an agent can leave to other agents the places and times
// for which these would pay. The cheapest path is found first and then replaced by the path of
// least penalised cost.
//
// *Acceptance.* LNS soon ends in a local optimum. After kRecordDeviationStart iterations per
// agent without improvement, it also accepts plans that cost a little more than the best one so
// far: record_deviation times (best cost - sum of individual costs), because escaping takes more
// where congestion costs more. Until then no higher cost is accepted, because a plan that still
// improves quickly would improve more slowly: random-32-32-20, 200 agents, ten seconds, 5,202 to
// 5,238 instead of 5,149. Nor is one accepted while the best cost exceeds the sum of individual
// costs by more than record_deviation_max_loss times that sum: instances so dense improve for the
// whole run.
//
// *Cutoff.* The cutoff of a call is the old cost (plus what acceptance allows), less the new paths
// so far, less the individual costs of the agents still to be planned. Above it the iteration fails
// anyway.
//
// *Not used: joint search* of two or three agents around the others, where planning one by one
// gained nothing. One in five of the smaller neighbourhoods gains, but the time is better spent
// otherwise. Medians of three seeds, 5 s on a busy machine:
//
//   instance           agents   without    with
//   random-32-32-20       150     3,861   3,921
//   random-32-32-20       100     2,361   2,364
//   room-32-32-4           60     1,756   1,764
//   room-32-32-4           80     2,415   2,432
//   empty-32-32           200     4,358   4,360
//
// Used only after a long time without improvement, 8 s, room, 60 agents: 1,756 and 1,759, 1,646 and
// 1,646.
#include "primal/lns.h"

#include <algorithm>
#include <span>
#include <utility>

namespace grove::detail {
namespace {

constexpr double kRepairLabels = 2000;  // base of the label limit per repaired agent
// Multiple of the mean number of labels of successful calls that is added.
constexpr double kRepairLabelsFactor = 16;
constexpr double kRepairDecay = 0.98;  // decay of the statistics of repair operators per iteration
// One iteration in this number uses a random repair operator.
constexpr int kRepairExplorationPeriod = 10;
// Failed iterations per agent before worse plans are accepted.
constexpr std::int64_t kRecordDeviationStart = 1;

constexpr std::int64_t kMaxFirstLabels = std::int64_t{1} << 40;

}  // namespace

void LargeNeighborhoodSearch::step(const Limits& limits) {
  ++steps_;
  const std::vector<AgentIndex>& agents = neighborhoods_.choose();
  RepairOperator& repair = choose_repair();
  const std::int64_t work_before = low_level_.work();
  Cost old_cost = 0;
  old_paths_.clear();
  for (AgentIndex agent : agents) {
    old_cost += paths_.cost(agent);
    old_paths_.push_back(paths_.take(agent));
  }
  const Cost others = paths_.cost();
  if (!replan(agents, old_cost + worse_allowed(others + old_cost), repair, limits)) restore(agents);
  const Cost gain = std::max<Cost>(0, others + old_cost - paths_.cost());
  neighborhoods_.reward(gain);
  const std::int64_t work = low_level_.work() - work_before;
  repair.gain = kRepairDecay * repair.gain + static_cast<double>(gain);
  repair.work = kRepairDecay * repair.work + static_cast<double>(work);
}

LargeNeighborhoodSearch::RepairOperator& LargeNeighborhoodSearch::choose_repair() {
  const std::span<RepairOperator> repairs(
      repair_operators_.data(),
      repair_operators_.size() - (low_level_.dual_solution() == nullptr ? 1 : 0));
  if (random_.below(kRepairExplorationPeriod) == 0) return repairs[random_.below(repairs.size())];
  return *std::ranges::max_element(
      repairs, {}, [](const RepairOperator& repair) { return (repair.gain + 1) / repair.work; });
}

// By how much the next plan may exceed `cost`, the cost of the current plan.
Cost LargeNeighborhoodSearch::worse_allowed(Cost cost) {
  if (cost < best_) {
    best_ = cost;
    failures_ = 0;
  }
  if (++failures_ <= kRecordDeviationStart * std::ssize(paths_.paths())) return 0;
  const auto loss = static_cast<double>(best_ - own_costs_);
  if (loss > tuning_.record_deviation_max_loss * static_cast<double>(own_costs_)) return 0;
  const double more = tuning_.record_deviation * loss;
  return std::max<Cost>(0, best_ + static_cast<Cost>(more + random_.unit()) - cost);
}

// Returns false if the agents, planned in this order, find no paths of total cost `total_cutoff` or
// less.
bool LargeNeighborhoodSearch::replan(const std::vector<AgentIndex>& agents, Cost total_cutoff,
                                     RepairOperator& repair, const Limits& limits) {
  Cost left = total_cutoff;
  for (AgentIndex agent : agents) left -= low_level_.individual_cost(agent);
  for (AgentIndex agent : agents) {
    const Cost cutoff = left + low_level_.individual_cost(agent);
    if (!find(agent, cutoff, repair, limits)) return false;
    paths_.put(agent, std::move(path_));
    path_.clear();
    left = cutoff - paths_.cost(agent);
  }
  return true;
}

bool LargeNeighborhoodSearch::find(AgentIndex agent, Cost cutoff, RepairOperator& repair,
                                   const Limits& limits) {
  const double of_others = kRepairLabels + kRepairLabelsFactor * repair.labels / repair.found;
  const PathQuery query{
      .cutoff = static_cast<Time>(cutoff),
      .label_limit = repair.found > 0 ? static_cast<std::int64_t>(of_others) : repair.first_labels,
      .reservations = &paths_.reservations(),
      .inflation_percent = repair.inflation_percent,
      .known_sequences_only = true};
  const std::int64_t before = low_level_.expanded();
  if (low_level_.find(agent, query, limits, path_) != PathOutcome::kFound) {
    if (repair.found <= 0 && repair.first_labels < kMaxFirstLabels) repair.first_labels *= 2;
    return false;
  }
  if (repair.priced)
    low_level_.improve(agent, paths_.reservations(), static_cast<Time>(cutoff), limits, path_);
  repair.labels =
      kRepairDecay * repair.labels + static_cast<double>(low_level_.expanded() - before);
  repair.found = kRepairDecay * repair.found + 1;
  return true;
}

void LargeNeighborhoodSearch::restore(const std::vector<AgentIndex>& agents) {
  for (AgentIndex agent : agents)
    if (!paths_.path(agent).empty()) paths_.take(agent);
  for (std::size_t i = 0; i < agents.size(); ++i) paths_.put(agents[i], std::move(old_paths_[i]));
}

}  // namespace grove::detail
