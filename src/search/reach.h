// SPDX-License-Identifier: MIT
// Reachable configurations of agents on a pebble graph, ignoring costs, headings and tasks.
#pragma once

#include <memory>
#include <vector>

#include "model/instance.h"
#include "search/pebble_graph.h"

namespace grove::detail {

// By node of a graph: the agent there, or kNoAgent.
using PebbleConfiguration = std::vector<AgentIndex>;
inline constexpr AgentIndex kNoAgent = -1;

// The configurations reachable from one configuration, at any cost and by any moves of the agents.
class ReachableConfigurations {
 public:
  virtual ~ReachableConfigurations() = default;
  // Is there one in which the agent that is on `from` now is on `to`?
  virtual bool has(PebbleNode from, PebbleNode to) const = 0;
  // Is this configuration reachable? It must have the same agents.
  virtual bool has(const PebbleConfiguration& arrangement) const = 0;
};

// Computes what is reachable from `start`. `board` must outlive the result. If a node is free, the
// board's root must be free.
std::unique_ptr<ReachableConfigurations> reach_of(const PebbleGraph& board,
                                                  const PebbleConfiguration& start,
                                                  bool may_follow);

// The two cases of reach_of(). The arguments are at the heads of reach_with_room.cpp (with room)
// and reach_without_room.cpp (without).
std::unique_ptr<ReachableConfigurations> reachable_with_room(const PebbleGraph& board,
                                                             const PebbleConfiguration& start,
                                                             bool may_follow);
std::unique_ptr<ReachableConfigurations> reachable_without_room(const PebbleGraph& board,
                                                                const PebbleConfiguration& start,
                                                                bool may_follow);

}  // namespace grove::detail
