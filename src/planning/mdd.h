// SPDX-License-Identifier: MIT
// All paths of one agent that cost exactly so much: the MDD of CBS with many goals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/limits.h"
#include "planning/constraint.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// A layered graph: the states along its ways from layer 0 to layer cost() are exactly the paths it
// stands for, each by one way or more. Every node is on such a way. (Multi-valued
// decision diagrams in CBS: Boyarski et al. 2015.)
class Mdd {
 public:
  // A node of one layer, all layers numbered together.
  using NodeId = std::int32_t;
  struct Range {
    NodeId first;
    NodeId end;
  };

  // No node at all: no path. Else there are layers 0 .. cost().
  bool empty() const { return places_.empty(); }
  Time cost() const { return static_cast<Time>(first_of_layer_.size()) - 2; }
  int node_count() const { return static_cast<int>(places_.size()); }
  Range layer(Time time) const {
    const auto from_the_end = static_cast<std::size_t>(cost() - time);
    return {first_of_layer_[from_the_end], first_of_layer_[from_the_end + 1]};
  }
  Place place(NodeId node) const { return places_[node]; }
  State state(NodeId node) const { return states_.empty() ? places_[node] : states_[node]; }
  // In the next layer; none from the last.
  std::span<const NodeId> successors(NodeId node) const {
    return {successors_.data() + first_successor_[node],
            successors_.data() + first_successor_[node + 1]};
  }
  // Memory held, in bytes; no more than it takes if MddBuilder made it.
  std::size_t bytes() const;

  // The same graph, its nodes numbered in the same way.
  friend bool operator==(const Mdd&, const Mdd&) = default;
  // The same for equal ones, on every machine.
  std::uint64_t hash() const;

 private:
  friend class MddBuilder;

  void clear();  // keeps its room

  // Layers from the last to the first.
  std::vector<NodeId> first_of_layer_;  // one more at the end, as below
  std::vector<Place> places_;           // by node
  std::vector<State> states_;           // by node; empty where every state is its place
  std::vector<std::int32_t> first_successor_;
  std::vector<NodeId> successors_;
};

// Holds the workspace of one thread: reuse it, do not share it.
class MddBuilder {
 public:
  enum class Outcome : std::uint8_t {
    kBuilt,
    kNone,      // proven: no path costs exactly that
    kTooLarge,  // more than `most_nodes` nodes, or (slot, stage) pairs looked at for them
    kStopped,   // a limit struck
  };

  // `world` must outlive this.
  explicit MddBuilder(const World& world);
  ~MddBuilder();

  // All paths that realize a sequence of the class, obey `constraints` (also while resting) and
  // come to rest exactly at `cost`: with the least cost there is, all optimal paths. Widens the
  // completions of `goals` as needed. `paths` is empty after all outcomes but kBuilt. Throws
  // std::invalid_argument for a constraint that does not fit the grid.
  Outcome build(SequenceStages& goals, std::span<const Constraint> constraints, Time cost,
                std::size_t most_nodes, const Limits& limits, Mdd& paths);

  // How much was done so far: nodes made, and (slot, stage) pairs looked at for them.
  std::int64_t nodes() const;

 private:
  class Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace grove::detail
