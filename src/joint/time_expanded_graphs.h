// SPDX-License-Identifier: MIT
// Time-expanded graph of one agent under constraints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "joint/agent_graph.h"
#include "model/limits.h"
#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// Makes agent graphs whose nodes have a time, except the nodes at rest. The proof is at the head of
// time_expanded_graphs.cpp. Keeps its workspace between calls. One thread at a time.
class TimeExpandedGraphs {
 public:
  enum class Outcome : std::uint8_t {
    kMade,
    kTooLarge,  // more than `max_nodes` nodes or more than can be numbered (32,767), or the costs
                // to go of `goals` would become too large
    kStopped,   // a limit was reached
  };

  // `world` must outlive this object.
  explicit TimeExpandedGraphs(const World& world);

  // Makes the graph of the paths that realize a sequence of the class of `goals`, satisfy
  // `constraints` (none of them on the sequence) and cost at most `max_cost`. If there is no such
  // path, the graph has no nodes. Extends the costs to go of `goals` as needed. After all outcomes
  // except kMade the graph has no nodes.
  Outcome make(SequenceStages& goals, std::span<const Constraint> constraints, Time max_cost,
               std::size_t max_nodes, const Limits& limits, AgentGraph& graph);
  // Nodes expanded so far, over all calls.
  std::int64_t nodes() const { return expanded_; }

 private:
  using StageId = SequenceStages::StageId;
  using Index = std::int32_t;

  struct Timed {
    std::int32_t slot;
    StageId stage;
    Time time;
    std::int32_t end_move = 0;  // in moves_; its moves start at end_move of the previous node
    Time finish = kNever;       // earliest finish from here
  };

  void start();
  void expand(Index node);
  void expand(std::int32_t slot, StageId stage, Time time);
  void reach(std::int32_t slot, StageId stage, Time time);
  bool may_rest(Index node) const;
  void find_finishes();
  void write(AgentGraph& graph) const;
  Index first_move(Index node) const { return node == 0 ? 0 : nodes_[node - 1].end_move; }

  const World& world_;
  SafeIntervals intervals_;
  std::vector<Timed> nodes_;  // in order of time
  std::vector<Index> moves_;  // target nodes, node after node
  std::vector<StageId> first_stages_;
  std::unordered_map<std::uint64_t, Index> next_;  // nodes of the next time, by slot and stage
  std::int64_t expanded_ = 0;
  // Arguments of the current call.
  SequenceStages* goals_ = nullptr;
  Time max_cost_ = 0;
};

}  // namespace grove::detail
