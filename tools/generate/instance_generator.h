// SPDX-License-Identifier: MIT
// Instances of the paper's data sets (section V): agents and tasks from the rows of a scenario.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/scenario_file.h"
#include "model/instance.h"

namespace grove::detail {

struct Scenario {
  std::string name;  // file of the scenario, for messages
  std::vector<ScenarioRow> rows;
};

// Features that the paper's instances do not have.
struct Extras {
  struct Range {
    Time min = 0;
    Time max = 0;
  };
  Time turn_steps = 0;         // duration of a quarter turn; 0: agents turn instantly
  bool goal_headings = false;  // whether agents with turn_steps > 0 have a heading at the goal
  Range durations = {};        // of tasks, steps, drawn uniformly

  // Returns "_turning2_d0-10", for file names; "" without extras.
  std::string suffix() const;
};

struct InstanceRequest {
  int agents = 1;
  int tasks = 0;
  std::uint64_t seed = 0;
  // MG-MAPF: no agent has a destination; its destination becomes one more task of that agent.
  bool mg = false;
  // Drawn independently, so that all else does not depend on them. Turns only on grids.
  Extras extras = {};
};

// Returns the first row (from 0) whose start may become a task: 20, or the number of agents if
// larger.
int first_task_row(int agents);
// Returns the number of rows that a request uses if no start repeats.
int rows_needed(const InstanceRequest& request);

// Generates an instance. The first `agents` rows are the agents a0, a1, ...; the starts of the rows
// from first_task_row on are the tasks t0, t1, .... Each task is given to 1, 2 or 3 distinct
// agents, drawn from all agents that can reach it. Skips rows whose start is already a task or that
// no agent can reach. Throws InputError, which names the scenario, if it has too few rows or rows
// that do not fit `grid`, or if an agent would get more than kMaxTasksPerAgent tasks.
Instance generate_instance(const Grid& grid, const Scenario& scenario,
                           const InstanceRequest& request);

}  // namespace grove::detail
