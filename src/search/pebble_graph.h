// SPDX-License-Identifier: MIT
// A connected part of a world, as a graph.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/world.h"

namespace grove::detail {

using PebbleNode = std::int32_t;

// Places that a way leads between, whatever its direction, numbered from 0 in the order of a
// depth-first search: a node's parent is less than the node. Immutable.
class PebbleGraph {
 public:
  static constexpr PebbleNode kNone = -1;

  // `part`: all the places of one connected part. Its `root` gets number 0.
  PebbleGraph(const World& world, std::vector<Place> part, Place root);

  PebbleNode size() const { return static_cast<PebbleNode>(places_.size()); }
  Place place(PebbleNode node) const { return places_[node]; }
  // kNone of other parts.
  PebbleNode node(Place place) const;
  std::span<const PebbleNode> neighbors(PebbleNode node) const { return neighbors_[node]; }
  PebbleNode parent(PebbleNode node) const { return parents_[node]; }
  // A single circle.
  bool is_ring() const { return blocks_.size() == 1 && blocks_.front().is_ring(); }

  // Without a bridge its ends are in different parts.
  bool is_bridge(PebbleNode a, PebbleNode b) const {
    return a == parent(b) ? hangs(b) : b == parent(a) && hangs(a);
  }
  // Of two nodes with the same one a circle passes through both, without using a way twice.
  PebbleNode region(PebbleNode node) const { return regions_[node]; }
  // And there are others of its region.
  bool is_on_ring(PebbleNode node) const { return is_on_ring_[node] != 0; }

  // What no single node cuts in parts; a bridge is one.
  struct Block {
    std::vector<PebbleNode> nodes;  // rising; the first is the one nearest to the root
    int ways = 0;
    bool is_bipartite = true;

    bool is_ring() const { return nodes.size() > 2 && std::size_t(ways) == nodes.size(); }
  };
  const std::vector<Block>& blocks() const { return blocks_; }
  // The block that leads to the root.
  const Block& block(PebbleNode node) const { return blocks_[block_of_[node]]; }

  // By node: the sum of `values` over it and all below it. And what lies beyond the bridge from a
  // to b, by these sums.
  std::vector<int> sums(std::vector<int> values) const;
  int beyond(PebbleNode a, PebbleNode b, const std::vector<int>& sums) const {
    return a == parent(b) ? sums[b] : sums.front() - sums[a];
  }

 private:
  void number(const World& world, Place root);
  void join(const World& world);
  void find_blocks();
  void count_ways();
  void find_regions();
  // By a bridge, from its parent.
  bool hangs(PebbleNode node) const { return block(node).nodes.size() == 2; }

  std::vector<Place> part_;        // rising
  std::vector<PebbleNode> nodes_;  // by position in part_
  std::vector<Place> places_;
  std::vector<PebbleNode> parents_;  // kNone of the root
  std::vector<int> depths_;
  CsrArray neighbors_;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> block_of_;  // -1 of the root
  std::vector<PebbleNode> regions_;
  std::vector<std::uint8_t> is_on_ring_;
};

// The places next to one, each once and never itself.
std::vector<Place> places_around(const World& world, Place place);

}  // namespace grove::detail
