// SPDX-License-Identifier: MIT
// The low levels of published methods, to compare with: CBS with one of them in place of Grove's
// own and no technique beside is that method.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "grove/model/limits.h"
#include "grove/model/plan.h"
#include "grove/planning/constraint.h"
#include "grove/planning/free_goals.h"

namespace grove {

// What plans a single agent that chooses the order of its tasks.
enum class LowLevel : std::uint8_t {
  kOwn,                 // Grove's: FreeLowLevelSearch
  kVisitedSets,         // Optimal-CBS: A* over (cell, time, tasks visited); visited_set_search.cpp
  kSingleLegs,          // HCBS (Surynek 2021): A* over visiting orders, A* for each leg;
                        // space_time_legs.cpp
  kTimeIntervalForest,  // MGCBS (Tang et al. 2024): the same over goals' safe intervals, legs from
                        // a forest of trees; time_interval_forest.cpp
};

// Plans one agent at a time; exact, whichever it is. Workspace of one thread: reuse it, do not
// share it.
class BaselineSearch {
 public:
  enum class Outcome : std::uint8_t {
    kFound,
    kAbove,       // proven: no path costs `cutoff` or less
    kInfeasible,  // proven: there is no path
    kStopped,     // a limit struck: nothing is known
  };

  BaselineSearch() = default;
  BaselineSearch(const BaselineSearch&) = delete;
  BaselineSearch& operator=(const BaselineSearch&) = delete;
  virtual ~BaselineSearch() = default;

  // Finds a path of least cost from the start at time 0 that visits all stops and obeys
  // `constraints`, bars all of them (also while resting at the end), if that cost is at most
  // `cutoff`. The path ends when the agent comes to rest: its cost is path.size() - 1. Writes
  // `path` only on kFound. `stops` are those of `agent`, the same at every call. Throws
  // std::invalid_argument for a constraint that is no bar, std::bad_alloc for want of memory.
  Outcome find(AgentIndex agent, const AgentStops& stops, std::span<const Constraint> constraints,
               Time cutoff, const Limits& limits, Path& path);

  // Labels expanded by all calls so far, on all levels.
  virtual std::int64_t expanded() const = 0;

 private:
  virtual Outcome search(AgentIndex agent, const AgentStops& stops,
                         std::span<const Constraint> constraints, Time cutoff, const Limits& limits,
                         Path& path) = 0;
};

// Null for kOwn. `grid` must outlive what is returned.
std::unique_ptr<BaselineSearch> make_baseline_search(LowLevel low_level, const Grid& grid);

}  // namespace grove
