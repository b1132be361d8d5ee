// SPDX-License-Identifier: MIT
// Which robot does what.
#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "examples/lifelong/errands.h"
#include "grove/detail/model/distance_field.h"
#include "grove/detail/model/instance.h"

namespace grove::detail::lifelong {

// Greedily: the oldest errand first, each to the nearest robot that has none. An errand on a cell
// that another robot is on its way to waits: a robot rests on its last errand, as far as its plan
// knows.
class Assignment {
 public:
  explicit Assignment(const Grid& grid) : grid_(grid) {}

  void add(const Errand& errand) { open_.push_back(errand); }
  std::size_t open() const { return open_.size(); }

  // For the robots as they are now, who have a task or none. Those that are given away are open no
  // longer.
  std::vector<std::pair<AgentIndex, Errand>> give(const Instance& now);

 private:
  const Grid& grid_;
  std::deque<Errand> open_;
};

}  // namespace grove::detail::lifelong
