// SPDX-License-Identifier: MIT
// Reads plans of other tools in their own formats: paths, and the claims about them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// A plan of any tool, as a solution of Grove. Data that the file does not contain is computed from
// the paths (costs, the order of tasks) or set to the weakest value (lower bound 0, omega inf). It
// is listed in `unclaimed`, because check() cannot refute it.
struct ClaimedPlan {
  Solution solution;
  std::vector<std::string> unclaimed;  // subset of "cost", "lower bound", "order of tasks"
};

// True if agents move freely and tasks take no time. Then a path is determined by its places.
bool paths_are_places(const Instance& instance);

// The plan with these paths, by AgentIndex. Computes the costs and the order of tasks.
// Precondition: paths_are_places(). The plan may be invalid.
Plan plan_of_paths(const Instance& instance, std::vector<Path> paths);

// Reads a plan. The format is detected from the content:
// - plan files, by read_solution(); they claim everything;
// - the path lists of EECBS, CBSH2-RTC and MAPF-LNS2: "Agent 0: (row,column)->(row,column)->"; they
//   claim nothing;
// - the text format of lacam, pibt and mapf-visualizer: after "solution=" a line for each time
//   step, "3:(x,y),(x,y),", with all agents. It claims "soc", the cost, and "soc_lb", a lower
//   bound, if they are present. There is no plan if it contains "solved=0" or ends before the
//   solution;
// - the YAML of libMultiRobotPlanning, MGCBS and ITA-CBS: below "schedule:" a list of x, y, t for
//   each agent, under its id, or under its number as "agent7". It claims the "cost" of its
//   "statistics".
//
// The agents are those of `instance`, in its order. An agent that is missing has an empty path.
// Throws InputError for any other content, and if a path leaves the map.
ClaimedPlan read_plan_of_any_tool(const std::filesystem::path& path, const Instance& instance);

// A plan of any tool with recomputed costs: the sum of the times from which the agents rest for
// ever. Other claims of the file are removed.
struct RecountedPlan {
  Solution solution;  // no bound, omega inf, for check(); without a plan if the file has none
  std::optional<Cost> claimed_cost = {};
  std::optional<Cost> claimed_lower_bound = {};
};

// read_plan_of_any_tool(), with recomputed costs. If robots turn or tasks take time, the costs
// remain as claimed, and check() verifies them. Throws the same exceptions.
RecountedPlan read_and_recount(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
