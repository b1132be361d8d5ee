// SPDX-License-Identifier: MIT
// Large neighbourhood search: from a plan to a cheaper one, a few agents at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/random.h"
#include "model/tuning.h"
#include "primal/neighborhoods.h"
#include "primal/planned_paths.h"
#include "primal/primal_low_level.h"

namespace grove::detail {

// Takes the paths of a few agents away and plans them anew, one after the other, in random order.
// The new paths stay if they cost no more together; after many that did not help also if all paths
// cost little more than the best ones met. (MAPF-LNS: Li et al., IJCAI 2021; the low level here
// chooses the order of the tasks too. Record-to-record travel: Dueck 1993.)
class LargeNeighborhoodSearch {
 public:
  // All must outlive this.
  LargeNeighborhoodSearch(const Problem& problem, PrimalLowLevel& router, PlannedPaths& paths,
                          Random& random, const Tuning& tuning)
      : router_(router),
        paths_(paths),
        random_(random),
        tuning_(tuning),
        neighborhoods_(problem, router, paths, random, tuning) {}

  // One neighbourhood; all agents must have paths, and have them afterwards whatever happens.
  void step(const Limits& limits);

  // There is another plan to begin with; alone the agents would cost so much.
  void begin(Cost individual_costs) {
    least_ = kInfiniteCost;
    own_costs_ = individual_costs;
  }

  std::int64_t steps() const { return steps_; }

 private:
  // How an agent is planned: exactly, greedily, or so that it pays least where prices are known;
  // which does better is found out on the way.
  struct RepairOperator {
    int inflation_percent;
    bool priced;
    double gain = 0;                     // of late
    double work = 1;                     // of late, in labels
    double labels = 0;                   // of late, of calls that found a path
    double found = 0;                    // of late, such calls
    std::int64_t first_labels = 20'000;  // a call may take so many before any has found a path
  };

  RepairOperator& choose_repair();
  Cost worse_allowed(Cost cost);
  bool plan_anew(const std::vector<AgentIndex>& agents, Cost most, RepairOperator& way,
                 const Limits& limits);
  bool find(AgentIndex agent, Cost cutoff, RepairOperator& way, const Limits& limits);
  void restore(const std::vector<AgentIndex>& agents);

  PrimalLowLevel& router_;
  PlannedPaths& paths_;
  Random& random_;
  const Tuning& tuning_;
  Neighborhoods neighborhoods_;
  std::array<RepairOperator, 3> repair_operators_{
      RepairOperator{0, false}, RepairOperator{30, false}, RepairOperator{0, true}};
  Cost own_costs_ = 0;
  Cost least_ = kInfiniteCost;  // of plans met since begin()
  std::int64_t in_vain_ = 0;    // neighbourhoods since then
  std::vector<Path> old_paths_;
  Path path_;
  std::int64_t steps_ = 0;
};

}  // namespace grove::detail
