// SPDX-License-Identifier: MIT
// One agent on a small map, made for the tests of the planning layer.
#pragma once

#include <optional>
#include <vector>

#include "planning/goal_sequence.h"
#include "tests/support/instances.h"

namespace grove::detail::testing {

// One agent with a start, tasks in the order to visit, and perhaps a destination.
struct SingleAgent {
  SingleAgent(const Grid& grid, Cell start, const std::vector<Cell>& tasks,
              std::optional<Cell> destination);

  Instance instance;
  DistanceFields distances;
  GoalSequence goals;
};

}  // namespace grove::detail::testing
