// SPDX-License-Identifier: MIT
// MDD of one agent with several goals: all its paths of one given cost (Boyarski et al. 2015).
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

// Multi-valued decision diagram, a layered graph. The state sequences along its walks from layer 0
// to layer cost() are exactly the paths that it represents. Each path has at least one walk, and
// every node is on such a walk.
class Mdd {
 public:
  // Index of a node; the nodes of all layers are numbered together.
  using NodeId = std::int32_t;
  struct Range {
    NodeId first;
    NodeId end;
  };

  // True if the MDD has no node, hence represents no path. Otherwise the layers are 0 .. cost().
  bool empty() const { return places_.empty(); }
  Time cost() const { return static_cast<Time>(first_of_layer_.size()) - 2; }
  int node_count() const { return static_cast<int>(places_.size()); }
  Range layer(Time time) const {
    const auto from_the_end = static_cast<std::size_t>(cost() - time);
    return {first_of_layer_[from_the_end], first_of_layer_[from_the_end + 1]};
  }
  Place place(NodeId node) const { return places_[node]; }
  State state(NodeId node) const { return states_.empty() ? places_[node] : states_[node]; }
  // Successors in the next layer; empty for a node of the last layer.
  std::span<const NodeId> successors(NodeId node) const {
    return {successors_.data() + first_successor_[node],
            successors_.data() + first_successor_[node + 1]};
  }
  // Memory held, in bytes. An Mdd made by MddBuilder holds no spare capacity.
  std::size_t bytes() const;

  // Equal if the graphs and their node numbers are equal.
  friend bool operator==(const Mdd&, const Mdd&) = default;
  // Equal MDDs have equal hashes, on every machine.
  std::uint64_t hash() const;

 private:
  friend class MddBuilder;

  void clear();  // keeps the capacity
  // True if every edge leads to the next layer, every node except those of the last layer has a
  // successor, and every node except those of layer 0 is one.
  bool is_connected() const;

  // Nodes are stored by layer, from the last layer to the first.
  std::vector<NodeId> first_of_layer_;  // and one more entry for the end
  std::vector<Place> places_;           // by node
  std::vector<State> states_;           // by node; empty if every state is equal to its place
  std::vector<std::int32_t> first_successor_;
  std::vector<NodeId> successors_;
};

// Builds MDDs. One thread at a time. It keeps its workspace between calls, so reuse the object.
class MddBuilder {
 public:
  enum class Outcome : std::uint8_t {
    kBuilt,
    kNone,      // proven: no path has exactly this cost
    kTooLarge,  // more than `max_nodes` nodes or reached (slot, stage) pairs, or the costs to go
                // would become too large
    kStopped,   // a limit was reached
  };

  // `world` must outlive this object.
  explicit MddBuilder(const World& world);
  ~MddBuilder();

  // Builds the MDD of all paths that realize a sequence of the class, satisfy `constraints` (also
  // while resting) and come to rest exactly at `cost`. If `cost` is the least cost, these are all
  // optimal paths. Widens the costs to go of `goals` as needed. `paths` is empty after all outcomes
  // except kBuilt. Throws std::invalid_argument for a constraint that SafeIntervals::assign()
  // refuses.
  Outcome build(SequenceStages& goals, std::span<const Constraint> constraints, Time cost,
                std::size_t max_nodes, const Limits& limits, Mdd& paths);

  // Effort of all calls so far: the number of nodes built plus (slot, stage) pairs reached.
  std::int64_t nodes() const;

 private:
  class Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace grove::detail
