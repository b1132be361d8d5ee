// SPDX-License-Identifier: MIT
// The paper's data sets (section V): agents and tasks from the rows of a scenario.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/scenario_file.h"
#include "model/instance.h"

namespace grove::detail {

struct Scenario {
  std::string name;  // the file it came from, for messages
  std::vector<ScenarioRow> rows;
};

// What the paper's instances do not have.
struct Extras {
  struct Range {
    Time least = 0;
    Time most = 0;
  };
  Time turn_steps = 0;         // of a quarter turn; 0: agents turn freely
  bool goal_headings = false;  // of agents that need time to turn, in which they must rest
  Range durations = {};        // of tasks, drawn uniformly

  // "_turning2_d0-10", for names of files; empty without any.
  std::string suffix() const;
};

struct InstanceRequest {
  int agents = 1;
  int tasks = 0;
  std::uint64_t seed = 0;
  // MG-MAPF: no agent has a destination; what it was becomes an ordinary task of that agent.
  bool mg = false;
  // Drawn apart, so all else is the same whatever they are. On grids only: turns.
  Extras extras = {};
};

// The first row (from 0) whose start may become a task. 20 rows are reserved for agents, or more if
// there are more.
int first_task_row(int agents);
// The rows that a request uses when no start repeats.
int rows_needed(const InstanceRequest& request);

// The first `agents` rows are the agents a0, a1, ...; the starts of the rows from first_task_row
// on are the tasks t0, t1, ..., each given to 1, 2 or 3 distinct agents drawn from all those that
// can reach it. Rows whose start is a task already, or that no agent can reach, are passed over.
// Throws InputError, naming the scenario, when it has too few rows, rows that do not fit `grid`, or
// an agent would get more than kMaxTasksPerAgent tasks.
Instance generate_instance(const Grid& grid, const Scenario& scenario,
                           const InstanceRequest& request);

}  // namespace grove::detail
