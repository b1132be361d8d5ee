// SPDX-License-Identifier: MIT
// The paper's data sets (section V): agents and tasks from the rows of a scenario.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "grove/io/scenario_file.h"
#include "grove/model/instance.h"

namespace grove {

struct Scenario {
  std::string name;  // the file it came from, for messages
  std::vector<ScenarioRow> rows;
};

struct InstanceRequest {
  int agents = 1;
  int tasks = 0;
  std::uint64_t seed = 0;
  // MG-MAPF: no agent has a destination; what it was becomes an ordinary task of that agent.
  bool mg = false;
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

}  // namespace grove
