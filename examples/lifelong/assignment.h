// SPDX-License-Identifier: MIT
// Which robot does what.
#pragma once

#include <cstddef>
#include <deque>
#include <grove/grove.hpp>
#include <string>
#include <utility>
#include <vector>

#include "errands.h"

namespace lifelong {

// The id of a robot, and what it is to do.
using Given = std::vector<std::pair<std::string, Errand>>;

// Greedily: the oldest errand first, each to the nearest robot that has none. An errand on a cell
// that another robot is on its way to waits: a robot rests on its last errand, as far as its plan
// knows.
class Assignment {
 public:
  explicit Assignment(grove::World world) : world_(std::move(world)) {}

  void add(const Errand& errand) { open_.push_back(errand); }

  // For the robots of `now`, of which each has one task or none. What is given is not open any
  // more.
  Given give(const grove::Instance& now);

 private:
  grove::World world_;
  std::deque<Errand> open_;
};

}  // namespace lifelong
