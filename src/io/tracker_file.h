// SPDX-License-Identifier: MIT
// Writes plans for MAPF Tracker (https://tracker.pathfinding.ai), an archive of the best plans and
// bounds for the Moving AI scenarios.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "model/plan.h"

namespace grove::detail {

// The scenario whose first rows are the instance. For example, random-32-32-20-even-1.scen has the
// map "random-32-32-20", the type "even" and the number 1.
struct TrackerScenario {
  std::string map;   // without .map
  std::string type;  // even or random
  int number = 0;
};

// Reads type and number from text such as "even-1". Returns nullopt for any other text.
std::optional<TrackerScenario> parse_tracker_scenario(const std::string& map,
                                                      const std::string& type_and_number);

enum class TrackerLayout : std::uint8_t { kJson, kCsv };

// The meaning of 'u' in a motion string. Moving AI's y grows downwards, so according to the
// tracker's documentation 'u' is y - 1. In the tracker's downloads it is y + 1, and flip_up_down:
// true states this.
enum class TrackerUp : std::uint8_t { kTowardsRowZero, kAwayFromRowZero };

// Throws NotRepresentable for tasks and for agents without a destination, because the tracker's
// instances are classical MAPF.
void require_tracker_instance(const Instance& instance);

// Writes `solution` as one row, atomically. Precondition: it has a plan of `instance` that is valid
// by check(). There is one motion string per agent over u d l r w, run-length encoded, without the
// waits at the end, which the tracker would count as costs. lower_cost is the proven lower bound.
// Throws the exceptions of require_tracker_instance(), and InputError if the file cannot be
// written.
void write_tracker_row(const std::filesystem::path& path, const Instance& instance,
                       const Solution& solution, const TrackerScenario& scenario,
                       TrackerLayout layout, TrackerUp up);

}  // namespace grove::detail
