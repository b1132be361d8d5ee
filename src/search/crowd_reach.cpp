// SPDX-License-Identifier: MIT
// Boards on which agents have room to change order: m nodes are free, two at least, or one if
// agents may follow each other; and the board is no ring. (Pebble motion: Kornhauser, Miller and
// Spirakis 1984; with rotations: Yu and Rus 2014. How a board falls apart follows Push and Rotate,
// de Wilde, ter Mors and Witteveen 2014.)
//
// Agents change order at *crossings*: regions of nodes on rings, and single nodes with three ways.
// With two free nodes at a crossing any two agents there can change places. With one they can on a
// ring, if agents may follow: all go round, with one agent more or less than at first. So a
// crossing *needs* 1 or 2. Between crossings are *ways* of nodes with two neighbours.
//
// Take an agent on a way, t steps from the crossing at its beginning, with b free nodes on that
// side of it. As long as it is on the way, that crossing included, t - b is the same: each step of
// its own takes one free node from one side to the other, and nobody else brings one past it. At
// t = 0 it can go aside only with b >= 1, if the crossing needs 2; and where one is enough, it
// comes to t = 0 only if t - b <= 0. So who has t - b > 1 - need is *stuck* as seen from there.
// Who is stuck as seen from both ends never leaves the way, nor changes order with others who
// are. From the other end the way is d - t long and m - b free nodes are there: who is not stuck
// as seen from either end has d <= m + 2 - both needs. If that does not hold, nobody who can leave
// the way at one end can at the other. This proves what is not reached.
//
// The rest is reached, which no answer of ours rests on: where a way is that short, the crossings
// at both ends are one for their agents. All that are not stuck as seen from some crossing that is
// so joined, its *crowd*, can be arranged anyhow, on the nodes that they have: all arrangements of
// free nodes can be come to, and two agents of the crowd can be brought to a crossing together,
// change places, and all be brought back.
//
// Which nodes are reached: of a crowd those of its crossings, and of ways from there those with t
// <= m + 1 - need, for b = m is the most. Of an agent that is stuck, with as many agents on one
// side of it for ever: those which leave room for 0 to m free nodes there.
#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "search/reach.h"

namespace grove::detail {
namespace {

constexpr PebbleNode kStuck = -1;

// From a crossing, or a dead end, to the next. Ways between crossings are there twice.
struct Way {
  PebbleNode from = PebbleGraph::kNone;  // kNone: the board is nothing but this way
  std::vector<PebbleNode> nodes;         // the other end included

  int length() const { return static_cast<int>(nodes.size()); }
  PebbleNode before_end() const { return nodes.size() > 1 ? nodes[nodes.size() - 2] : from; }
};

// What does not depend on who is where.
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
  // The number of all crossings that are joined to this one.
  PebbleNode crowd(PebbleNode crossing) const { return joined_[crossing]; }
  // How far from it who is not stuck is at most.
  int most_steps(PebbleNode crossing) const { return free_ + 1 - need(crossing); }
  bool is_reached(PebbleNode crowd_there, PebbleNode node) const {
    return (is_crossing(node) && crowd(node) == crowd_there) ||
           std::ranges::binary_search(near_, std::pair(node, crowd_there));
  }
  // The one of the two that is looked at.
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
    const PebbleNode crowd_there = crowd(way.from);
    for (int t = 1; t <= std::min(way.length(), most_steps(way.from)); ++t)
      near_.emplace_back(way.nodes[t - 1], crowd_there);
  }

  const PebbleGraph& board_;
  const int free_;
  const bool may_follow_;
  std::vector<Way> ways_;
  std::vector<PebbleNode> joined_;  // by node; while ways are looked at, a forest of regions
  // Nodes beside a crossing, and the crowd that reaches them from there.
  std::vector<std::pair<PebbleNode, PebbleNode>> near_;
};

// Who belongs where in an arrangement.
class Membership {
 public:
  Membership(const Crossings& crossings, const PebbleConfiguration& arrangement)
      : crossings_(crossings),
        arrangement_(arrangement),
        crowds_(arrangement.size(), kStuck),
        queues_(crossings.ways().size()) {
    std::vector<int> counts;
    for (const AgentIndex agent : arrangement) counts.push_back(agent == kNobody ? 1 : 0);
    free_ = board().sums(std::move(counts));
    for (PebbleNode node = 0; node < board().size(); ++node)
      if (!is_free(node) && crossings.is_crossing(node) && !is_held(node))
        crowds_[node] = crossings.crowd(node);
    for (const Way& way : crossings.ways()) add_those_near(way);
    for (std::size_t way = 0; way < queues_.size(); ++way)
      if (crossings.is_first(crossings.ways()[way])) find_queue(way);
  }

  // Of who is on a node; kStuck: of none.
  PebbleNode crowd(PebbleNode node) const { return crowds_[node]; }
  // Those who are stuck on a way, in order.
  const std::vector<std::vector<PebbleNode>>& queues() const { return queues_; }
  // How many nodes beyond this one, as seen from the way, are free?
  int free_before(const Way& way) const {
    return way.from == PebbleGraph::kNone
               ? 0
               : crossings_.free() - board().beyond(way.from, way.nodes.front(), free_);
  }
  bool is_free(PebbleNode node) const { return arrangement_[node] == kNobody; }

 private:
  const PebbleGraph& board() const { return crossings_.board(); }

  // All that is free is ahead of it.
  bool is_held_by(PebbleNode node, PebbleNode next) const {
    return crossings_.need(node) == 2 && board().is_bridge(node, next) &&
           board().beyond(node, next, free_) == crossings_.free();
  }
  bool is_held(PebbleNode node) const {
    return std::ranges::any_of(board().neighbors(node),
                               [&](PebbleNode next) { return is_held_by(node, next); });
  }
  void add_those_near(const Way& way) {
    if (way.from == PebbleGraph::kNone) return;
    const PebbleNode crowd_there = crossings_.crowd(way.from);
    int steps_less_free = -free_before(way);
    for (const PebbleNode node : way.nodes) {
      if (is_free(node)) continue;
      if (++steps_less_free > 1 - crossings_.need(way.from)) return;
      crowds_[node] = crowd_there;
    }
  }
  bool is_stuck(PebbleNode node) const { return !is_free(node) && crowds_[node] == kStuck; }
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
  std::vector<int> free_;  // sums
  std::vector<PebbleNode> crowds_;
  std::vector<std::vector<PebbleNode>> queues_;  // by way
};

// Each agent that belongs to a crowd, with the crowd.
std::vector<std::pair<AgentIndex, PebbleNode>> crowds_of(const PebbleConfiguration& arrangement,
                                                         const Membership& membership) {
  std::vector<std::pair<AgentIndex, PebbleNode>> crowds;
  for (PebbleNode node = 0; node < static_cast<PebbleNode>(arrangement.size()); ++node)
    if (membership.crowd(node) != kStuck)
      crowds.emplace_back(arrangement[node], membership.crowd(node));
  std::ranges::sort(crowds);
  return crowds;
}

// Those who are stuck, way by way.
std::vector<std::vector<AgentIndex>> queues_of(const PebbleConfiguration& arrangement,
                                               const Membership& membership) {
  std::vector<std::vector<AgentIndex>> queues;
  for (const std::vector<PebbleNode>& queue : membership.queues()) {
    queues.emplace_back();
    for (const PebbleNode node : queue) queues.back().push_back(arrangement[node]);
  }
  return queues;
}

class CrowdReach : public ReachableConfigurations {
 public:
  CrowdReach(const PebbleGraph& board, const PebbleConfiguration& start, bool may_follow)
      : start_(start),
        crossings_(board, static_cast<int>(std::ranges::count(start, kNobody)), may_follow),
        now_(crossings_, start_),
        sizes_(board.sums(std::vector<int>(start.size(), 1))),
        spots_(start.size()),
        agents_before_(start.size()) {
    for (std::size_t way = 0; way < crossings_.ways().size(); ++way)
      if (crossings_.is_first(crossings_.ways()[way])) look_along(way);
  }

  bool has(PebbleNode from, PebbleNode to) const override {
    if (now_.crowd(from) != kStuck) return crossings_.is_reached(now_.crowd(from), to);
    const auto nodes_before = nodes_before_on(held_on(from), to);
    if (!nodes_before) return false;
    const int free_before = *nodes_before - agents_before_[from];
    return free_before >= 0 && free_before <= crossings_.free();
  }

  bool has(const PebbleConfiguration& arrangement) const override {
    const Membership then(crossings_, arrangement);
    return crowds_of(start_, now_) == crowds_of(arrangement, then) &&
           queues_of(start_, now_) == queues_of(arrangement, then);
  }

 private:
  // Of who is stuck there, or of a node with no more than two ways: on what way it is. And how many
  // nodes of the board come before it there.
  struct Spot {
    std::size_t way = 0;
    int nodes_before = 0;
  };

  const Way& held_on(PebbleNode node) const { return crossings_.ways()[spots_[node].way]; }
  // Before the first that is no crossing.
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
  const std::vector<int> sizes_;  // sums
  std::vector<Spot> spots_;
  std::vector<int> agents_before_;  // by node: of who is stuck there, those for ever before it
};

}  // namespace

std::unique_ptr<ReachableConfigurations> reachable_with_room(const PebbleGraph& board,
                                                             const PebbleConfiguration& start,
                                                             bool may_follow) {
  return std::make_unique<CrowdReach>(board, start, may_follow);
}

}  // namespace grove::detail
