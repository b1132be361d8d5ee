// SPDX-License-Identifier: MIT
// Tasks in formats that list the cells to visit for each agent.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "model/instance.h"

namespace grove::detail {

// Collects cells and creates one task per cell, for all agents that list it, with the default ids.
// The agents must be in the builder before add_to().
class Waypoints {
 public:
  explicit Waypoints(std::string file) : file_(std::move(file)) {}

  // `place`: the position in the file. Throws InputError if the agent has already listed the cell.
  void add(const std::string& agent_id, Position cell, std::string place);

  // Throws InputError at the position of an entry that violates a rule of
  // InstanceBuilder::add_task.
  void add_to(InstanceBuilder& builder) const;

 private:
  struct Stop {
    Position cell;
    std::vector<std::string> agents;
    std::vector<std::string> places;  // by agent
  };

  std::string file_;
  std::vector<Stop> stops_;
  std::unordered_map<std::uint64_t, std::size_t> stop_by_cell_;
};

}  // namespace grove::detail
