// SPDX-License-Identifier: MIT
// Tasks of formats that list, agent by agent, the cells to visit.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "model/instance.h"

namespace grove::detail {

// Collects cells; then makes tasks of them, one per cell, for all agents that list it, with the
// default ids. The agents must be in the builder by then.
class Waypoints {
 public:
  explicit Waypoints(std::string file) : file_(std::move(file)) {}

  // `place` is where it stands in the file. Throws InputError when the agent has listed the cell.
  void add(const std::string& agent_id, Position cell, std::string place);

  // Throws InputError at the place that breaks a rule of InstanceBuilder::add_task.
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
