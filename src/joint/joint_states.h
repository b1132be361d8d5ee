// SPDX-License-Identifier: MIT
// The joint states that a joint search has reached.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "joint/agent_graph.h"
#include "model/assert.h"

namespace grove::detail {

// Hash table of joint states. A joint state holds a node of agent_graph.h for each agent. Each
// state is in the table once and has a record. One thread at a time.
class JointStates {
 public:
  using Node = AgentGraph::Node;
  using Index = std::uint32_t;  // number of a state, in the order of insertion
  static constexpr Index kNone = std::numeric_limits<Index>::max();

  struct Record {
    Index parent = kNone;
    std::int32_t cost = 0;              // from the start
    std::int32_t layer = 0;             // lower bound on plans through successors not generated yet
    std::int32_t individual_costs = 0;  // sum of individual costs to go
    std::int32_t expanded_budget = -1;  // expanded up to this total delta_f; -1: not expanded
    std::uint32_t tables = 0;           // number of databases that its layer takes into account
  };

  explicit JointStates(std::size_t agents) : agents_(agents) {}

  static std::uint64_t hash_of(const Node* nodes, std::size_t agents) {
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < agents; ++i) hash = (hash ^ nodes[i]) * 0x9e3779b97f4a7c15;
    return hash ^ hash >> 32;
  }

  std::size_t count() const { return records_.size(); }
  Record& operator[](Index state) { return records_[state]; }
  const Record& operator[](Index state) const { return records_[state]; }
  const Node* nodes_of(Index state) const { return nodes_.data() + state * agents_; }

  // The slot of the state with these nodes: its number, or kNone if the state is not in the table.
  // Valid until the next call.
  Index& slot(const Node* nodes, std::uint64_t hash) {
    GROVE_ASSERT(hash == hash_of(nodes, agents_), "the hash is that of the nodes");
    if (2 * (records_.size() + 1) > slots_.size()) grow();
    return slots_[slot_of(nodes, hash)];
  }
  // Adds the state with these nodes, whose slot must be empty.
  void add(Index& slot, const Node* nodes) {
    GROVE_ASSERT(slot == kNone, "a joint state is in the table once");
    slot = static_cast<Index>(records_.size());
    records_.emplace_back();
    nodes_.insert(nodes_.end(), nodes, nodes + agents_);
  }

  // The first prefetches the slot for this hash, the second the state in this slot.
  void prefetch_slot(std::uint64_t hash) const { __builtin_prefetch(&slots_[first_slot(hash)]); }
  void prefetch_state(std::uint64_t hash) const {
    const Index there = slots_[first_slot(hash)];
    if (there == kNone) return;
    __builtin_prefetch(&records_[there]);
    __builtin_prefetch(nodes_of(there));
  }

  std::size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) + records_.capacity() * sizeof(Record) +
           slots_.capacity() * sizeof(Index);
  }

 private:
  std::size_t first_slot(std::uint64_t hash) const { return hash & (slots_.size() - 1); }
  std::size_t slot_of(const Node* nodes, std::uint64_t hash) const {
    std::size_t slot = first_slot(hash);
    while (slots_[slot] != kNone && !std::equal(nodes, nodes + agents_, nodes_of(slots_[slot])))
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), kNone);
    for (Index state = 0; state < records_.size(); ++state) {
      const std::size_t slot = slot_of(nodes_of(state), hash_of(nodes_of(state), agents_));
      GROVE_ASSERT(slots_[slot] == kNone, "no two joint states have the same nodes");
      slots_[slot] = state;
    }
  }

  const std::size_t agents_;
  std::vector<Node> nodes_;  // by state, then agent
  std::vector<Record> records_;
  std::vector<Index> slots_;  // open addressing; size: a power of two
};

}  // namespace grove::detail
