// SPDX-License-Identifier: MIT
// The open errands, and which robots they are for.
#pragma once

#include <cstddef>
#include <deque>
#include <grove/grove.hpp>
#include <string>
#include <utility>
#include <vector>

#include "errands.h"

namespace lifelong {

// Pairs of the id of a robot, or "" for any robot, and an errand for it.
using Given = std::vector<std::pair<std::string, Errand>>;

// The open errands, in order of arrival at add().
class Assignment {
 public:
  explicit Assignment(grove::World world) : world_(std::move(world)) {}

  void add(const Errand& errand) { open_.push_back(errand); }

  // Both functions return errands and remove them from the open errands.
  //
  // Returns the oldest errands, for any robot, as long as there are at most `max_tasks` tasks
  // together with those in `now`.
  Given give_to_any(const grove::Instance& now, std::size_t max_tasks);
  // Greedy assignment: each errand is for the nearest of the robots in `now` that have no task. An
  // errand on the cell of a current task stays open, because the robot with that task rests there
  // until it gets a new task. Each robot in `now` must have at most one task.
  Given give_to_nearest(const grove::Instance& now);

 private:
  grove::World world_;
  std::deque<Errand> open_;
};

}  // namespace lifelong
