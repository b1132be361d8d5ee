// SPDX-License-Identifier: MIT
// Low levels of published methods, for comparison. CBS with such a low level instead of Grove's
// own, and without any other technique, is the published method.
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
  kTimeIntervalForest,  // MGCBS (Tang et al. 2024): A* over visiting orders, legs from a forest of
                        // time-interval trees; time_interval_forest.cpp
};

// Makes the planner. `world` must outlive it. All planners except that of kOwn
// - support only vertex and edge constraints, no reservations, and only the class of all sequences,
//   and otherwise throw std::invalid_argument;
// - ignore everything else in a query except the cutoff;
// - throw std::bad_alloc if memory is insufficient.
//
// In every call of find() for one agent, these planners also require the same AgentStops object,
// which must outlive the planner.
std::unique_ptr<AgentPlanner> make_agent_planner(LowLevel low_level, const World& world);

}  // namespace grove::detail
