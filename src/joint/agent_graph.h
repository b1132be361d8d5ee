// SPDX-License-Identifier: MIT
// One agent alone: all that it can come to, numbered, and what it costs from there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/instance.h"

namespace grove::detail {

// Nodes are what an agent can be in: a state of its motion, the stops that are left, and whether it
// has come to rest for ever. Where it may rest with nothing left, one of its moves is to do so: it
// stays, and no longer costs anything; all other moves, waits included, cost 1. Nodes from which it
// cannot come to rest are left out, and so are works that serve nothing. (Under demands that depend
// on time a node has its time, too: timed_graphs.h.) Immutable.
class AgentGraph {
 public:
  using Node = std::uint16_t;
  static constexpr std::size_t kMostNodes = 1 << 12;  // a larger world is no small one

  struct Move {
    Node to;
    Time delta_f;  // what it costs more than the best way from here, alone
  };

  // None: it can come to more than `most_nodes` nodes.
  static std::optional<AgentGraph> make(const Instance& instance, AgentIndex agent,
                                        std::size_t most_nodes = kMostNodes);

  AgentIndex agent() const { return agent_; }
  // 0: it cannot do what it has to, even alone.
  std::size_t count() const { return to_go_.size(); }
  static constexpr Node start() { return 0; }
  Place place(Node node) const { return places_[node]; }
  State state(Node node) const { return states_[node]; }
  bool rests(Node node) const { return rests_[node] != 0; }
  // Least cost until it can rest, alone; 0 exactly where it rests or may.
  Time to_go(Node node) const { return to_go_[node]; }
  std::size_t move_count() const { return moves_.size(); }
  // By detour, the least first: 0, always.
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
