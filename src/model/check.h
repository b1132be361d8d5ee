// SPDX-License-Identifier: MIT
// The checker: verifies that a plan is valid and that its claims agree. It recomputes every visit,
// cost and conflict from the instance and the paths (docs/design.md, section 1), with code of its
// own. It shares the types of `model` with the search: World (states, moves, places), Instance and
// Plan. It does not verify the lower bound. It checks only that bound, cost and status agree.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// One error. `json_pointer` is a JSON Pointer (RFC 6901) into the plan file, such as
// "/agents/2/path/17".
struct Violation {
  std::string json_pointer;
  std::string message;
};

// Returns all errors of `solution` as a plan for `instance`, at most `limit` of them; empty: valid.
// A solution without a plan, or with fewer agents than the instance, is an error, because it proves
// nothing.
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

// Throws InvalidPlan with the first violation of check(), under the rules of the instance and of
// the solution. A solution without a plan passes, because its status already says so.
void require_valid_plan(const Instance& instance, const Solution& solution);

}  // namespace grove::detail
