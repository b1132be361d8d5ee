// SPDX-License-Identifier: MIT
// Low levels of published methods, for comparison. CBS with one of them instead of Grove's own low
// level, and without any other technique, is that method.
#pragma once

#include <cstdint>
#include <memory>

#include "planning/agent_planner.h"

namespace grove::detail {

// Planner of a single agent that chooses the order of its tasks.
enum class LowLevel : std::uint8_t {
  kOwn,                 // Grove's: FreeOrderSipp
  kVisitedSets,         // Optimal-CBS: A* over (cell, time, tasks visited); visited_set_search.cpp
  kSingleLegs,          // HCBS (Surynek 2021): A* over visiting orders, A* for each leg;
                        // space_time_legs.cpp
  kTimeIntervalForest,  // MGCBS (Tang et al. 2024): the same over goals' safe intervals, legs from
                        // a forest of trees; time_interval_forest.cpp
};

// Makes the planner. `world` must outlive it. All except kOwn
// - support only vertex and edge constraints, no reservations, and only the class of all sequences
//   (otherwise std::invalid_argument),
// - ignore everything in a query except constraints and cutoff,
// - throw std::bad_alloc if memory is insufficient.
//
// The stops of one agent must be the same in every call.
std::unique_ptr<AgentPlanner> make_agent_planner(LowLevel low_level, const World& world);

}  // namespace grove::detail
