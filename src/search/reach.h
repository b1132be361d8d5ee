// SPDX-License-Identifier: MIT
// Reachable configurations of agents on a pebble graph, ignoring costs, headings and tasks.
#pragma once

#include <memory>
#include <vector>

#include "model/instance.h"
#include "search/pebble_graph.h"

namespace grove::detail {

// For each node of a graph: the agent on it, or kNoAgent.
using PebbleConfiguration = std::vector<AgentIndex>;
inline constexpr AgentIndex kNoAgent = -1;

// The configurations that are reachable from a start configuration by any moves of the agents, at
// any cost. A result of false is proven. A result of true rests on published theorems; no answer of
// Grove relies on it.
class ReachableConfigurations {
 public:
  virtual ~ReachableConfigurations() = default;
  // Returns whether the agent that starts on `from` is on `to` in some reachable configuration.
  virtual bool has(PebbleNode from, PebbleNode to) const = 0;
  // Returns whether this configuration is reachable. It must have the same agents as the start.
  virtual bool has(const PebbleConfiguration& arrangement) const = 0;
};

// Computes the configurations that are reachable from `start`. `board` must outlive the result. If
// a node is free, the root of `board` must be free. `may_follow`: see Instance.
std::unique_ptr<ReachableConfigurations> reach_of(const PebbleGraph& board,
                                                  const PebbleConfiguration& start,
                                                  bool may_follow);

// The two cases of reach_of(). The proofs are at the heads of reach_with_room.cpp and
// reach_without_room.cpp.
std::unique_ptr<ReachableConfigurations> reachable_with_room(const PebbleGraph& board,
                                                             const PebbleConfiguration& start,
                                                             bool may_follow);
std::unique_ptr<ReachableConfigurations> reachable_without_room(const PebbleGraph& board,
                                                                const PebbleConfiguration& start,
                                                                bool may_follow);

}  // namespace grove::detail
