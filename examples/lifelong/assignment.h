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

// Pairs of a robot's id and its errand.
using Given = std::vector<std::pair<std::string, Errand>>;

// Greedy assignment: the oldest errand first, each to the nearest robot without a task. An errand
// on a cell that is another robot's current task waits, because a robot rests at its last task
// until it gets a new one.
class Assignment {
 public:
  explicit Assignment(grove::World world) : world_(std::move(world)) {}

  void add(const Errand& errand) { open_.push_back(errand); }

  // Assigns errands to the idle robots of `now`. Each robot of `now` has at most one task. Assigned
  // errands are removed from the open ones.
  Given give(const grove::Instance& now);

 private:
  grove::World world_;
  std::deque<Errand> open_;
};

}  // namespace lifelong
