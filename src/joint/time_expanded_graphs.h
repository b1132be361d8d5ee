// SPDX-License-Identifier: MIT
// One agent under demands that depend on time: all that it can come to, and when.
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

// Makes agent graphs whose nodes have their times, but for those at rest. The essay is at the head
// of timed_graphs.cpp. Holds the workspace of one thread: reuse it, do not share it.
class TimeExpandedGraphs {
 public:
  enum class Outcome : std::uint8_t {
    kMade,
    kTooLarge,  // more than `most_nodes` nodes looked at, or than can be numbered (32,767)
    kStopped,   // a limit struck
  };

  // `world` must outlive this.
  explicit TimeExpandedGraphs(const World& world);

  // The ways that realize a sequence of the class of `goals`, obey `constraints`, none of them
  // about the sequence, and cost `most_cost` at most; without a node if there are none. Widens the
  // completions of `goals` as needed.
  Outcome make(SequenceStages& goals, std::span<const Constraint> constraints, Time most_cost,
               std::size_t most_nodes, const Limits& limits, AgentGraph& graph);
  // Nodes looked at so far.
  std::int64_t nodes() const { return looked_at_; }

 private:
  using StageId = SequenceStages::StageId;
  using Index = std::int32_t;

  struct Timed {
    std::int32_t slot;
    StageId stage;
    Time time;
    std::int32_t end_move = 0;  // in moves_; they begin where those of the node before end
    Time finish = kNever;       // the earliest from here
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
  std::vector<Timed> nodes_;  // by time
  std::vector<Index> moves_;  // to these nodes
  std::vector<StageId> first_stages_;
  std::unordered_map<std::uint64_t, Index> next_;  // the layer being made, by slot and stage
  std::int64_t looked_at_ = 0;
  // Of the call under way.
  SequenceStages* goals_ = nullptr;
  Time most_cost_ = 0;
};

}  // namespace grove::detail
