// SPDX-License-Identifier: MIT
// Proofs that no plan exists, for instances in which agents choose tasks and goals.
#pragma once

#include <optional>
#include <string>

#include "model/distance_field.h"
#include "model/instance.h"

namespace grove::detail {

// True if there are paths from the agent's start to the task and, if the agent has a destination,
// from the task to one of its destinations. `distances` must be complete.
bool can_visit(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
               TaskIndex task);

// Returns the reason why no plan exists, as a sentence that names the agents and the obstacle, if
// too few agents can visit a task, or if agents have, or can reach, fewer goals than they are (Hall
// 1935). Returns nullopt if neither is the case. `distances` must be complete.
std::optional<std::string> infeasible_choices(const Instance& instance,
                                              const DistanceFields& distances);

}  // namespace grove::detail
