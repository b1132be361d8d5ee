// SPDX-License-Identifier: MIT
// Computes blocks by depth-first search (Hopcroft and Tarjan 1973). An edge outside the depth-first
// tree joins a node with one of its ancestors. It lies in the same block as the tree edge from the
// deeper of the two nodes to its parent. Each edge, whether in the tree or not, is therefore
// counted for the block of its deeper end. The tree edges of a block connect all of it, so the
// block is bipartite if and only if each of its other edges joins a node of even depth and one of
// odd depth.
#include "search/pebble_graph.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "model/assert.h"

namespace grove::detail {

std::vector<Place> places_around(const World& world, Place place) {
  const auto neighbors = world.neighbors(place);
  std::vector<Place> around(neighbors.begin(), neighbors.end());
  std::ranges::sort(around);
  const auto [same, end] = std::ranges::unique(around);
  around.erase(same, end);
  std::erase(around, place);
  return around;
}

PebbleGraph::PebbleGraph(const World& world, std::vector<Place> part, Place root)
    : part_(std::move(part)) {
  std::ranges::sort(part_);
  nodes_.assign(part_.size(), kNone);
  number(world, root);
  join(world);
  find_blocks();
  count_edges();
  find_regions();
}

PebbleNode PebbleGraph::node(Place place) const {
  const auto found = std::ranges::lower_bound(part_, place);
  return found == part_.end() || *found != place ? kNone : nodes_[found - part_.begin()];
}

void PebbleGraph::join(const World& world) {
  for (const Place place : places_) {
    for (const Place other : places_around(world, place)) neighbors_.add(node(other));
    neighbors_.end_row();
  }
}

void PebbleGraph::number(const World& world, Place root) {
  struct Level {
    PebbleNode node;
    std::vector<Place> around;
  };
  std::vector<Level> way;
  const auto visit = [&](Place place, PebbleNode parent, int depth) {
    const PebbleNode node = size();
    nodes_[std::ranges::lower_bound(part_, place) - part_.begin()] = node;
    places_.push_back(place);
    parents_.push_back(parent);
    depths_.push_back(depth);
    way.push_back({node, places_around(world, place)});
  };
  visit(root, kNone, 0);
  while (!way.empty()) {
    std::vector<Place>& around = way.back().around;
    if (around.empty()) {
      way.pop_back();
      continue;
    }
    const Place next = around.back();
    around.pop_back();
    if (node(next) == kNone) visit(next, way.back().node, depths_[way.back().node] + 1);
  }
  GROVE_CHECK(places_.size() == part_.size(), "all places of a component are connected");
}

// The second loop runs backwards, so that each node is complete before its parent.
void PebbleGraph::find_blocks() {
  // By node: the least node in its subtree or joined to the subtree by an edge outside the tree.
  std::vector<PebbleNode> highest(size());
  for (PebbleNode node = 0; node < size(); ++node) {
    highest[node] = node;
    for (const PebbleNode other : neighbors(node))
      if (other != parent(node)) highest[node] = std::min(highest[node], other);
  }
  for (PebbleNode node = size() - 1; node > 0; --node)
    highest[parent(node)] = std::min(highest[parent(node)], highest[node]);
  block_of_.assign(size(), -1);
  for (PebbleNode node = 1; node < size(); ++node) {
    const bool begins = highest[node] >= parent(node);
    if (begins) blocks_.push_back({.nodes = {parent(node)}});
    block_of_[node] =
        begins ? static_cast<std::int32_t>(blocks_.size()) - 1 : block_of_[parent(node)];
    GROVE_ASSERT(parent(node) < node, "a parent has a smaller number than its children");
    blocks_[block_of_[node]].nodes.push_back(node);
  }
  PebbleNode below = 0;  // nodes of blocks, without the first of each block
  for (const Block& block : blocks_) below += static_cast<PebbleNode>(block.nodes.size()) - 1;
  GROVE_CHECK(below == size() - 1, "each node except the root is in one block with its parent");
}

void PebbleGraph::count_edges() {
  for (PebbleNode node = 1; node < size(); ++node) {
    Block& block = blocks_[block_of_[node]];
    for (const PebbleNode other : neighbors(node)) {
      if (other > node) continue;
      ++block.ways;
      if ((depths_[node] - depths_[other]) % 2 == 0) block.is_bipartite = false;
    }
  }
  std::size_t edges = 0;
  std::size_t ends = 0;
  for (const Block& block : blocks_) edges += static_cast<std::size_t>(block.ways);
  for (PebbleNode node = 0; node < size(); ++node) ends += neighbors(node).size();
  GROVE_CHECK(2 * edges == ends, "each edge is in one block");
}

void PebbleGraph::find_regions() {
  regions_.assign(size(), 0);
  is_on_ring_.assign(size(), 0);
  for (PebbleNode node = 1; node < size(); ++node) {
    if (is_bridge_to_parent(node)) {
      regions_[node] = node;
      continue;
    }
    regions_[node] = region(parent(node));
    is_on_ring_[node] = is_on_ring_[parent(node)] = 1;
  }
}

std::vector<int> PebbleGraph::sums(std::vector<int> values) const {
  const int total = std::accumulate(values.begin(), values.end(), 0);
  for (PebbleNode node = size() - 1; node > 0; --node) values[parent(node)] += values[node];
  GROVE_CHECK(values.front() == total, "the sum of the root is that of all nodes");
  return values;
}

}  // namespace grove::detail
