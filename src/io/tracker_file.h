// SPDX-License-Identifier: MIT
// Writes plans for MAPF Tracker (https://tracker.pathfinding.ai), an archive of the best known
// plans and bounds for the Moving AI scenarios.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "model/plan.h"

namespace grove::detail {

// The scenario from whose first rows the instance was made. For example,
// random-32-32-20-even-1.scen has the map "random-32-32-20", the type "even" and the number 1.
struct TrackerScenario {
  std::string map;   // without .map
  std::string type;  // "even" or "random"
  int number = 0;
};

// Parses type and number from text such as "even-1". Returns nullopt if the text has a different
// form.
std::optional<TrackerScenario> parse_tracker_scenario(const std::string& map,
                                                      const std::string& type_and_number);

enum class TrackerLayout : std::uint8_t { kJson, kCsv };

// The meaning of 'u' in a motion string. In the tracker's documentation 'u' is a step to y - 1,
// because Moving AI's y grows downwards. In the tracker's downloads 'u' is a step to y + 1, and the
// field flip_up_down is true.
enum class TrackerUp : std::uint8_t { kTowardsRowZero, kAwayFromRowZero };

// Throws NotRepresentable if the map is a roadmap, there are tasks, an agent has no destination, or
// its turns take time, because the tracker's instances are classical MAPF.
void require_tracker_instance(const Instance& instance);

// Writes `solution` as one row, atomically. Precondition: `solution` has a plan of `instance` that
// is valid by check(). The row contains one motion string per agent over the letters u, d, l, r and
// w, run-length encoded and without the waits at the end, which the tracker would count as costs.
// lower_cost is the proven lower bound. Throws the exceptions of require_tracker_instance(), and
// InputError if the file cannot be written.
void write_tracker_row(const std::filesystem::path& path, const Instance& instance,
                       const Solution& solution, const TrackerScenario& scenario,
                       TrackerLayout layout, TrackerUp up);

}  // namespace grove::detail
