// SPDX-License-Identifier: MIT
// The sets of optimal paths of agents in situations, kept for whoever asks next.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <unordered_map>

#include "search/path_planner.h"
#include "search/sharded.h"
#include "search/subproblem_table.h"

namespace grove::detail {

// All optimal paths by situation: those that were asked for lately. The *young* were since the last
// time that there were too many, the *old* between then and the time before. All methods may be
// called from any thread.
class MddCache {
 public:
  using Set = std::shared_ptr<const Mdd>;

  // More than this of young ones are too many. (Simulated, room-32-32-4 with 40 agents, scenario 4:
  // three times as many save 2 % of the work, and take 1.6 times the memory.)
  static constexpr std::size_t kMostYoungBytes = std::size_t{16} << 20;
  explicit MddCache(std::size_t most_young_bytes = kMostYoungBytes)
      : most_young_bytes_(most_young_bytes) {}

  // Null: not known.
  Set find(SubproblemTable::Id id) const;
  // The set of a situation, which was asked for: from now on it is young.
  void add(SubproblemTable::Id id, const Set& set);

  // Makes the set of the situation that the arguments are, of least cost `cost`. Empty if it takes
  // more than `most_nodes`; null if a limit struck. `planner` is the calling thread's.
  static Set make(PathPlanner& planner, AgentIndex agent, const AgentSequencing& order,
                  std::span<const Constraint> constraints, Time cost, std::size_t most_nodes,
                  const Limits& limits);

  // If there are too many young ones they are old from now on, and the old ones forgotten.
  void trim();

  // Memory held, in bytes (about).
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  using Sets = std::unordered_map<SubproblemTable::Id, Set>;
  struct Part {
    Sets young;
    Sets old;
    std::size_t young_bytes = 0;
    std::size_t old_bytes = 0;
  };

  const std::size_t most_young_bytes_;
  Sharded<Part> parts_;
  std::atomic<std::size_t> bytes_{0};
  std::atomic<std::size_t> young_bytes_{0};
  std::atomic<bool> trimming_{false};
};

}  // namespace grove::detail
