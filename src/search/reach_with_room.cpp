// SPDX-License-Identifier: MIT
// Reachable configurations of pebble graphs on which agents have room to change their order.
//
// *Problem.* m nodes are free, m >= 2, or m >= 1 if agents may follow each other. The graph is not
// a ring. Which configurations can be reached? (Pebble motion: Kornhauser, Miller and Spirakis
// 1984; with rotations: Yu and Rus 2014. The decomposition of the graph follows Push and Rotate, de
// Wilde, ter Mors and Witteveen 2014.)
//
// *Definitions.* Agents change their order at *crossings*, which are regions of nodes on rings, and
// single nodes with three or more neighbours. With two free nodes at a crossing any two agents
// there can change places. One free node suffices on a ring if agents may follow each other: the
// agents on the ring rotate while the ring holds one agent more or fewer than at first. So a
// crossing has a *need* of 1 or 2 free nodes. The crossings are connected by *ways*, which are
// paths of nodes with two neighbours each.
//
// Consider an agent on a way, t steps from the crossing at the beginning of the way, with b free
// nodes on that side of it. While the agent is on the way (including that crossing), t - b is
// invariant: each step of the agent moves one free node from one side of it to the other, and no
// other agent moves a free node past it. At t = 0 the agent can leave the way only with b >= 1, if
// need = 2; if need = 1, it reaches t = 0 only if t - b <= 0. So an agent with t - b > 1 - need is
// *stuck* as seen from this crossing.
//
// *Claim.* (a) An agent that is stuck as seen from both ends never leaves the way, and never
// changes its order with other such agents. (b) If d > m + 2 - (sum of both needs), where d is the
// length of the way, then no agent that can leave the way at one end can leave it at the other.
//
// *Proof of (b).* From the other end the distance is d - t and there are m - b free nodes. For an
// agent that is not stuck as seen from either end, the sum of the two inequalities is
// d <= m + 2 - (sum of both needs).
//
// *Consequence.* This proves which configurations are unreachable.
//
// *Converse* (no answer of Grove relies on it): all other configurations are reachable. Where a way
// has d <= m + 2 - (sum of both needs), the crossings at its ends act as one crossing for their
// agents. Joining crossings along such ways gives sets of crossings. The *group* of a set consists
// of the agents that are not stuck as seen from some crossing of the set. A group can be arranged
// in any order on the nodes that it has: every arrangement of the free nodes can be reached, and
// two agents of the group can be brought to a crossing together, change places, and all agents be
// brought back.
//
// *Reachable nodes.* A group reaches the nodes of its crossings and, on the ways from there, the
// nodes with t <= m + 1 - need, because b <= m. A stuck agent always has the same number of agents
// on either side; it reaches the nodes that leave room for 0 to m free nodes on one side.
#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "model/assert.h"
#include "search/reach.h"

namespace grove::detail {
namespace {

constexpr PebbleNode kStuck = -1;

// A way from a crossing to the next crossing or dead end, or between two dead ends. Ways between
// crossings are stored twice, once per direction.
struct Way {
  PebbleNode from = PebbleGraph::kNone;  // kNone: the graph consists of this way only
  std::vector<PebbleNode> nodes;         // includes the other end

  int length() const { return static_cast<int>(nodes.size()); }
  PebbleNode before_end() const { return nodes.size() > 1 ? nodes[nodes.size() - 2] : from; }
};

// The part of the analysis that does not depend on which agent is on which node.
class Crossings {
 public:
  Crossings(const PebbleGraph& board, int free, bool may_follow)
      : board_(board), free_(free), may_follow_(may_follow), joined_(board.size()) {
    std::iota(joined_.begin(), joined_.end(), 0);
    find_ways();
    for (const Way& way : ways_)
      if (is_between(way) && way.length() <= free_ + 2 - need(way.from) - need(way.nodes.back()))
        joined_[root(way.from)] = root(way.nodes.back());
    for (PebbleNode node = 0; node < board.size(); ++node) joined_[node] = root(node);
    for (const Way& way : ways_) add_nodes_near(way);
    std::ranges::sort(near_);
  }

  const PebbleGraph& board() const { return board_; }
  int free() const { return free_; }
  const std::vector<Way>& ways() const { return ways_; }
  bool is_crossing(PebbleNode node) const {
    return board_.is_on_ring(node) || board_.neighbors(node).size() > 2;
  }
  int need(PebbleNode crossing) const { return may_follow_ && board_.is_on_ring(crossing) ? 1 : 2; }
  // The number of the set of joined crossings that contains `crossing`; it identifies the group.
  PebbleNode group(PebbleNode crossing) const { return joined_[crossing]; }
  // The maximum distance from `crossing` of an agent that is not stuck as seen from it.
  int max_steps(PebbleNode crossing) const { return free_ + 1 - need(crossing); }
  bool is_reached(PebbleNode group_there, PebbleNode node) const {
    return (is_crossing(node) && group(node) == group_there) ||
           std::ranges::binary_search(near_, std::pair(node, group_there));
  }
  // Ways between crossings exist in both directions. Returns whether `way` is the direction in use.
  bool is_first(const Way& way) const { return !is_between(way) || way.from < way.nodes.back(); }

 private:
  bool is_between(const Way& way) const {
    return way.from != PebbleGraph::kNone && is_crossing(way.nodes.back());
  }
  PebbleNode root(PebbleNode node) {
    PebbleNode root = board_.region(node);
    while (joined_[root] != root) root = joined_[root] = joined_[joined_[root]];
    return root;
  }
  void find_ways() {
    for (PebbleNode node = 0; node < board_.size(); ++node)
      if (is_crossing(node))
        for (const PebbleNode next : board_.neighbors(node))
          if (board_.is_bridge(node, next)) ways_.push_back(way(node, next));
    if (!ways_.empty()) return;
    for (PebbleNode node = 0; node < board_.size() && ways_.empty(); ++node)
      if (!is_crossing(node) && board_.neighbors(node).size() < 2)
        ways_.push_back(way(PebbleGraph::kNone, node));
  }
  Way way(PebbleNode from, PebbleNode next) const {
    Way way{from, {next}};
    while (!is_crossing(way.nodes.back())) {
      const auto neighbors = board_.neighbors(way.nodes.back());
      const auto on =
          std::ranges::find_if(neighbors, [&](PebbleNode n) { return n != way.before_end(); });
      if (on == neighbors.end()) break;
      way.nodes.push_back(*on);
    }
    return way;
  }
  void add_nodes_near(const Way& way) {
    if (way.from == PebbleGraph::kNone) return;
    const PebbleNode group_there = group(way.from);
    for (int t = 1; t <= std::min(way.length(), max_steps(way.from)); ++t)
      near_.emplace_back(way.nodes[t - 1], group_there);
  }

  const PebbleGraph& board_;
  const int free_;
  const bool may_follow_;
  std::vector<Way> ways_;
  std::vector<PebbleNode> joined_;  // by node; during construction a union-find forest of regions
  // Pairs of a node of a way and a group that reaches it, sorted.
  std::vector<std::pair<PebbleNode, PebbleNode>> near_;
};

// The groups and the stuck agents of one configuration.
class Membership {
 public:
  Membership(const Crossings& crossings, const PebbleConfiguration& arrangement)
      : crossings_(crossings),
        arrangement_(arrangement),
        groups_(arrangement.size(), kStuck),
        queues_(crossings.ways().size()) {
    std::vector<int> counts;
    for (const AgentIndex agent : arrangement) counts.push_back(agent == kNoAgent ? 1 : 0);
    free_ = board().sums(std::move(counts));
    GROVE_CHECK(free_.front() == crossings.free(), "the number of free nodes never changes");
    for (PebbleNode node = 0; node < board().size(); ++node)
      if (!is_free(node) && crossings.is_crossing(node) && !is_held(node))
        groups_[node] = crossings.group(node);
    for (const Way& way : crossings.ways()) assign_near_nodes(way);
    for (std::size_t way = 0; way < queues_.size(); ++way)
      if (crossings.is_first(crossings.ways()[way])) find_queue(way);
  }

  // The group of the agent on `node`; kStuck if the agent is stuck or the node is free.
  PebbleNode group(PebbleNode node) const { return groups_[node]; }
  // For each way: the nodes of the agents that are stuck on it, in order.
  const std::vector<std::vector<PebbleNode>>& queues() const { return queues_; }
  // The number of free nodes on the side of the crossing at the beginning of `way`, including that
  // crossing.
  int free_before(const Way& way) const {
    return way.from == PebbleGraph::kNone
               ? 0
               : crossings_.free() - board().beyond(way.from, way.nodes.front(), free_);
  }
  bool is_free(PebbleNode node) const { return arrangement_[node] == kNoAgent; }

 private:
  const PebbleGraph& board() const { return crossings_.board(); }

  // Returns whether the agent on the crossing `node` is stuck on the way that starts with `next`.
  // This is so if the crossing needs two free nodes and all free nodes are on the side of `next`.
  bool is_held_by(PebbleNode node, PebbleNode next) const {
    return crossings_.need(node) == 2 && board().is_bridge(node, next) &&
           board().beyond(node, next, free_) == crossings_.free();
  }
  bool is_held(PebbleNode node) const {
    return std::ranges::any_of(board().neighbors(node),
                               [&](PebbleNode next) { return is_held_by(node, next); });
  }
  void assign_near_nodes(const Way& way) {
    if (way.from == PebbleGraph::kNone) return;
    const PebbleNode group_there = crossings_.group(way.from);
    int steps_less_free = -free_before(way);
    for (const PebbleNode node : way.nodes) {
      if (is_free(node)) continue;
      if (++steps_less_free > 1 - crossings_.need(way.from)) return;
      groups_[node] = group_there;
    }
  }
  bool is_stuck(PebbleNode node) const { return !is_free(node) && groups_[node] == kStuck; }
  void find_queue(std::size_t number) {
    const Way& way = crossings_.ways()[number];
    std::vector<PebbleNode>& queue = queues_[number];
    if (way.from != PebbleGraph::kNone && is_stuck(way.from) &&
        is_held_by(way.from, way.nodes.front()))
      queue.push_back(way.from);
    for (const PebbleNode node : way.nodes)
      if (is_stuck(node) && (!crossings_.is_crossing(node) || is_held_by(node, way.before_end())))
        queue.push_back(node);
  }

  const Crossings& crossings_;
  const PebbleConfiguration& arrangement_;
  std::vector<int> free_;  // free nodes per subtree, see PebbleGraph::sums()
  std::vector<PebbleNode> groups_;
  std::vector<std::vector<PebbleNode>> queues_;  // by way
};

// All pairs of an agent and its group, sorted.
std::vector<std::pair<AgentIndex, PebbleNode>> groups_of(const PebbleConfiguration& arrangement,
                                                         const Membership& membership) {
  std::vector<std::pair<AgentIndex, PebbleNode>> groups;
  for (PebbleNode node = 0; node < static_cast<PebbleNode>(arrangement.size()); ++node)
    if (membership.group(node) != kStuck)
      groups.emplace_back(arrangement[node], membership.group(node));
  std::ranges::sort(groups);
  return groups;
}

// For each way: the agents that are stuck on it, in order.
std::vector<std::vector<AgentIndex>> queues_of(const PebbleConfiguration& arrangement,
                                               const Membership& membership) {
  std::vector<std::vector<AgentIndex>> queues;
  for (const std::vector<PebbleNode>& queue : membership.queues()) {
    queues.emplace_back();
    for (const PebbleNode node : queue) queues.back().push_back(arrangement[node]);
  }
  return queues;
}

class ReachWithRoom : public ReachableConfigurations {
 public:
  ReachWithRoom(const PebbleGraph& board, const PebbleConfiguration& start, bool may_follow)
      : start_(start),
        crossings_(board, static_cast<int>(std::ranges::count(start, kNoAgent)), may_follow),
        now_(crossings_, start_),
        sizes_(board.sums(std::vector<int>(start.size(), 1))),
        spots_(start.size()),
        agents_before_(start.size()) {
    for (std::size_t way = 0; way < crossings_.ways().size(); ++way)
      if (crossings_.is_first(crossings_.ways()[way])) look_along(way);
  }

  bool has(PebbleNode from, PebbleNode to) const override {
    if (now_.group(from) != kStuck) return crossings_.is_reached(now_.group(from), to);
    const auto nodes_before = nodes_before_on(held_on(from), to);
    if (!nodes_before) return false;
    const int free_before = *nodes_before - agents_before_[from];
    return free_before >= 0 && free_before <= crossings_.free();
  }

  bool has(const PebbleConfiguration& arrangement) const override {
    const Membership then(crossings_, arrangement);
    return groups_of(start_, now_) == groups_of(arrangement, then) &&
           queues_of(start_, now_) == queues_of(arrangement, then);
  }

 private:
  // The way that contains a node or, for a crossing with a stuck agent, the way on which the agent
  // is stuck.
  struct Spot {
    std::size_t way = 0;
    int nodes_before = 0;  // nodes of the graph before the node, along the way; not for crossings
  };

  const Way& held_on(PebbleNode node) const { return crossings_.ways()[spots_[node].way]; }
  // The number of nodes of the graph before the first node of `way`.
  int nodes_before(const Way& way) const {
    return way.from == PebbleGraph::kNone
               ? 0
               : sizes_.front() - crossings_.board().beyond(way.from, way.nodes.front(), sizes_);
  }
  std::optional<int> nodes_before_on(const Way& way, PebbleNode node) const {
    if (node == way.from) return nodes_before(way) - 1;
    if (node == way.nodes.back()) return nodes_before(way) + way.length() - 1;
    if (crossings_.is_crossing(node) || &held_on(node) != &way) return std::nullopt;
    return spots_[node].nodes_before;
  }

  void look_along(std::size_t number) {
    const Way& way = crossings_.ways()[number];
    int nodes = nodes_before(way);
    int free = now_.free_before(way);
    for (const PebbleNode node : way.nodes) {
      if (!crossings_.is_crossing(node)) spots_[node] = {number, nodes};
      agents_before_[node] = nodes - free;
      ++nodes;
      if (now_.is_free(node)) ++free;
    }
    for (const PebbleNode node : now_.queues()[number])
      if (crossings_.is_crossing(node)) {
        spots_[node].way = number;
        agents_before_[node] = node == way.from
                                   ? nodes_before(way) - 1
                                   : nodes_before(way) + way.length() - 1 - crossings_.free();
      }
  }

  const PebbleConfiguration start_;
  const Crossings crossings_;
  const Membership now_;
  const std::vector<int> sizes_;  // nodes per subtree, see PebbleGraph::sums()
  std::vector<Spot> spots_;
  // By node: number of agents that always stay before the agent that is stuck there.
  std::vector<int> agents_before_;
};

}  // namespace

std::unique_ptr<ReachableConfigurations> reachable_with_room(const PebbleGraph& board,
                                                             const PebbleConfiguration& start,
                                                             bool may_follow) {
  return std::make_unique<ReachWithRoom>(board, start, may_follow);
}

}  // namespace grove::detail
