// SPDX-License-Identifier: MIT
// Plans of other tools, as they write them: bare paths, and what they claim of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// A plan of any tool in the terms of Grove's own. What its file does not tell is worked out from
// the paths (costs, the order of tasks) or left as weak as it can be (a lower bound of 0, omega
// inf), and named in `unclaimed`: there is nothing of that for check() to refute.
struct ClaimedPlan {
  Solution solution;
  std::vector<std::string> unclaimed;  // of "cost", "lower bound", "order of tasks"
};

// Agents move freely and tasks take no time: then the places of a path say all of it.
bool paths_are_places(const Instance& instance);

// The plan in which agents walk these paths, in the instance's order; costs, and in which order
// tasks are done, are worked out. For paths_are_places(). It need not be valid.
Plan plan_of_paths(const Instance& instance, std::vector<Path> paths);

// Reads, told apart by their content:
//   - plan files, by read_solution(), which claim everything;
//   - the path lists of EECBS, CBSH2-RTC and MAPF-LNS2: "Agent 0: (row,column)->(row,column)->",
//     which claim nothing;
//   - the text of lacam and pibt, which mapf-visualizer reads: after "solution=" a line for each
//     time, "3:(x,y),(x,y),", of all agents. Claims "soc", the cost, and "soc_lb", a lower bound,
//     where they are there; no plan where it says "solved=0" or does not get as far.
//   - the YAML of libMultiRobotPlanning, MGCBS and ITA-CBS: below "schedule:" a list of x, y, t for
//     each agent, by its id, or by its number as "agent7". Claims the "cost" of its "statistics".
// Agents are those of `instance`, in its order; one that is left out has an empty path. Throws
// InputError on anything else, and when a path leads out of the map.
ClaimedPlan read_plan_of_any_tool(const std::filesystem::path& path, const Instance& instance);

// A plan of any tool, its costs counted anew by the one definition there is: the sum of the times
// from which agents rest for good. Nothing is left of what was claimed but this.
struct RecountedPlan {
  Solution solution;  // no bound, omega inf; for check(), and no plan if there is none
  std::optional<Cost> claimed_cost = {};
  std::optional<Cost> claimed_lower_bound = {};
};

// read_plan_of_any_tool(), recounted. Where robots turn or tasks take time the costs stay as they
// are claimed, for check() to refute. Throws as that does.
RecountedPlan read_and_recount(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
