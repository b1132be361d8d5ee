// SPDX-License-Identifier: MIT
#include "sequencing/sum_of_best_sequences.h"

#include "sequencing/cost_matrix.h"

namespace grove::detail {

RtspAnswer best_sequence_cost(const Instance& instance, AgentIndex agent,
                              const DistanceFields& distances, const Limits& limits) {
  const CostMatrix matrix = cost_matrix(instance, agent, distances);
  return make_rtsp_solver(RtspBackend::kAuto, matrix, limits)->best({}, kNever);
}

std::optional<Cost> sum_of_best_sequences(const Instance& instance, const Limits& limits) {
  const DistanceFields distances(instance, limits);
  if (!distances.complete()) return std::nullopt;
  Cost sum = 0;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    if (limits.stop_requested()) return std::nullopt;
    const RtspAnswer answer = best_sequence_cost(instance, i, distances, limits);
    if (answer.kind == RtspAnswer::Kind::kStopped) return std::nullopt;
    if (answer.kind != RtspAnswer::Kind::kExact || answer.cost >= kNever) return kInfiniteCost;
    sum += answer.cost;
  }
  return sum;
}

}  // namespace grove::detail
