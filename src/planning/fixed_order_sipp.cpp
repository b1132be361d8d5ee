// SPDX-License-Identifier: MIT
#include "planning/fixed_order_sipp.h"

#include <stdexcept>

#include "model/assert.h"
#include "planning/fixed_order_goals.h"
#include "planning/safe_interval_search.h"

namespace grove::detail {

class FixedOrderSipp::Workspace : public SafeIntervalSearch<FixedOrderGoals> {
  using SafeIntervalSearch::SafeIntervalSearch;
};

FixedOrderSipp::FixedOrderSipp(const World& world)
    : workspace_(std::make_unique<Workspace>(world)) {}
FixedOrderSipp::~FixedOrderSipp() = default;

PathOutcome FixedOrderSipp::find(const GoalSequence& goals, const PathQuery& query,
                                 const Limits& limits, Path& path) {
  if (goals.size() > FixedOrderGoals::kMaxGoals)
    throw std::invalid_argument("an agent can have at most 255 goals");
  if (limits.stop_requested()) return PathOutcome::kStopped;
  Workspace& search = *workspace_;
  if (query.reservations)
    search.intervals().assign(*query.reservations);
  else
    search.intervals().assign(query.constraints);
  // With constraints, the search ignores the cutoff, so it can prove that there is no path.
  const Time cap = query.reservations ? query.cutoff : kNever;
  if (!search.goals().assign(search.world(), goals, search.intervals(), cap))
    return PathOutcome::kInfeasible;
  search.begin(goals.start(), 0, goals.distance(goals.start(), 0), query.others, limits);
  switch (search.run(search.expanded_after(query.label_limit))) {
    case Workspace::End::kFound:
      GROVE_ASSERT(search.cost() >= goals.distance(goals.start(), 0) &&
                       search.cost() >= search.goals().first_rest(),
                   "no path costs less than its distance or ends before the agent may rest");
      if (search.cost() > query.cutoff) return PathOutcome::kAboveCutoff;
      search.write_path(path);
      return PathOutcome::kFound;
    case Workspace::End::kExhausted:
      return cap < kNever ? PathOutcome::kAboveCutoff : PathOutcome::kInfeasible;
    case Workspace::End::kPaused:
    case Workspace::End::kStopped:
      break;
  }
  return PathOutcome::kStopped;
}

std::int64_t FixedOrderSipp::expanded() const {
  return workspace_->expanded();
}

}  // namespace grove::detail
