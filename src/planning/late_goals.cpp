// SPDX-License-Identifier: MIT
#include "late_goals.h"

#include <algorithm>
#include <utility>

#include "late_costs.h"

namespace grove::detail {
namespace {

// At most what any sequence of the class costs, by the completions.
Time least_cost(FreeGoals& goals) {
  const Time beyond = goals.completions().beyond();
  const FreeGoals::StageId stage = goals.first_stage();
  if (stage == FreeGoals::kOutside) return beyond;
  return std::min(beyond, goals.distance(stage, goals.stops().start()));
}

}  // namespace

FreeGoals* LateGoals::over(FreeGoals& plain, const Limits& limits) {
  const Time plain_cost = least_cost(plain);
  auto matrix = late_cost_matrix(world_, intervals_, plain.stops(), plain_cost);
  if (!matrix) return nullptr;
  goals_.reset();
  if (!completions_ || completions_->matrix().cost != matrix->cost)
    completions_.emplace(std::move(*matrix));  // else those of a call before serve on
  goals_.emplace(plain.stops(), plain.sequence_class(), *completions_);
  while (completions_->beyond() <= plain_cost && least_cost(*goals_) >= completions_->beyond())
    if (!completions_->widen(completions_->beyond(), limits)) break;
  return least_cost(*goals_) > plain_cost ? &*goals_ : nullptr;
}

}  // namespace grove::detail
