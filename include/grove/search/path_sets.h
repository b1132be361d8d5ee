// SPDX-License-Identifier: MIT
// The sets of optimal paths of agents in situations, kept for whoever asks next.
#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>

#include "grove/search/path_planner.h"
#include "grove/search/situations.h"

namespace grove {

// All optimal paths by situation. One per thread.
class PathSets {
 public:
  // `planner` must outlive this and may be shared with others of the same thread.
  explicit PathSets(PathPlanner& planner) : planner_(planner) {}

  // The paths of the situation `id`, which is that of the other arguments, of least cost `cost`;
  // valid until trim() or clear(). Empty if there are too many; null if a limit struck.
  const OptimalPaths* find(Situations::Id id, AgentIndex agent, const AgentOrder& order,
                           std::span<const Constraint> constraints, Time cost,
                           const Limits& limits);

  // Forgets everything if it has become too much.
  void trim();

  // Memory held, in bytes (about). clear() must be called when the situations are cleared.
  std::size_t bytes() const;
  void clear();

 private:
  PathPlanner& planner_;
  std::unordered_map<Situations::Id, OptimalPaths> sets_;
  std::size_t nodes_ = 0;  // of the layered graphs
};

}  // namespace grove
