// SPDX-License-Identifier: MIT
// Finds claims in the rows of a result table that contradict other rows.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "batch/row.h"

namespace grove::detail::batch {

struct FalseClaim {
  std::string method;
  std::string instance;
  std::string what;  // for example "claims a cost of 60, but its own paths cost 64"

  friend bool operator==(const FalseClaim&, const FalseClaim&) = default;
};

// Compares the rows of each instance, whatever their methods and seeds, and returns, in the order
// of the rows, each
// - claimed cost below the cost of the plan in the same row or, without a plan, below a lower bound
//   that Grove has proven;
// - lower bound, claimed by another solver or proven by Grove, above the cost of a plan that was
//   re-checked;
// - claimed plan for an instance that Grove has proven infeasible, or infeasibility of an instance
//   that has a plan.
std::vector<FalseClaim> false_claims(std::span<const Row> rows);

}  // namespace grove::detail::batch
