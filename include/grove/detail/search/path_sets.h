// SPDX-License-Identifier: MIT
// The sets of optimal paths of agents in situations, kept for whoever asks next.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <unordered_map>

#include "grove/detail/search/path_planner.h"
#include "grove/detail/search/sharded.h"
#include "grove/detail/search/situations.h"

namespace grove::detail {

// All optimal paths by situation. All methods may be called from any thread.
class PathSets {
 public:
  using Set = std::shared_ptr<const OptimalPaths>;

  // Null: not known.
  Set find(Situations::Id id) const;
  // The set of a situation; ignored if one is known.
  void add(Situations::Id id, const Set& set);

  // Makes the set of the situation that the arguments are, of least cost `cost`. Empty if it takes
  // more than `most_nodes`; null if a limit struck. `planner` is the calling thread's.
  static Set make(PathPlanner& planner, AgentIndex agent, const AgentOrder& order,
                  std::span<const Constraint> constraints, Time cost, std::size_t most_nodes,
                  const Limits& limits);

  // Forgets sets if there are too many.
  void trim();

  // Memory held, in bytes (about).
  std::size_t bytes() const;

 private:
  using Part = std::unordered_map<Situations::Id, Set>;

  Sharded<Part> parts_;
  std::atomic<std::size_t> sets_{0};
  std::atomic<std::size_t> nodes_{0};  // of the layered graphs
};

}  // namespace grove::detail
