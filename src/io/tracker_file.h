// SPDX-License-Identifier: MIT
// Plans for MAPF Tracker (https://tracker.pathfinding.ai), an archive of the best plans and bounds
// for the Moving AI scenarios.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "model/plan.h"

namespace grove::detail {

// Which scenario an instance is the beginning of: random-32-32-20-even-1.scen is the map
// "random-32-32-20", the type "even" and the number 1.
struct TrackerScenario {
  std::string map;   // without .map
  std::string type;  // even or random
  int number = 0;
};

// "even-1": type and number. None for anything else.
std::optional<TrackerScenario> parse_tracker_scenario(const std::string& map,
                                                      const std::string& type_and_number);

enum class TrackerLayout : std::uint8_t { kJson, kCsv };

// What 'u' is in a motion string. Moving AI's y grows downwards, so by the tracker's documents 'u'
// is y - 1; what it offers for download has y + 1 there, and flip_up_down: true says so.
enum class TrackerUp : std::uint8_t { kTowardsRowZero, kAwayFromRowZero };

// Throws NotRepresentable for tasks and for agents without a destination: the tracker's instances
// are classical MAPF.
void require_tracker_instance(const Instance& instance);

// Writes `solution` as one row, whole or not at all; it must hold a valid plan of `instance` (ask
// check() first). Per agent one motion string over u d l r w, run-length encoded, without the waits
// at its end, which the tracker would charge. lower_cost is the proven lower bound. Throws as
// require_tracker_instance() does, and InputError when the file cannot be written.
void write_tracker_row(const std::filesystem::path& path, const Instance& instance,
                       const Solution& solution, const TrackerScenario& scenario,
                       TrackerLayout layout, TrackerUp up);

}  // namespace grove::detail
