// SPDX-License-Identifier: MIT
// Repair operators and acceptance of large neighbourhood search.
//
// *Exact and greedy search.* The low level's heuristic ignores the other agents, so an exact search
// expands every label with f below the cost of the best path, which are very many in dense
// instances. A greedy search (inflation_percent) finds good paths much sooner there, and slightly
// worse paths elsewhere. Therefore both searches are repair operators with statistics of recent
// gain and effort; usually the operator with the best ratio of gain to effort is used. New paths of
// equal cost count as a small gain (kNewPaths), because they can lead out of a local optimum.
// Without gain, the operators get equal shares of the effort, because the statistics of an operator
// decay also while it is not used. (If they did not, the operator whose calls fail soonest would be
// used almost alone: on den312d with 100 agents and 300 tasks, 948 of 1,000 iterations were greedy,
// and none of them reduced the cost.)
//
// *Ties.* Among paths of equal cost, the low level prefers paths that have few conflicts with the
// individual and the old paths of the agents that are planned later in the iteration. These agents
// then find cheaper paths. The incumbents of 12 classical instances (60 to 500 agents, 10 s) cost
// 0.974 to 1.006 times as much as before this preference, the statistics above, and the preference
// of prioritised planning; geometric mean 0.992 (with the individual paths alone). Incumbents after
// 30 s (the last two columns with the preference of prioritised planning, too):
//
//   instance                 agents/tasks   before   statistics   + individual   + old paths
//   den312d                       100/300   25,480       25,469         25,426        25,405
//   den312d                       100/300   23,819       23,724         23,691        23,680
//   random-64-64-10               200/600   36,817       36,806         36,763        36,759
//   random-64-64-10               200/600   36,006       35,965         35,920        35,909
//   random-64-64-20               100/200   15,170       15,151         15,148        15,145
//   empty-48-48                   200/400   22,021       21,993         21,976        21,976
//
// *Label limit.* A low-level call is aborted after many times the mean number of labels of calls
// that found a path, because by then usually no path exists, and the time is better spent
// elsewhere. Until an operator has found a path, its limit is first_labels, which doubles after
// each failure.
//
// *Penalised costs.* With a dual solution, an agent can avoid the places and times that other
// agents need more, because the multipliers penalise them. The cheapest path is found first and
// then replaced by the path of least penalised cost.
//
// *Acceptance.* LNS soon reaches a local optimum. After kRecordDeviationStart iterations per agent
// without improvement, it also accepts plans that cost up to record_deviation times (best cost -
// sum of individual costs) more than the best plan so far. The deviation is proportional to this
// difference, because escaping from a local optimum takes more where congestion costs more. Higher
// costs are not accepted earlier, because they slow down a search that still improves quickly:
// random-32-32-20, 200 agents, ten seconds, 5,202 to 5,238 instead of 5,149. Nor are they accepted
// while the best cost exceeds the sum of individual costs by more than record_deviation_max_loss
// times that sum, because plans of such dense instances improve during the whole run.
//
// *Cutoff.* The cutoff of a low-level call is the cost of the removed paths, plus the accepted
// increase, minus the costs of the new paths so far, minus the individual costs of the agents still
// to be planned. If these individual costs are optimal, a path above the cutoff makes the iteration
// fail in any case. If some are not (PrimalLowLevel::knows_best()), the cutoff is a heuristic: it
// can also end an iteration in which a later agent would have found a path cheaper than its
// individual path.
//
// *Not used: joint search* of two or three agents around the others, for neighbourhoods in which
// planning one by one gained nothing. It reduces the cost in one in five of these neighbourhoods,
// but the time is better spent otherwise. Median costs of three seeds, 5 s on a busy machine:
//
//   instance           agents   without    with
//   random-32-32-20       150     3,861   3,921
//   random-32-32-20       100     2,361   2,364
//   room-32-32-4           60     1,756   1,764
//   room-32-32-4           80     2,415   2,432
//   empty-32-32           200     4,358   4,360
//
// If joint search is used only after a long time without improvement (8 s, room, 60 agents), the
// costs without and with it are 1,756 and 1,759, or 1,646 and 1,646.
#include "primal/lns.h"

#include <algorithm>
#include <span>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr double kRepairLabels = 2000;  // base of the label limit per repaired agent
// Multiple of the mean number of labels of successful calls that is added to this base.
constexpr double kRepairLabelsFactor = 16;
constexpr double kLabelsDecay = 0.98;  // decay factor of `labels` and `found` per path found
constexpr double kGainDecay = 0.99;    // decay factor of `gain` and `work` per iteration
// Value of new paths of equal or higher cost, as a cost reduction.
constexpr double kNewPaths = 0.02;
// Added to all gains, so that operators without gain are compared by their effort.
constexpr double kLeastGain = 0.02;
// One iteration in 10 uses a random repair operator.
constexpr int kRepairExplorationPeriod = 10;
// Iterations without improvement, per agent, before worse plans are accepted.
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
  const Cost cutoff = old_cost + worse_allowed(others + old_cost);
  bool is_new = false;
  if (replan(agents, cutoff, repair, limits)) {
    GROVE_CHECK(paths_.cost() <= others + cutoff, "new paths cost at most the cutoff");
    is_new = has_new_paths(agents);
  } else {
    restore(agents);
    GROVE_CHECK(paths_.cost() == others + old_cost, "restored paths have their old cost");
  }
  const Cost gain = std::max<Cost>(0, others + old_cost - paths_.cost());
  neighborhoods_.reward(gain);
  reward(repair, gain, is_new, low_level_.work() - work_before);
}

LargeNeighborhoodSearch::RepairOperator& LargeNeighborhoodSearch::choose_repair() {
  const std::span<RepairOperator> repairs(
      repair_operators_.data(),
      repair_operators_.size() - (low_level_.dual_solution() == nullptr ? 1 : 0));
  if (random_.below(kRepairExplorationPeriod) == 0) return repairs[random_.below(repairs.size())];
  return *std::ranges::max_element(repairs, {}, [](const RepairOperator& repair) {
    return (repair.gain + kLeastGain) / repair.work;
  });
}

void LargeNeighborhoodSearch::reward(RepairOperator& repair, Cost gain, bool is_new,
                                     std::int64_t work) {
  for (RepairOperator& any : repair_operators_) {
    any.gain *= kGainDecay;
    any.work *= kGainDecay;
  }
  repair.gain += static_cast<double>(gain) + (is_new ? kNewPaths : 0);
  repair.work += static_cast<double>(work);
}

// Returns the amount by which the next plan may exceed `cost`, the cost of the current plan.
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

// Plans the agents in this order, with total cost at most `total_cutoff`. Returns false if a
// low-level call fails; some agents then have new paths.
bool LargeNeighborhoodSearch::replan(const std::vector<AgentIndex>& agents, Cost total_cutoff,
                                     RepairOperator& repair, const Limits& limits) {
  Cost left = total_cutoff;
  wanted_.clear();
  for (std::size_t i = 0; i < agents.size(); ++i) {
    left -= low_level_.individual_cost(agents[i]);
    wanted_.add(low_level_.individual_path(agents[i]));
    wanted_.add(old_paths_[i]);
  }
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const AgentIndex agent = agents[i];
    wanted_.remove(low_level_.individual_path(agent));
    wanted_.remove(old_paths_[i]);
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
      .others = &wanted_,
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
      kLabelsDecay * repair.labels + static_cast<double>(low_level_.expanded() - before);
  repair.found = kLabelsDecay * repair.found + 1;
  return true;
}

void LargeNeighborhoodSearch::restore(const std::vector<AgentIndex>& agents) {
  for (AgentIndex agent : agents)
    if (!paths_.path(agent).empty()) paths_.take(agent);
  for (std::size_t i = 0; i < agents.size(); ++i) paths_.put(agents[i], std::move(old_paths_[i]));
}

bool LargeNeighborhoodSearch::has_new_paths(const std::vector<AgentIndex>& agents) const {
  for (std::size_t i = 0; i < agents.size(); ++i)
    if (paths_.path(agents[i]) != old_paths_[i]) return true;
  return false;
}

}  // namespace grove::detail
