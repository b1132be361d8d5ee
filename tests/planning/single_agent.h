// SPDX-License-Identifier: MIT
// Fixture of the planning tests: an agent on a small map.
#pragma once

#include <optional>
#include <vector>

#include "planning/goal_sequence.h"
#include "tests/support/instances.h"

namespace grove::detail::testing {

// An agent with a start, tasks in the order of visits, and an optional destination.
struct SingleAgent {
  SingleAgent(const Grid& grid, Cell start, const std::vector<Cell>& tasks,
              std::optional<Cell> destination);

  Instance instance;
  DistanceFields distances;
  GoalSequence goals;
};

}  // namespace grove::detail::testing
