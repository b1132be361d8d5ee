// SPDX-License-Identifier: MIT
// Serializable trees, and a container that recreates trees from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "planning/agent_stops_cache.h"
#include "search/node.h"

namespace grove::detail {

// The sequence classes that a tree fixes, and the paths of its root.
struct TreeRecord {
  // What the tree fixes about one agent; see AgentSequencing.
  struct Order {
    SequenceClass sequences;
    bool fixed = false;                // the prefix is complete and determines the goals
    std::uint32_t steps = 0;           // length of the path
    std::vector<std::uint64_t> words;  // see packed_path.h
    friend bool operator==(const Order&, const Order&) = default;
  };

  std::vector<Order> orders;  // by AgentIndex
  friend bool operator==(const TreeRecord&, const TreeRecord&) = default;
};

// Converts a tree to a record. O(total length of the paths).
TreeRecord record_of(const Tree& tree);

// Trees that another forest of the same instance has instantiated, recreated from records. Equal
// orders of an agent are shared by all trees. Must outlive the nodes of its trees. One thread at a
// time.
class Trees {
 public:
  // All arguments must outlive this object. `stops` may be shared with other objects of the same
  // thread; it is queried for agents whose order is not fixed. `pool` holds the nodes of these
  // trees.
  Trees(const Problem& problem, AgentStopsCache& stops, NodePool& pool);

  // Recreates the tree with this number and returns its root. Throws std::invalid_argument, and
  // adds no tree, if the record cannot belong to this instance. This is so if the number of agents
  // is wrong, if a fixed order does not hold each stop once, or if a path is not a walk from its
  // agent's start to a place where the agent may rest, does not visit the stops in their order, or
  // is not shortest for that order. For a class that leaves the order open, it is not checked that
  // no other order is better.
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
