// SPDX-License-Identifier: MIT
// Reads plans in the file formats of other tools: the paths, and the claims about them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/plan_file.h"
#include "model/plan.h"

namespace grove::detail {

// A plan of any tool, as a Solution. Claims that the file does not contain are computed from the
// paths (costs, order of tasks) or set to the weakest value (lower bound 0, omega inf). Except for
// omega, they are listed in `unclaimed`, because check() cannot refute them.
struct ClaimedPlan {
  Solution solution;
  std::vector<std::string> unclaimed;  // subset of "cost", "lower bound", "order of tasks"
  AgentOrder order = {};               // only for Grove's own plan files
};

// True if agents turn freely, so that a sequence of places determines a path.
bool paths_are_places(const Instance& instance);
// True if, in addition, no task has stated visits, so that the paths determine the plan.
bool plans_are_paths(const Instance& instance);

using Visits = std::vector<std::vector<WorkTime>>;  // by AgentIndex: the stated visits

// Returns the plan with these paths, by AgentIndex, and with costs and orders of tasks computed
// from them. The plan need not be valid. Preconditions: paths_are_places(); plans_are_paths() if
// `visits` is empty.
Plan plan_of_paths(const Instance& instance, std::vector<Path> paths, Visits visits = {});

// Reads a plan. The format is detected from the content:
// - Grove plan files (see read_solution()), which contain all claims;
// - path lists of EECBS, CBSH2-RTC and MAPF-LNS2: "Agent 0: (row,column)->(row,column)->". They
//   contain no claims;
// - the text format of lacam, pibt and mapf-visualizer: after "solution=", one line per time step
//   with the cells of all agents, "3:(x,y),(x,y),". The claims are "soc", the cost, and "soc_lb", a
//   lower bound, if they are present. There is no plan if the file contains "solved=0" or ends
//   before the solution;
// - the YAML of libMultiRobotPlanning, MGCBS and ITA-CBS: below "schedule:", a list of x, y, t for
//   each agent, under its id or its number ("agent7"). The claim is "cost" in "statistics", if it
//   is present. There is no plan if "schedule:" has no value.
//
// The agents of the result are those of `instance`, in its order. An agent that is missing in the
// file has an empty path. Throws InputError for any other content, if a path leaves the map, and
// for the format of another tool if a task has a choice of agents, because only Grove's plan files
// state visits.
ClaimedPlan read_plan_of_any_tool(const std::filesystem::path& path, const Instance& instance);

// A plan of any tool, with the cost recomputed as the sum of the times from which the agents rest
// forever. Other claims of the file are removed from `solution`.
struct RecountedPlan {
  Solution solution;  // for check(), with lower bound 0 and omega inf; without a plan if the file
                      // has none
  std::optional<Cost> claimed_cost = {};
  std::optional<Cost> claimed_lower_bound = {};
};

// Reads a plan as read_plan_of_any_tool() does, and recomputes the costs. If agents turn or tasks
// have stated visits, the costs remain as claimed in the file, and check() verifies them. Throws
// the exceptions of read_plan_of_any_tool().
RecountedPlan read_and_recount(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
