// SPDX-License-Identifier: MIT
// First violation that the checker finds in a plan.
#pragma once

#include <string>

#include "model/check.h"

namespace grove::detail::testing {

// Both functions return the first violation, or "" if there is none. The first one checks the
// claims of the solution as well; the second one only the plan.
inline std::string first_violation(const Instance& instance, const Solution& solution) {
  const auto violations = check(instance, solution, 1);
  return violations.empty() ? "" : violations[0].json_pointer + ": " + violations[0].message;
}
inline std::string first_violation(const Instance& instance, const Plan& plan) {
  Solution claim;
  claim.status = status_of(plan.cost, 0, claim.omega);
  claim.plan = plan;
  return first_violation(instance, claim);
}

}  // namespace grove::detail::testing
