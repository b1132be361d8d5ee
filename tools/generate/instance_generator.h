// SPDX-License-Identifier: MIT
// Generates instances as in the paper's data sets (section V), with agents and tasks from the rows
// of a Moving AI scenario.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/scenario_file.h"
#include "model/instance.h"
#include "tools/generate/choices.h"

namespace grove::detail {

struct Scenario {
  std::string name;  // file of the scenario, for error messages
  std::vector<ScenarioRow> rows;
};

// Optional features, which the paper's instances do not have.
struct Extras {
  struct Range {
    Time min = 0;
    Time max = 0;
  };
  Time turn_steps = 0;         // duration of a quarter turn, time steps; 0: turns take no time
  bool goal_headings = false;  // whether agents with turn_steps > 0 have a heading at the goal
  Range durations = {};        // range of task durations, time steps, drawn uniformly

  // Returns a suffix for file names, such as "_turning2_d0-10"; "" without extras.
  std::string suffix() const;
};

struct InstanceRequest {
  int agents = 1;
  int tasks = 0;
  std::uint64_t seed = 0;
  // MG-MAPF: no agent has a destination; instead each agent gets a task on its drawn destination,
  // which it shares if that place already has a task.
  bool mg = false;
  // Drawn independently, so that the other parts of the instance do not depend on them. Turning is
  // possible only on grids.
  Extras extras = {};
  // Drawn independently, too. With `mg`, agents have no choice of destinations, and each agent must
  // visit the task on its drawn destination.
  Choices choices = {};
};

// Returns the first row (counted from 0) whose start can become a task: max(20, agents).
int first_task_row(int agents);
// Returns the number of scenario rows that an instance needs if each start from first_task_row() on
// can become a task.
int rows_needed(const InstanceRequest& request);

// Generates an instance. The first `agents` rows define the agents a0, a1, .... The starts of the
// rows from first_task_row() on become the tasks t0, t1, ..., except for rows whose start already
// has a task or cannot be reached by any agent. Each task without a need (Choices::need) is assigned
// to 1, 2 or 3 distinct agents, drawn from the agents that can reach it. Throws InputError, which names the scenario, if the
// scenario has too few rows, if the row of an agent does not fit `grid` or the other agents, if
// too few agents can reach a task with a need, or if an agent would have to visit more than
// kMaxTasksPerAgent tasks.
Instance generate_instance(const Grid& grid, const Scenario& scenario,
                           const InstanceRequest& request);

}  // namespace grove::detail
