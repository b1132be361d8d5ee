// SPDX-License-Identifier: MIT
// Serializable trees, and the container that recreates trees from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "planning/agent_stops_cache.h"
#include "search/node.h"

namespace grove::detail {

// The sequence classes that a tree fixes, and its root's paths. A value.
struct TreeRecord {
  // See AgentSequencing.
  struct Order {
    SequenceClass sequences;
    bool fixed = false;                // the prefix is complete and determines the goals
    std::uint32_t steps = 0;           // of the path
    std::vector<std::uint64_t> words;  // see packed_path.h
    friend bool operator==(const Order&, const Order&) = default;
  };

  std::vector<Order> orders;  // by AgentIndex
  friend bool operator==(const TreeRecord&, const TreeRecord&) = default;
};

// O(length of the paths).
TreeRecord record_of(const Tree& tree);

// Trees that another forest of the same instance instantiated. Trees share equal orders. One thread
// at a time. Must outlive the nodes of its trees.
class Trees {
 public:
  // All arguments must outlive this. `stops` may be shared with others of the same thread; it is
  // queried for agents whose order is not fixed. `pool` holds the nodes of these trees.
  Trees(const Problem& problem, AgentStopsCache& stops, NodePool& pool);

  // Recreates the tree with this number and returns its root. Throws std::invalid_argument, and
  // adds nothing, if the record cannot be one of this instance: a wrong number of agents or stops,
  // or a path that is no walk from the agent's start to a place where it may rest, that visits
  // other stops or another order, or that is not the shortest in its order. Not checked: that a
  // class with open stops has no better order.
  NodePtr add(const TreeRecord& record, std::uint32_t number);

  std::size_t size() const { return trees_.size(); }

 private:
  using Order = std::shared_ptr<const AgentSequencing>;

  Order order_of(AgentIndex agent, const TreeRecord::Order& record);
  Time min_cost(const GoalSequence& goals, std::uint32_t known);
  AgentSequencing made(AgentIndex agent, const TreeRecord::Order& record);

  const Problem& problem_;
  AgentStopsCache& stops_;
  NodePool& pool_;
  std::vector<std::vector<Order>> orders_;  // by AgentIndex
  std::deque<Tree> trees_;
};

}  // namespace grove::detail
