// SPDX-License-Identifier: MIT
// Creates tasks from file formats that list, for each agent, the cells to visit.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "model/instance.h"

namespace grove::detail {

// Collects cells, and creates one task per distinct cell, with a default id, for all agents that
// list the cell. The agents must be in the builder before add_to().
class Waypoints {
 public:
  explicit Waypoints(std::string file) : file_(std::move(file)) {}

  // Adds a cell that the agent lists at position `place` of the file. Call it agent by agent.
  // Throws InputError if the agent has already listed the cell.
  void add(const std::string& agent_id, Position cell, std::string place);

  // Adds the tasks to `builder`. If InstanceBuilder::add_task() rejects a task, throws InputError
  // at the position of the entry that caused it.
  void add_to(InstanceBuilder& builder) const;

 private:
  struct Stop {
    Position cell;
    std::vector<std::string> agents;
    std::vector<std::string> places;  // by position in `agents`: position in the file
  };

  std::string file_;
  std::vector<Stop> stops_;
  std::unordered_map<std::uint64_t, std::size_t> stop_by_cell_;
};

}  // namespace grove::detail
