// SPDX-License-Identifier: MIT
// Plans of other tools, as they write them: bare paths, and what they claim of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "grove/detail/model/plan.h"

namespace grove::detail {

// A plan of any tool in the terms of Grove's own. What its file does not tell is worked out from
// the paths (costs, the order of tasks) or left as weak as it can be (a lower bound of 0, omega
// inf), and named in `unclaimed`: there is nothing of that for check() to refute.
struct ClaimedPlan {
  Solution solution;
  std::vector<std::string> unclaimed;  // of "cost", "lower bound", "order of tasks"
};

// Reads, told apart by their content:
//   - plan files, by read_solution(), which claim everything;
//   - the path lists of EECBS, CBSH2-RTC and MAPF-LNS2: "Agent 0: (row,column)->(row,column)->",
//     which claim nothing;
//   - the text of lacam and pibt, which mapf-visualizer reads: after "solution=" a line for each
//     time, "3:(x,y),(x,y),", of all agents. Claims "soc", the cost, and "soc_lb", a lower bound,
//     where they are there; no plan where it says "solved=0" or does not get as far.
// Agents are those of `instance`, in its order; one that is left out has an empty path. Throws
// InputError on anything else, and when a path leads out of the map. Appends to `warnings`.
ClaimedPlan read_plan_of_any_tool(const std::filesystem::path& path, const Instance& instance,
                                  std::vector<std::string>* warnings = nullptr);

}  // namespace grove::detail
