// SPDX-License-Identifier: MIT
// Prices of choices: of one agent, and of all agents of an instance.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "model/grid.h"
#include "model/instance.h"
#include "model/omega.h"
#include "model/plan.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Prices of the choices of one agent, in steps. The *price* of a path is its cost, plus the prices
// of the stops that it leaves out, plus the price of the goal on which it ends.
struct AgentPrices {
  struct Goal {
    Place place;
    Time price;
  };
  std::vector<Time> skip;  // by stop: for leaving it out; kNever: it must visit it
  // By stop: its neighbourhood, for lower bounds (sequencing/optional_stops_dag.h).
  std::vector<StopSet> neighborhoods;
  std::vector<Goal> goals;      // where it may end; empty: as the instance says
  bool rests_anywhere = false;  // it may end on any place, but not within a turn
  // On a place of these stops it may end only if it has counted one of them that is there.
  StopSet rest_requires = 0;
};

// Prices for an instance in which agents may leave out stops. The stops that agents count must
// satisfy `needs`. The cost of a plan is the sum of the prices of its paths, plus the prices of the
// goals for which no agent pays, minus `constant`.
struct Prices {
  // The visits of one task: by agents, with the position of the task in Agent::stops.
  struct Visit {
    AgentIndex agent;
    int stop;
  };
  struct Need {
    TaskIndex task = 0;
    Time price = 0;  // what an agent pays that leaves the task out
    int count = 1;
    bool is_exact = false;  // exactly `count` of `visits` are counted; otherwise at least `count`
    std::vector<Visit> visits;
  };
  std::vector<std::optional<AgentPrices>> agents;  // by AgentIndex; nullopt: without choices
  std::vector<Need> needs;
  std::vector<AgentPrices::Goal> goals;  // all goals with a price above 0
  Cost constant = 0;
};

// A path of an agent with prices, and the stops that it counts, with the times, in order.
struct CountedPath {
  Path path;
  std::vector<std::pair<Time, int>> counted;
};

}  // namespace grove::detail
