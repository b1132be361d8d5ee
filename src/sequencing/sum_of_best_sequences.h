// SPDX-License-Identifier: MIT
// Sum of the costs of the agents' best sequences, without conflicts between agents.
#pragma once

#include <optional>

#include "model/distance_field.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"
#include "sequencing/rtsp.h"

namespace grove::detail {

// Returns the optimum of one agent's sequencing problem over cost_matrix(), in the form of
// RtspSolver::best() for the class of all sequences.
RtspAnswer best_sequence_cost(const Instance& instance, AgentIndex agent,
                              const DistanceFields& distances, const Limits& limits);

// Returns the sum of best_sequence_cost() over the agents (with or without destination, as in the
// instance). This is the cost of the first root of CTS-CBS, and a lower bound on every plan.
// Returns kInfiniteCost if some agent has no path. Returns nullopt if, before that is known, a
// limit was reached or the problem of an agent was too large for the back end.
std::optional<Cost> sum_of_best_sequences(const Instance& instance, const Limits& limits);

}  // namespace grove::detail
