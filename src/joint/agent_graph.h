// SPDX-License-Identifier: MIT
// State graph of one agent: its reachable states, numbered, with costs to go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/instance.h"

namespace grove::detail {

// A node is a motion state, the stops that are left, and whether the agent has come to rest for
// ever. Where the agent may rest with no stop left, one move is to rest: the agent stays and costs
// nothing from then on. All other moves, waits included, cost 1. Nodes from which the agent cannot
// come to rest are omitted, and so is task execution that serves no stop. (Under constraints that
// depend on time, a node has a time as well: time_expanded_graphs.h.) Immutable: any thread may
// read it.
class AgentGraph {
 public:
  using Node = std::uint16_t;
  static constexpr std::size_t kMaxNodes = 1 << 12;  // more nodes: the instance is not small

  struct Move {
    Node to;
    Time delta_f;  // increase over the least individual cost from here
  };

  // Returns nullopt if more than `max_nodes` nodes are reachable.
  static std::optional<AgentGraph> make(const Instance& instance, AgentIndex agent,
                                        std::size_t max_nodes = kMaxNodes);

  AgentIndex agent() const { return agent_; }
  // 0 if the agent cannot complete its stops even without other agents.
  std::size_t count() const { return to_go_.size(); }
  static constexpr Node start() { return 0; }
  Place place(Node node) const { return places_[node]; }
  State state(Node node) const { return states_[node]; }
  bool rests(Node node) const { return rests_[node] != 0; }
  // Least individual cost until it may rest; 0 exactly where it rests or may rest.
  Time to_go(Node node) const { return to_go_[node]; }
  std::size_t move_count() const { return moves_.size(); }
  // Sorted by delta_f, ascending; the first is always 0.
  std::span<const Move> moves(Node node) const {
    return {moves_.data() + first_move_[node], moves_.data() + first_move_[node + 1]};
  }

 private:
  friend class AgentGraphMaker;
  friend class TimeExpandedGraphs;
  AgentIndex agent_ = 0;
  std::vector<Place> places_;
  std::vector<State> states_;
  std::vector<std::uint8_t> rests_;
  std::vector<Time> to_go_;
  std::vector<std::uint32_t> first_move_;  // by node; one more at the end
  std::vector<Move> moves_;
};

}  // namespace grove::detail
