// SPDX-License-Identifier: MIT
// What rows say that cannot be, held against each other.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "batch/row.h"

namespace grove::detail::batch {

struct FalseClaim {
  std::string method;
  std::string instance;
  std::string what;  // "claims a cost of 60, but its own paths cost 64"

  friend bool operator==(const FalseClaim&, const FalseClaim&) = default;
};

// Of rows of one instance, whatever their methods and seeds: a claimed cost below that of the plan
// shown with it, or, where none is, below a bound that Grove has proven; a lower bound, claimed or
// Grove's own, above the cost of a plan that was re-checked; a plan where Grove has proven that
// there is none, or the other way round. In the order of the rows.
std::vector<FalseClaim> false_claims(std::span<const Row> rows);

}  // namespace grove::detail::batch
