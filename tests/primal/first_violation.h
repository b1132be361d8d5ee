// SPDX-License-Identifier: MIT
// First violation that the checker finds in a plan.
#pragma once

#include <string>

#include "model/check.h"

namespace grove::detail::testing {

// Returns the first violation, or "" if the plan is valid.
inline std::string first_violation(const Instance& instance, const Plan& plan) {
  Solution claim;
  claim.status = status_of(plan.cost, 0, claim.omega);
  claim.plan = plan;
  const auto violations = check(instance, claim, 1);
  return violations.empty() ? "" : violations[0].json_pointer + ": " + violations[0].message;
}

}  // namespace grove::detail::testing
