// SPDX-License-Identifier: MIT
// Undirected graph of one connected component of a world, with its blocks and bridges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/world.h"

namespace grove::detail {

using PebbleNode = std::int32_t;

// Nodes are the places of the component. An edge joins two places if a move leads from one to the
// other in at least one direction. Nodes are numbered from 0 in the order of a depth-first search,
// so a node's parent has a smaller number than the node. Immutable: any thread may read it.
class PebbleGraph {
 public:
  static constexpr PebbleNode kNone = -1;

  // `part`: all places of one connected component. Its place `root` gets number 0.
  PebbleGraph(const World& world, std::vector<Place> part, Place root);

  PebbleNode size() const { return static_cast<PebbleNode>(places_.size()); }
  Place place(PebbleNode node) const { return places_[node]; }
  // The node of `place`; kNone if the place is in another component.
  PebbleNode node(Place place) const;
  std::span<const PebbleNode> neighbors(PebbleNode node) const { return neighbors_[node]; }
  PebbleNode parent(PebbleNode node) const { return parents_[node]; }
  // True if the graph is a single cycle.
  bool is_ring() const { return blocks_.size() == 1 && blocks_.front().is_ring(); }

  // True if removing the edge between a and b, which must exist, disconnects them.
  bool is_bridge(PebbleNode a, PebbleNode b) const {
    return a == parent(b) ? is_bridge_to_parent(b) : b == parent(a) && is_bridge_to_parent(a);
  }
  // The number of the 2-edge-connected component of a node. Two nodes are in the same component if
  // and only if a closed walk that uses no edge twice passes through both.
  PebbleNode region(PebbleNode node) const { return regions_[node]; }
  // True if the region of `node` has other nodes, so that a cycle passes through `node`.
  bool is_on_ring(PebbleNode node) const { return is_on_ring_[node] != 0; }

  // A block (biconnected component): a maximal part of the graph that no removal of a single node
  // disconnects. A bridge with its two ends is a block.
  struct Block {
    std::vector<PebbleNode> nodes;  // ascending; the first is nearest to the root
    int ways = 0;                   // number of edges
    bool is_bipartite = true;

    bool is_ring() const { return nodes.size() > 2 && std::size_t(ways) == nodes.size(); }
  };
  const std::vector<Block>& blocks() const { return blocks_; }
  // The block of the edge from a node to its parent.
  const Block& block(PebbleNode node) const { return blocks_[block_of_[node]]; }

  // sums(): for each node, the sum of `values` over its subtree in the depth-first tree. beyond():
  // the sum of the values of all nodes on b's side of the bridge between a and b; `sums` is the
  // result of sums().
  std::vector<int> sums(std::vector<int> values) const;
  int beyond(PebbleNode a, PebbleNode b, const std::vector<int>& sums) const {
    return a == parent(b) ? sums[b] : sums.front() - sums[a];
  }

 private:
  void number(const World& world, Place root);
  void join(const World& world);
  void find_blocks();
  void count_edges();
  void find_regions();
  // True if the edge from `node` to its parent is a bridge.
  bool is_bridge_to_parent(PebbleNode node) const { return block(node).nodes.size() == 2; }

  std::vector<Place> part_;        // ascending
  std::vector<PebbleNode> nodes_;  // by position of the place in part_
  std::vector<Place> places_;
  std::vector<PebbleNode> parents_;  // kNone at the root
  std::vector<int> depths_;
  CsrArray neighbors_;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> block_of_;  // -1 at the root
  std::vector<PebbleNode> regions_;
  std::vector<std::uint8_t> is_on_ring_;
};

// The places adjacent to a place, each once and without the place itself, in ascending order.
std::vector<Place> places_around(const World& world, Place place);

}  // namespace grove::detail
