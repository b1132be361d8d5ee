// SPDX-License-Identifier: MIT
// The independent checker: is a plan what it claims to be? It shares the model's types with the
// search and none of its text, and it believes nothing: every cost, visit and collision is worked
// out again from the instance and the paths (docs/design.md, section 1). What it cannot check is
// the proof behind the lower bound; it checks only that bound, cost and status agree.
#pragma once

#include <string>
#include <vector>

#include "grove/detail/model/plan.h"

namespace grove::detail {

// One thing that is wrong. `place` is a JSON path of the plan file ("/agents/2/path/17").
struct Violation {
  std::string place;
  std::string message;
};

// Everything wrong with `solution` as a plan for `instance`, at most `limit` entries; empty: valid.
// A solution without a plan, or with fewer agents than the instance, is wrong: it proves nothing.
std::vector<Violation> check(const Instance& instance, const Solution& solution,
                             std::size_t limit = 20);

}  // namespace grove::detail
