// SPDX-License-Identifier: MIT
// The times at which a plan visits its tasks.
#pragma once

#include <algorithm>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// The times at which the agent visits, or completes, each task of its sequence, in that order, each
// as early as possible. Precondition: the plan is valid.
inline std::vector<Time> visit_times(const Instance& instance, const AgentPlan& plan) {
  std::vector<Time> times;
  Time time = 0;
  for (const TaskIndex task : plan.sequence) {
    const auto work = std::ranges::find(plan.work, task, &WorkTime::task);
    if (work != plan.work.end()) {
      time = std::max(time, work->end);
    } else {
      const Time end = static_cast<Time>(plan.path.size()) - 1;
      while (time < end && place_at(instance.world(), plan.path, time) != instance.task(task).cell)
        ++time;
    }
    times.push_back(time);
  }
  return times;
}

}  // namespace grove::detail
