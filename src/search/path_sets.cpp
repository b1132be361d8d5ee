// SPDX-License-Identifier: MIT
#include "grove/search/path_sets.h"

namespace grove {
namespace {

constexpr std::size_t kMostNodes = 20'000;         // of one set
constexpr std::size_t kMostNodesKept = 4'000'000;  // of all
constexpr std::size_t kBytesPerNode = 24;          // about
constexpr std::size_t kBytesPerSet = 160;

}  // namespace

const OptimalPaths* PathSets::find(Situations::Id id, AgentIndex agent, const AgentOrder& order,
                                   std::span<const Constraint> constraints, Time cost,
                                   const Limits& limits) {
  const auto [known, is_new] = sets_.try_emplace(id);
  OptimalPaths& paths = known->second;
  if (!is_new) return &paths;
  const auto outcome =
      planner_.optimal_paths(agent, order, constraints, cost, kMostNodes, limits, paths);
  if (outcome == OptimalPathsBuilder::Outcome::kStopped) {
    sets_.erase(known);
    return nullptr;
  }
  nodes_ += static_cast<std::size_t>(paths.node_count());
  return &paths;
}

void PathSets::trim() {
  if (nodes_ > kMostNodesKept) clear();
}

std::size_t PathSets::bytes() const {
  return nodes_ * kBytesPerNode + sets_.size() * kBytesPerSet;
}

void PathSets::clear() {
  sets_.clear();
  nodes_ = 0;
}

}  // namespace grove
