// SPDX-License-Identifier: MIT
// Where agents on a board can come to, if nothing matters but who is in whose way.
#pragma once

#include <memory>
#include <vector>

#include "model/instance.h"
#include "search/pebble_graph.h"

namespace grove::detail {

// By node of a board: who is there.
using PebbleConfiguration = std::vector<AgentIndex>;
inline constexpr AgentIndex kNobody = -1;

// Of one arrangement: all that come of it, at whatever cost, each agent going where it likes.
class ReachableConfigurations {
 public:
  virtual ~ReachableConfigurations() = default;
  // Is there one in which who is on `from` now is on `to`?
  virtual bool has(PebbleNode from, PebbleNode to) const = 0;
  // Is this one of them? Of the same agents.
  virtual bool has(const PebbleConfiguration& arrangement) const = 0;
};

// `board` must outlive it. If a node is free, the board's root must be.
std::unique_ptr<ReachableConfigurations> reach_of(const PebbleGraph& board,
                                                  const PebbleConfiguration& start,
                                                  bool may_follow);

// Of these boards the argument stands at the head of the .cpp of the same name.
std::unique_ptr<ReachableConfigurations> reachable_with_room(const PebbleGraph& board,
                                                             const PebbleConfiguration& start,
                                                             bool may_follow);
std::unique_ptr<ReachableConfigurations> reachable_without_room(const PebbleGraph& board,
                                                                const PebbleConfiguration& start,
                                                                bool may_follow);

}  // namespace grove::detail
