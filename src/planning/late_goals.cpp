// SPDX-License-Identifier: MIT
#include "planning/late_goals.h"

#include <algorithm>
#include <utility>

#include "planning/late_costs.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/direct_legs.h"

namespace grove::detail {
namespace {

// Lower bound on the cost of every sequence of the class, by the costs to go.
Time least_cost(SequenceStages& goals) {
  const Time beyond = goals.cost_to_go().beyond();
  const SequenceStages::StageId stage = goals.first_stage();
  if (stage == SequenceStages::kOutside) return beyond;
  return std::min(beyond, goals.distance(stage, goals.stops().start()));
}

// A direct leg costs at least as much as the late leg by any path. The last leg is that of the
// plain matrix, because the late one begins when all others are done (sequence_dag.cpp, Pairs).
CostToGo late_completions(const AgentStops& stops, CostMatrix late) {
  const auto make_direct = [&instance = stops.instance(), agent = stops.agent(), late,
                            plain = stops.cost_to_go().matrix()] {
    CostMatrix direct = direct_legs(instance, agent, late);
    const int end = direct.cost.size() - 1;
    for (int from = 0; from <= end; ++from) direct.cost(from, end) = plain.cost(from, end);
    return direct;
  };
  return CostToGo(std::move(late), {}, make_direct);
}

}  // namespace

SequenceStages* LateGoals::over(SequenceStages& plain, const Limits& limits) {
  const Time plain_cost = least_cost(plain);
  auto matrix = late_cost_matrix(world_, intervals_, plain.stops(), plain_cost);
  if (!matrix) return nullptr;
  goals_.reset();
  const bool known = completions_ && agent_ == plain.stops().agent() &&
                     class_ == plain.sequence_class() &&
                     completions_->matrix().cost == matrix->cost;
  if (!known) {  // otherwise reuses the costs to go of an earlier call
    agent_ = plain.stops().agent();
    class_ = plain.sequence_class();
    completions_ = late_completions(plain.stops(), std::move(*matrix));
    if (auto of_class = completions_->of_class(class_)) completions_ = std::move(of_class);
  }
  completions_->reset();
  goals_.emplace(plain.stops(), plain.sequence_class(), *completions_);
  while (completions_->beyond() <= plain_cost && least_cost(*goals_) >= completions_->beyond())
    if (!completions_->widen(completions_->beyond(), limits)) break;
  return least_cost(*goals_) > plain_cost ? &*goals_ : nullptr;
}

}  // namespace grove::detail
