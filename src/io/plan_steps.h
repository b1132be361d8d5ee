// SPDX-License-Identifier: MIT
// Times in a plan at which agents come to rest and visit tasks, for files in other formats.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// The path without the waits at its end. It is empty only if `path` is empty.
inline std::span<const Cell> until_rest(const Path& path) {
  std::size_t size = path.size();
  while (size > 1 && path[size - 2] == path[size - 1]) --size;
  return {path.data(), size};
}

// The earliest time from which no agent moves or turns. (A task execution after an agent's last
// move does not count.)
inline Time makespan(const Plan& plan) {
  std::size_t last = 0;
  for (const AgentPlan& agent : plan.agents) last = std::max(last, until_rest(agent.path).size());
  return last == 0 ? 0 : static_cast<Time>(last - 1);
}

// By position in the agent's sequence: the time at which the agent visits the task or completes its
// execution, if it visits its tasks in the order of the sequence, each as early as possible.
// Precondition: the plan is valid.
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
