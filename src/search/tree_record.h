// SPDX-License-Identifier: MIT
// A tree as a value, to be kept or sent elsewhere, and the trees made again from such.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "planning/agent_stops_cache.h"
#include "search/node.h"

namespace grove::detail {

// All that a tree fixes, and its root's paths. A value.
struct TreeRecord {
  // See AgentSequencing.
  struct Order {
    SequenceClass sequences;
    bool fixed = false;                // the goals follow from the complete prefix
    std::uint32_t steps = 0;           // of the path
    std::vector<std::uint64_t> words;  // see packed_path.h
    friend bool operator==(const Order&, const Order&) = default;
  };

  std::vector<Order> orders;  // by AgentIndex
  friend bool operator==(const TreeRecord&, const TreeRecord&) = default;
};

// O(length of the paths).
TreeRecord record_of(const Tree& tree);

// Trees that another forest of the same instance instantiated. Trees share the orders that they
// have in common. Not for two threads at once; outlives the nodes of its trees.
class Trees {
 public:
  // All must outlive this; `stops` may be shared with others of the same thread, and is asked for
  // agents whose order is not fixed. Nodes of these trees will live in `pool`.
  Trees(const Problem& problem, AgentStopsCache& stops, NodePool& pool);

  // The root of the tree of this number again. Throws std::invalid_argument, and adds nothing, for
  // a record that cannot be of this instance: a number of agents or stops that is not its own, a
  // path that is no walk from the agent's start to where it may rest, visits other stops or visits
  // them in another order, or that is not the shortest in its order. That a class left open holds
  // no better order is believed.
  NodePtr add(const TreeRecord& record, std::uint32_t number);

  std::size_t size() const { return trees_.size(); }

 private:
  using Order = std::shared_ptr<const AgentSequencing>;

  Order order_of(AgentIndex agent, const TreeRecord::Order& record);
  Time least_cost(const GoalSequence& goals, std::uint32_t known);
  AgentSequencing made(AgentIndex agent, const TreeRecord::Order& record);

  const Problem& problem_;
  AgentStopsCache& stops_;
  NodePool& pool_;
  std::vector<std::vector<Order>> orders_;  // by AgentIndex
  std::deque<Tree> trees_;
};

}  // namespace grove::detail
