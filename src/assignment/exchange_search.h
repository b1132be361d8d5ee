// SPDX-License-Identifier: MIT
// Large neighbourhood search over plans that exchanges tasks and goals between agents.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "assignment/assignment_search.h"
#include "assignment/routes.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/plan.h"

namespace grove::detail {

// Improves a plan of an instance with choices. An iteration changes the routes of a few agents and
// plans these agents again around all others. Heuristic: it proves nothing. Repeatable, unless a
// limit is reached. One thread at a time.
class ExchangeSearch {
 public:
  // All must outlive this object. `distances` must be complete. `routes`: any routes of the
  // instance, of which only the costs are used.
  ExchangeSearch(const Instance& instance, const DistanceFields& distances, const Routes& routes,
                 std::uint64_t seed);
  ~ExchangeSearch();

  // Sets the current plan, a valid plan of the instance.
  void start_from(const Plan& plan);
  // Improves the current plan, until it costs less than `cost`, or about `max_effort` units of
  // effort (model/effort.h) are spent, or a limit is reached. Returns the plan if it costs less.
  // The next call continues from the current plan. Call start_from() before.
  std::optional<Plan> improve(Cost cost, std::int64_t max_effort, const Limits& limits);

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace grove::detail
