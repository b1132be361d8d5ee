// SPDX-License-Identifier: MIT
// Heuristic search for assignments of low cost, without a bound.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "assignment/assignment.h"
#include "assignment/routes.h"
#include "model/distance_field.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"
#include "model/plan.h"

namespace grove::detail {

// Finds complete assignments: first one by regret insertion (Potvin and Rousseau 1993) into the
// agents' routes, without conflicts between agents, followed by large neighbourhood search
// (assignment_lns.h) and another choice of goals; then variants of it. Repeatable. One thread at a
// time.
class AssignmentSearch {
 public:
  // Both must outlive this object. `distances` must be complete.
  // `visit_weight`: the search minimises the cost of the routes plus this weight times the sum of
  // the times of all visits (Routes).
  AssignmentSearch(const Instance& instance, const DistanceFields& distances, std::uint64_t seed,
                   Cost visit_weight = 0);
  ~AssignmentSearch();

  // Returns the first assignment, or nullopt if it finds none, which proves nothing, or if a limit
  // was reached.
  std::optional<Assignment> first(const Limits& limits);
  // Returns a further assignment whose routes cost less than `cost_limit`, and which was not
  // returned before. Returns nullopt if it finds none. Call first() before.
  std::optional<Assignment> next(Cost cost_limit, const Limits& limits);
  // In place of first(): returns the assignment of `plan`, a plan in which agents may omit tasks
  // and end anywhere. Leaves out surplus visits, and inserts missing ones without moving others.
  // Goals are those of the plan if each agent with a choice ends on one of its own.
  std::optional<Assignment> first_from(const Plan& plan, const Limits& limits);
  // Improves the routes by large neighbourhood search with `insertions` (assignment_lns.h), and
  // changes goals if this lowers the cost. Returns the assignment of the routes, which never cost
  // more than before. Call first() or first_from() before.
  Assignment improved(std::int64_t insertions, const Limits& limits);
  // The best routes so far; without stops before first() has returned.
  const Routes& routes() const;

 private:
  class Builder;
  std::unique_ptr<Builder> builder_;
};

}  // namespace grove::detail
