// SPDX-License-Identifier: MIT
#include "grove/detail/search/path_sets.h"

#include <utility>

namespace grove::detail {
namespace {

constexpr std::size_t kMostNodesKept = 4'000'000;
constexpr std::size_t kBytesPerNode = 24;  // about
constexpr std::size_t kBytesPerSet = 176;

}  // namespace

PathSets::Set PathSets::find(Situations::Id id) const {
  return parts_.with(parts_.part_of(id), [&](const Part& part) {
    const auto found = part.find(id);
    return found == part.end() ? nullptr : found->second;
  });
}

void PathSets::add(Situations::Id id, const Set& set) {
  parts_.with(parts_.part_of(id), [&](Part& part) {
    if (!part.try_emplace(id, set).second) return;
    ++sets_;
    nodes_ += static_cast<std::size_t>(set->node_count());
  });
}

PathSets::Set PathSets::make(PathPlanner& planner, AgentIndex agent, const AgentOrder& order,
                             std::span<const Constraint> constraints, Time cost,
                             std::size_t most_nodes, const Limits& limits) {
  OptimalPaths paths;
  const auto outcome =
      planner.optimal_paths(agent, order, constraints, cost, most_nodes, limits, paths);
  if (outcome == OptimalPathsBuilder::Outcome::kStopped) return nullptr;
  return std::make_shared<const OptimalPaths>(std::move(paths));
}

void PathSets::trim() {
  if (nodes_ < kMostNodesKept) return;
  for (std::size_t number = 0; number < Sharded<Part>::kParts; ++number) {
    Part forgotten = parts_.with(number, [](Part& part) { return std::exchange(part, {}); });
    for (const auto& [id, set] : forgotten) nodes_ -= static_cast<std::size_t>(set->node_count());
    sets_ -= forgotten.size();
  }
}

std::size_t PathSets::bytes() const {
  return nodes_ * kBytesPerNode + sets_ * kBytesPerSet;
}

}  // namespace grove::detail
