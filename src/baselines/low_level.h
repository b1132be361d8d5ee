// SPDX-License-Identifier: MIT
// The low levels of published methods, to compare with: CBS with one of them in place of Grove's
// own and no technique beside is that method.
#pragma once

#include <cstdint>
#include <memory>

#include "planning/agent_planner.h"

namespace grove::detail {

// What plans a single agent that chooses the order of its tasks.
enum class LowLevel : std::uint8_t {
  kOwn,                 // Grove's: FreeOrderSipp
  kVisitedSets,         // Optimal-CBS: A* over (cell, time, tasks visited); visited_set_search.cpp
  kSingleLegs,          // HCBS (Surynek 2021): A* over visiting orders, A* for each leg;
                        // space_time_legs.cpp
  kTimeIntervalForest,  // MGCBS (Tang et al. 2024): the same over goals' safe intervals, legs from
                        // a forest of trees; time_interval_forest.cpp
};

// `world` must outlive what is returned. All but Grove's own know no constraints but bars, no
// reservations and no class but that of all sequences (std::invalid_argument), heed nothing of a
// query but constraints and cutoff, and throw std::bad_alloc for want of memory. The stops of one
// agent must be the same at every call.
std::unique_ptr<AgentPlanner> make_agent_planner(LowLevel low_level, const World& world);

}  // namespace grove::detail
