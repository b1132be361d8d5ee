// SPDX-License-Identifier: MIT
// Neighbourhoods of a plan for a search over all assignments.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "assignment/assignment.h"
#include "assignment/route_bound.h"
#include "assignment/routes.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/plan.h"
#include "model/random.h"

namespace grove::detail {

// Neighbourhoods for large neighbourhood search (Shaw 1998) in which the repair step is an exact
// search, as in RINS for integer programs (Danna, Rothberg and Le Pape 2005). In a neighbourhood, a
// few agents close to each other exchange their tasks and goals freely, and the others keep theirs.
// If no cheaper plan contains a visit or a goal of the plan (reduced cost fixing), it is removed:
// any agent may take that task, and that agent any goal. The number of free agents begins at 3 for
// each plan and grows by 1 after as many draws as there are agents. Heuristic: the search of a
// neighbourhood proves nothing for others. Repeatable, unless a limit is reached. One thread at a
// time.
class ChoiceNeighborhoods {
 public:
  // Makes a copy of `bound`. `routes`: any routes of the instance, of which only the costs are
  // used. The other arguments must outlive this object.
  ChoiceNeighborhoods(const Instance& instance, const Routes& routes, const RouteBound& bound,
                      std::uint64_t seed);

  // Sets the plan, a valid plan of the instance that costs less than that of the last call.
  void start_from(const Plan& plan, const Limits& limits);
  // Draws a few neighbourhoods. Returns the choices in the first one with plans that may be
  // cheaper, valid until the next call; nullptr: there is none among them, or a limit is reached.
  RouteBound* next(const Limits& limits);
  // True if there are no further neighbourhoods of this plan.
  bool is_over() const { return !is_possible_; }

 private:
  void grow();
  std::vector<AgentIndex> draw_agents();
  std::int64_t distance(AgentIndex from, AgentIndex to) const;
  std::vector<RouteChoices> choices_of(const std::vector<AgentIndex>& free) const;

  const Instance& instance_;
  const RouteCosts& costs_;
  RouteBound bound_;
  bool is_possible_ = false;
  Assignment assignment_;  // of the plan
  Cost cutoff_ = kInfiniteCost;
  Random random_;
  int free_agents_ = 0;
  int drawn_ = 0;  // since the number of free agents grew
  std::set<std::vector<AgentIndex>> known_;
  std::unique_ptr<RouteBound> current_;
};

}  // namespace grove::detail
