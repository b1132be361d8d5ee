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

// A node is a motion state, the set of stops left, and whether the agent has come to rest forever.
// Where the agent may rest with no stop left, one move is to rest: the agent then stays forever at
// no further cost. All other moves, waits included, cost 1. The graph omits nodes from which the
// agent cannot come to rest, and task executions that serve no stop. (Under time-dependent
// constraints a node also has a time; see time_expanded_graphs.h.) Immutable: any thread may read
// it.
class AgentGraph {
 public:
  using Node = std::uint16_t;
  // Upper limit of make(), whatever `max_nodes` is: only small instances are searched jointly.
  static constexpr std::size_t kMaxNodes = 1 << 12;

  struct Move {
    Node to;
    Time delta_f;  // its cost plus to_go(to), minus to_go() of the node it leaves
  };

  // Returns nullopt if more than min(max_nodes, kMaxNodes) nodes are reachable.
  static std::optional<AgentGraph> make(const Instance& instance, AgentIndex agent,
                                        std::size_t max_nodes = kMaxNodes);

  AgentIndex agent() const { return agent_; }
  // Number of nodes; 0 if the agent has no path even without other agents.
  std::size_t count() const { return to_go_.size(); }
  static constexpr Node start() { return 0; }
  Place place(Node node) const { return places_[node]; }
  State state(Node node) const { return states_[node]; }
  bool rests(Node node) const { return rests_[node] != 0; }
  // Least individual cost until the agent may rest, in steps; 0 exactly at the nodes where it rests
  // or may rest.
  Time to_go(Node node) const { return to_go_[node]; }
  std::size_t move_count() const { return moves_.size(); }
  // The moves from `node`, in ascending order of delta_f; the first has delta_f 0.
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
  std::vector<std::uint32_t> first_move_;  // by node; one more entry at the end
  std::vector<Move> moves_;
};

}  // namespace grove::detail
