// SPDX-License-Identifier: MIT
// The checker: is a plan what it claims to be? It recomputes every visit, cost and conflict from
// the instance and the paths (docs/design.md, section 1), with code of its own. It shares the types
// of `model` with the search: World (states, moves, places), Instance and Plan. It does not verify
// the lower bound; it checks only that bound, cost and status agree.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "model/plan.h"

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

// A plan that Grove was about to return or write and that check() refuses.
class InvalidPlan : public std::logic_error {
 public:
  explicit InvalidPlan(Violation violation)
      : std::logic_error("the plan is not valid: " + violation.place + ": " + violation.message),
        violation_(std::move(violation)) {}
  const Violation& violation() const { return violation_; }

 private:
  Violation violation_;
};

// Throws InvalidPlan with the first violation of check(), under the rules of the instance and of
// the solution. A solution without a plan passes: it says so itself.
void require_valid_plan(const Instance& instance, const Solution& solution);

}  // namespace grove::detail
