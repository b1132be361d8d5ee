// SPDX-License-Identifier: MIT
// The plan checker: verifies that a plan is valid and that its claims are consistent. It recomputes
// every visit, cost and conflict from the instance and the paths (docs/design.md, section 1). It
// calls no function of the search and shares with it only the data types of `model`: World,
// Instance and Plan. It does not verify the lower bound. It checks only that bound, cost and status
// are consistent.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// An error in a plan. `json_pointer` is its position, as a JSON Pointer (RFC 6901) such as
// "/agents/2/path/17", in a plan file that lists the agents in the order of the instance.
struct Violation {
  std::string json_pointer;
  std::string message;
};

// Returns the errors of `solution` as a plan of `instance`, at most max(limit, 1) of them. An empty
// result means that the plan is valid and the claims are consistent. A missing plan is an error,
// and so is a number of agents that differs from that of the instance.
std::vector<Violation> check(const Instance& instance, const Solution& solution,
                             std::size_t limit = 20);

// Thrown when check() rejects a plan that Grove was about to return or write.
class InvalidPlan : public std::logic_error {
 public:
  explicit InvalidPlan(Violation violation)
      : std::logic_error("the plan is not valid: " + violation.json_pointer + ": " +
                         violation.message),
        violation_(std::move(violation)) {}
  const Violation& violation() const { return violation_; }

 private:
  Violation violation_;
};

// Throws InvalidPlan with the first violation that check() finds. Accepts every solution without a
// plan.
void require_valid_plan(const Instance& instance, const Solution& solution);
// The same for a plan without a lower bound.
void require_valid_plan(const Instance& instance, const Plan& plan);

// Returns `plan`, which a search has found. Throws std::logic_error if the checker refuses it,
// because then the search has a bug.
Plan checked_plan(const Instance& instance, Plan plan);

}  // namespace grove::detail
