// SPDX-License-Identifier: MIT
#include "planning/fixed_order_goals.h"

#include <algorithm>
#include <limits>

namespace grove::detail {

bool FixedOrderGoals::assign(const World& world, const GoalSequence& goals,
                             SafeIntervals& intervals, Time cutoff) {
  world_ = &world;
  intervals.ensure_intervals(world.place(goals.start()));
  for (int k = 0; k < goals.size(); ++k)
    if (goals.goal(k) != kNoPlace) intervals.ensure_intervals(goals.goal(k));
  max_turn_time_ = goals.max_turn_time();
  last_progress_ = goals.size() - 1;
  first_rest_ = goals.last() == kNoPlace ? 0 : intervals.rest_begin(goals.last());
  if (first_rest_ >= kNever || goals.distance(goals.start(), 0) >= kNever) return false;
  const int kind = world.kind(world.base(goals.start()));
  stages_.resize(static_cast<std::size_t>(goals.size()));
  Time latest = cutoff < kNever ? cutoff : std::numeric_limits<Time>::max();
  if (intervals.latest_rest() < kNever)
    latest =
        std::min(latest, intervals.latest_rest() + goals.longest_finish(intervals.only_rest()));
  for (int k = last_progress_; k >= 0; --k) {
    const Place goal = goals.goal(k);
    const Time deadline = goal == kNoPlace ? kNever : intervals.last_time(goal);
    if (deadline < kNever) latest = std::min(latest, deadline + goals.after_goal(k));
    const StateRange bases =
        goal == kNoPlace ? StateRange{0, world.state_count()} : world.bases(goal, kind);
    stages_[k] = {.to_goal = goals.to_goal(k),
                  .first = bases.first,
                  .states = static_cast<std::uint32_t>(bases.end - bases.first),
                  .after_goal = goals.after_goal(k),
                  .work = goals.work(k),
                  .latest = latest,
                  .gate_from = kNever,
                  .gate_until = 0};
  }
  return true;
}

// Stores one gate per progress: the one that postpones labels to the latest layer.
void FixedOrderGoals::add_gate(State, Progress, Progress progress, Time time, Time until) {
  const Time after_goal = stages_[progress - 1].after_goal;
  const Time from = time + max_turn_time_ + after_goal;
  if (until != kNever) until += after_goal;
  for (int p = 0; p < progress; ++p) {
    Stage& stage = stages_[p];
    if (until < stage.gate_until || (until == stage.gate_until && from >= stage.gate_from))
      continue;
    stage.gate_from = from;
    stage.gate_until = until;
  }
}

}  // namespace grove::detail
