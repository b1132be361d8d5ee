// SPDX-License-Identifier: MIT
// Reachable configurations on graphs without room: a single cycle ("ring"), a graph whose nodes are
// all occupied, or a graph with a single free node on which agents may not follow each other.
//
// On a ring no agent passes another. If all nodes are occupied, the only steps are rotations of
// whole cycles, and there are none if agents may not follow each other. Rotations use no bridge, so
// each region between bridges can be treated as a separate graph. If one node is free and agents
// may not follow, only the free node moves. When it returns to its place, it has changed the order
// only within single blocks. With the free node at the root, the agents of a block stay on the
// nodes of that block other than the one nearest to the root.
//
// In such a region or block:
// - On a ring the cyclic order of the agents is invariant.
// - If every cycle has odd length or, with a free node, even length, each rotation is an even
//   permutation of the configuration. Half of the configurations are therefore not reachable.
// - Parts of up to seven nodes are searched exhaustively.
// - In all others every configuration that is not excluded so far counts as reachable. (Wilson 1974
//   for one free node, with a single exception, on seven nodes; Yu and Rus 2014 and Yang 2011 for
//   rotations. No answer of Grove depends on it.)
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "search/reach.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxSearchedNodes = 7;  // nodes: 5,040 configurations

std::vector<AgentIndex> agents_on(const std::vector<PebbleNode>& nodes,
                                  const PebbleConfiguration& arrangement) {
  std::vector<AgentIndex> agents;
  for (const PebbleNode node : nodes) agents.push_back(arrangement[node]);
  return agents;
}

bool same_agents(std::vector<AgentIndex> a, std::vector<AgentIndex> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  return a == b;
}

// Tests whether both are the same cyclic order of agents; free nodes do not count.
bool are_in_the_same_order(std::vector<AgentIndex> a, std::vector<AgentIndex> b) {
  std::erase(a, kNoAgent);
  std::erase(b, kNoAgent);
  if (a.empty()) return b.empty();
  const auto first = std::ranges::find(b, a.front());
  if (first == b.end()) return false;
  std::ranges::rotate(b, first);
  return a == b;
}

// Tests whether the permutation from a to b is even. Both must hold the same agents.
bool is_even(const std::vector<AgentIndex>& a, const std::vector<AgentIndex>& b) {
  std::map<AgentIndex, std::size_t> index;
  for (std::size_t i = 0; i < b.size(); ++i) index[b[i]] = i;
  std::vector<bool> seen(a.size());
  bool even = true;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t next = i; !seen[next]; next = index[a[next]]) {
      seen[next] = true;
      if (next != i) even = !even;
    }
  return even;
}

// Exhaustive search of the configurations of a few nodes, at most one of which is free.
class SmallPart {
 public:
  SmallPart(const PebbleGraph& board, std::vector<PebbleNode> nodes) : nodes_(std::move(nodes)) {
    for (const PebbleNode node : nodes_) {
      neighbors_.emplace_back();
      for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (std::ranges::count(board.neighbors(node), nodes_[i]) > 0)
          neighbors_.back().push_back(i);
    }
    for (std::size_t first = 0; first < nodes_.size(); ++first) {
      std::vector<std::size_t> way{first};
      find_cycles(way);
    }
  }

  bool leads(const PebbleConfiguration& from, const PebbleConfiguration& to) const {
    const std::vector<AgentIndex> end = agents_on(nodes_, to);
    std::set<std::vector<AgentIndex>> seen{agents_on(nodes_, from)};
    std::vector<std::vector<AgentIndex>> open(seen.begin(), seen.end());
    while (!open.empty() && !seen.contains(end)) {
      const std::vector<AgentIndex> now = std::move(open.back());
      open.pop_back();
      for_each_next(now, [&](std::vector<AgentIndex> next) {
        if (seen.insert(next).second) open.push_back(std::move(next));
      });
    }
    return seen.contains(end);
  }

 private:
  // Extends `way` to all cycles on which its first node has the least number.
  void find_cycles(std::vector<std::size_t>& way) {
    for (const std::size_t next : neighbors_[way.back()]) {
      if (next == way.front() && way.size() > 2) cycles_.push_back(way);
      if (next <= way.front() || std::ranges::count(way, next) > 0) continue;
      way.push_back(next);
      find_cycles(way);
      way.pop_back();
    }
  }
  template <class Visit>
  void for_each_next(const std::vector<AgentIndex>& now, Visit visit) const {
    const auto free = static_cast<std::size_t>(std::ranges::find(now, kNoAgent) - now.begin());
    if (free < now.size())
      for (const std::size_t other : neighbors_[free]) {
        std::vector<AgentIndex> next = now;
        std::swap(next[free], next[other]);
        visit(std::move(next));
      }
    else
      for (const std::vector<std::size_t>& circle : cycles_) {
        std::vector<AgentIndex> next = now;
        for (std::size_t i = 0; i < circle.size(); ++i)
          next[circle[i]] = now[circle[(i + 1) % circle.size()]];
        visit(std::move(next));
      }
  }

  const std::vector<PebbleNode> nodes_;
  std::vector<std::vector<std::size_t>> neighbors_;
  std::vector<std::vector<std::size_t>> cycles_;
};

class RingReach : public ReachableConfigurations {
 public:
  RingReach(const PebbleGraph& board, const PebbleConfiguration& start)
      : nodes_(board.blocks().front().nodes), start_(agents_on(nodes_, start)) {}
  bool has(PebbleNode, PebbleNode) const override { return true; }
  bool has(const PebbleConfiguration& arrangement) const override {
    return are_in_the_same_order(start_, agents_on(nodes_, arrangement));
  }

 private:
  const std::vector<PebbleNode> nodes_;
  const std::vector<AgentIndex> start_;
};

class FixedReach : public ReachableConfigurations {
 public:
  explicit FixedReach(const PebbleConfiguration& start) : start_(start) {}
  bool has(PebbleNode from, PebbleNode to) const override { return from == to; }
  bool has(const PebbleConfiguration& arrangement) const override { return arrangement == start_; }

 private:
  const PebbleConfiguration start_;
};

// The root is free, and agents may not follow each other.
class OneFreeReach : public ReachableConfigurations {
 public:
  OneFreeReach(const PebbleGraph& board, const PebbleConfiguration& start)
      : board_(board), start_(start) {}

  bool has(PebbleNode from, PebbleNode to) const override {
    return std::ranges::binary_search(board_.block(from).nodes, to);
  }
  bool has(const PebbleConfiguration& arrangement) const override {
    const PebbleConfiguration then = with_free_root(arrangement);
    return std::ranges::all_of(board_.blocks(),
                               [&](const PebbleGraph::Block& block) { return has(block, then); });
  }

 private:
  PebbleConfiguration with_free_root(PebbleConfiguration arrangement) const {
    auto free =
        static_cast<PebbleNode>(std::ranges::find(arrangement, kNoAgent) - arrangement.begin());
    for (; free != 0; free = board_.parent(free))
      std::swap(arrangement[free], arrangement[board_.parent(free)]);
    return arrangement;
  }
  // The free node enters the block at the block's first node.
  bool has(const PebbleGraph::Block& block, const PebbleConfiguration& then) const {
    const std::vector<PebbleNode> others(block.nodes.begin() + 1, block.nodes.end());
    const auto a = agents_on(others, start_);
    const auto b = agents_on(others, then);
    if (!same_agents(a, b)) return false;
    if (a == b) return true;
    if (block.is_ring()) return are_in_the_same_order(a, b);
    if (block.nodes.size() > kMaxSearchedNodes) return !block.is_bipartite || is_even(a, b);
    PebbleConfiguration from = start_;
    PebbleConfiguration to = then;
    from[block.nodes.front()] = to[block.nodes.front()] = kNoAgent;
    return SmallPart(board_, block.nodes).leads(from, to);
  }

  const PebbleGraph& board_;
  const PebbleConfiguration start_;
};

// No node is free, and agents may follow each other.
class FullReach : public ReachableConfigurations {
 public:
  FullReach(const PebbleGraph& board, const PebbleConfiguration& start)
      : board_(board), start_(start) {
    for (PebbleNode node = 0; node < board.size(); ++node)
      regions_[board.region(node)].nodes.push_back(node);
    for (const PebbleGraph::Block& block : board.blocks()) {
      if (block.nodes.size() < 3) continue;
      Region& region = regions_[board.region(block.nodes.back())];
      ++region.blocks;
      region.has_odd_rings_only =
          region.has_odd_rings_only && block.is_ring() && block.nodes.size() % 2 != 0;
      region.is_ring = region.blocks == 1 && block.is_ring();
    }
  }

  bool has(PebbleNode from, PebbleNode to) const override {
    return board_.region(from) == board_.region(to);
  }
  bool has(const PebbleConfiguration& arrangement) const override {
    return std::ranges::all_of(regions_,
                               [&](const auto& region) { return has(region.second, arrangement); });
  }

 private:
  struct Region {
    std::vector<PebbleNode> nodes;  // ascending; on a ring this is the cyclic order
    int blocks = 0;
    bool is_ring = false;
    bool has_odd_rings_only = true;
  };

  bool has(const Region& region, const PebbleConfiguration& then) const {
    const auto a = agents_on(region.nodes, start_);
    const auto b = agents_on(region.nodes, then);
    if (!same_agents(a, b)) return false;
    if (a == b) return true;
    if (region.is_ring) return are_in_the_same_order(a, b);
    if (region.nodes.size() > kMaxSearchedNodes) return !region.has_odd_rings_only || is_even(a, b);
    return SmallPart(board_, region.nodes).leads(start_, then);
  }

  const PebbleGraph& board_;
  const PebbleConfiguration start_;
  std::map<PebbleNode, Region> regions_;
};

}  // namespace

std::unique_ptr<ReachableConfigurations> reachable_without_room(const PebbleGraph& board,
                                                                const PebbleConfiguration& start,
                                                                bool may_follow) {
  const auto free = std::ranges::count(start, kNoAgent);
  if (free == 0 && !may_follow) return std::make_unique<FixedReach>(start);
  if (board.is_ring()) return std::make_unique<RingReach>(board, start);
  if (free == 0) return std::make_unique<FullReach>(board, start);
  return std::make_unique<OneFreeReach>(board, start);
}

std::unique_ptr<ReachableConfigurations> reach_of(const PebbleGraph& board,
                                                  const PebbleConfiguration& start,
                                                  bool may_follow) {
  const auto free = std::ranges::count(start, kNoAgent);
  const bool has_room = free > 1 || (free == 1 && may_follow);
  return has_room && !board.is_ring() ? reachable_with_room(board, start, may_follow)
                                      : reachable_without_room(board, start, may_follow);
}

}  // namespace grove::detail
