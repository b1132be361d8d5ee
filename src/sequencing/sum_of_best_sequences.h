// SPDX-License-Identifier: MIT
// What the agents' best orders of visits cost together when nobody is in anybody's way.
#pragma once

#include <optional>

#include "model/distance_field.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"
#include "sequencing/rtsp.h"

namespace grove::detail {

// The optimum of one agent's sequencing problem, as RtspSolver::best of all sequences.
RtspAnswer best_sequence_cost(const Instance& instance, AgentIndex agent,
                              const DistanceFields& distances, const Limits& limits);

// The sum over the agents of the optimum of their sequencing problem (with or without destination,
// as the instance has it): the cost of the first root of CTS-CBS, and a lower bound on every plan.
// kInfiniteCost when some agent has no way; none when `limits` strike first.
std::optional<Cost> sum_of_best_sequences(const Instance& instance, const Limits& limits);

}  // namespace grove::detail
