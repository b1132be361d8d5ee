// SPDX-License-Identifier: MIT
// Small instances with choices, which parts of Grove must refuse or support.
#pragma once

#include <string>
#include <vector>

#include "model/plan.h"
#include "tests/support/instances.h"

namespace grove::detail::testing {

// "....." and a choice of goals for the first of two agents.
inline Instance instance_with_goals() {
  InstanceBuilder builder(grid_of({"....."}));
  builder.add_agent(
      {.id = "a0", .start = {.place = 1}, .goal = {}, .goals = std::vector<Place>{0, 2}});
  builder.add_agent("a1", Place{3}, Place{4});
  return std::move(builder).build();
}

// "....." and a task in the middle that one of two agents must visit.
inline Instance instance_with_need() {
  InstanceBuilder builder(grid_of({"....."}));
  builder.add_agent("a0", Place{1}, Place{0});
  builder.add_agent("a1", Place{3}, Place{4});
  builder.add_task("t0", Place{2}, std::vector<std::string>{"a0", "a1"}, 0, 1);
  return std::move(builder).build();
}

// Valid plans of these instances: a0 goes to 0; a1 goes to 4, in the second plan by way of the
// task.
inline Solution solution_with_goals() {
  Solution solution;
  solution.plan = Plan{2, {{1, {}, {1, 0}}, {1, {}, {3, 4}}}};
  solution.status = Status::kOptimal;
  solution.lower_bound = 2;
  return solution;
}
inline Solution solution_with_need() {
  Solution solution;
  solution.plan = Plan{4, {{1, {}, {1, 0}}, {3, {0}, {3, 2, 3, 4}, {{0, 1, 1}}}}};
  solution.status = Status::kOptimal;
  solution.lower_bound = 4;
  return solution;
}

}  // namespace grove::detail::testing
