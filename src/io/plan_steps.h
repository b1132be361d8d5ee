// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

#include "model/plan.h"

namespace grove::detail {

// The path until the agent rests: without the waits at its end. Empty only if the path is.
inline std::span<const Cell> until_rest(const Path& path) {
  std::size_t size = path.size();
  while (size > 1 && path[size - 2] == path[size - 1]) --size;
  return {path.data(), size};
}

// The time at which the last agent comes to rest.
inline Time makespan(const Plan& plan) {
  std::size_t last = 0;
  for (const AgentPlan& agent : plan.agents) last = std::max(last, until_rest(agent.path).size());
  return last == 0 ? 0 : static_cast<Time>(last - 1);
}

}  // namespace grove::detail
