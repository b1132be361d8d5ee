// SPDX-License-Identifier: MIT
// Assigns errands to robots.
#pragma once

#include <cstddef>
#include <deque>
#include <grove/grove.hpp>
#include <string>
#include <utility>
#include <vector>

#include "errands.h"

namespace lifelong {

// Pairs of a robot's id and the errand that is assigned to it.
using Given = std::vector<std::pair<std::string, Errand>>;

// Greedy assignment in order of arrival at add(): each open errand goes to the nearest robot
// without a task. An errand on the cell of a current task stays open, because the robot with that
// task rests there until it gets a new task.
class Assignment {
 public:
  explicit Assignment(grove::World world) : world_(std::move(world)) {}

  void add(const Errand& errand) { open_.push_back(errand); }

  // Assigns open errands to the robots in `now` that have no task, and removes them from the open
  // errands. Each robot in `now` must have at most one task.
  Given give(const grove::Instance& now);

 private:
  grove::World world_;
  std::deque<Errand> open_;
};

}  // namespace lifelong
