// SPDX-License-Identifier: MIT
// Large neighbourhood search (LNS): improves a plan by re-planning a few agents at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/random.h"
#include "model/tuning.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/planned_paths.h"
#include "primal/neighborhoods.h"
#include "primal/primal_low_level.h"

namespace grove::detail {

// MAPF-LNS (Li et al., IJCAI 2021). Each iteration removes the paths of a few agents and re-plans
// these agents one after the other, in random order. It keeps the new paths if their total cost is
// not higher. After many iterations without improvement it also keeps them if the plan costs a
// little more than the best plan so far (record-to-record travel: Dueck 1993). The low level also
// chooses the order of each agent's tasks. Among paths of equal cost it prefers those that leave
// the paths that the agents still to be planned are likely to take. One thread at a time.
class LargeNeighborhoodSearch {
 public:
  // All references must outlive this object.
  LargeNeighborhoodSearch(const Problem& problem, PrimalLowLevel& low_level, PlannedPaths& paths,
                          Random& random, const Tuning& tuning)
      : low_level_(low_level),
        paths_(paths),
        random_(random),
        tuning_(tuning),
        neighborhoods_(problem, low_level, paths, random, tuning),
        wanted_(problem.instance.world()) {}

  // Runs one iteration. All agents must have paths; they also have paths afterwards, even if a
  // limit is reached.
  void step(const Limits& limits);

  // Starts on a new plan, which must be in `paths`. `individual_costs`: sum of the agents'
  // individual costs.
  void begin(Cost individual_costs) {
    best_ = kInfiniteCost;
    own_costs_ = individual_costs;
  }

  std::int64_t steps() const { return steps_; }

 private:
  // Repair operator: a way to re-plan one agent. It searches exactly, greedily, or for least
  // penalised cost (only with a dual solution). choose_repair() mostly selects an operator by its
  // statistics. `gain` and `work` decay in each iteration, the other two with each path found.
  struct RepairOperator {
    int inflation_percent;
    bool priced;
    double gain = 0;                     // cost reduction, and kNewPaths per set of new paths
    double work = 1;                     // effort (unit: model/effort.h)
    double labels = 0;                   // number of labels of calls that found a path
    double found = 0;                    // number of calls that found a path
    std::int64_t first_labels = 20'000;  // label limit of a call until one finds a path
  };

  RepairOperator& choose_repair();
  void reward(RepairOperator& repair, Cost gain, bool is_new, std::int64_t work);
  Cost worse_allowed(Cost cost);
  bool replan(const std::vector<AgentIndex>& agents, Cost total_cutoff, RepairOperator& repair,
              const Limits& limits);
  bool find(AgentIndex agent, Cost cutoff, RepairOperator& repair, const Limits& limits);
  void restore(const std::vector<AgentIndex>& agents);
  bool has_new_paths(const std::vector<AgentIndex>& agents) const;

  PrimalLowLevel& low_level_;
  PlannedPaths& paths_;
  Random& random_;
  const Tuning& tuning_;
  Neighborhoods neighborhoods_;
  std::array<RepairOperator, 3> repair_operators_{
      RepairOperator{0, false}, RepairOperator{30, false}, RepairOperator{0, true}};
  Cost own_costs_ = 0;
  Cost best_ = kInfiniteCost;      // least plan cost since begin()
  std::int64_t failures_ = 0;      // iterations since best_ improved
  std::vector<Path> old_paths_;    // of the agents of the neighbourhood
  ConflictAvoidanceTable wanted_;  // individual and old paths of its agents without a path
  Path path_;
  std::int64_t steps_ = 0;
};

}  // namespace grove::detail
