// SPDX-License-Identifier: MIT
// Backward Dijkstra search from all joint nodes in which every member is at rest or may rest. A
// step costs 1 for each member that is not at rest. In any plan of more agents, the members
// together cost at least the cost found here.
#include "joint/pattern_database.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "model/effort.h"

namespace grove::detail {
namespace {

using Node = AgentGraph::Node;
constexpr std::int64_t kExpandedPerPoll = 1024;

// The reversed moves of an agent.
class Backwards {
 public:
  explicit Backwards(const AgentGraph& graph) : first_(graph.count() + 1, 0) {
    for_each_move(graph, [&](Node, Node to) { ++first_[to + std::size_t{1}]; });
    for (std::size_t node = 0; node < graph.count(); ++node) first_[node + 1] += first_[node];
    from_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_each_move(graph, [&](Node from, Node to) { from_[next[to]++] = from; });
  }
  std::span<const Node> to(Node node) const {
    return {from_.data() + first_[node], from_.data() + first_[node + std::size_t{1}]};
  }

 private:
  template <class Visit>
  static void for_each_move(const AgentGraph& graph, Visit visit) {
    for (std::size_t node = 0; node < graph.count(); ++node)
      for (const auto& move : graph.moves(static_cast<Node>(node)))
        visit(static_cast<Node>(node), move.to);
  }

  std::vector<std::uint32_t> first_;  // by node; one more at the end
  std::vector<Node> from_;
};

// Least joint cost of the members, by entry.
class Costs {
 public:
  Costs(const Instance& instance, std::vector<const AgentGraph*> members,
        std::vector<std::size_t> strides, std::size_t entries)
      : may_follow_(instance.may_follow()),
        members_(std::move(members)),
        strides_(std::move(strides)),
        costs_(entries, kNever),
        to_(members_.size()),
        from_(members_.size()) {
    for (const AgentGraph* member : members_) backwards_.emplace_back(*member);
  }

  // Returns false if a limit was reached.
  bool find(const Limits& limits) {
    begin(0, 0);
    std::int64_t expanded = 0;
    for (std::size_t cost = 0; cost < layers_.size(); ++cost)
      for (std::size_t next = 0; next < layers_[cost].size(); ++next) {
        if (++expanded % kExpandedPerPoll == 0 && limits.stop_requested()) return false;
        expand(layers_[cost][next], static_cast<Time>(cost));
      }
    return true;
  }

  Time operator[](std::size_t entry) const { return costs_[entry]; }

 private:
  // Starts from all joint nodes in which each member may rest, on distinct places.
  void begin(std::size_t member, std::size_t entry) {
    if (member == members_.size()) return reach(entry, 0);
    const AgentGraph& graph = *members_[member];
    for (std::size_t node = 0; node < graph.count(); ++node) {
      to_[member] = static_cast<Node>(node);
      if (graph.to_go(to_[member]) > 0) continue;
      bool is_free = true;
      for (std::size_t other = 0; other < member; ++other)
        is_free = is_free && members_[other]->place(to_[other]) != graph.place(to_[member]);
      if (is_free) begin(member + 1, entry + node * strides_[member]);
    }
  }
  void reach(std::size_t entry, Time cost) {
    if (costs_[entry] <= cost) return;
    costs_[entry] = cost;
    if (static_cast<std::size_t>(cost) >= layers_.size())
      layers_.resize(static_cast<std::size_t>(cost) + 1);
    layers_[static_cast<std::size_t>(cost)].push_back(static_cast<std::uint32_t>(entry));
  }
  void expand(std::size_t entry, Time cost) {
    GROVE_ASSERT(costs_[entry] <= cost,
                 "an entry is in the layers of its earlier and current costs");
    if (costs_[entry] != cost) return;
    for (std::size_t member = 0; member < members_.size(); ++member) {
      to_[member] = static_cast<Node>(entry / strides_[member]);
      entry %= strides_[member];
      if (!members_[member]->rests(to_[member])) ++cost;
    }
    step_back(0, 0, cost);
  }
  void step_back(std::size_t member, std::size_t entry, Time cost) {
    if (member == members_.size()) return reach(entry, cost);
    for (const Node from : backwards_[member].to(to_[member])) {
      from_[member] = from;
      if (!collides(member)) step_back(member + 1, entry + from * strides_[member], cost);
    }
  }
  // True if the move of `member` collides with that of an earlier member.
  bool collides(std::size_t member) const {
    const Place from = members_[member]->place(from_[member]);
    const Place to = members_[member]->place(to_[member]);
    for (std::size_t other = 0; other < member; ++other) {
      const Place other_from = members_[other]->place(from_[other]);
      const Place other_to = members_[other]->place(to_[other]);
      if (from == other_from || to == other_to) return true;
      if (may_follow_ ? from == other_to && to == other_from : from == other_to || to == other_from)
        return true;
    }
    return false;
  }

  const bool may_follow_;
  const std::vector<const AgentGraph*> members_;
  const std::vector<std::size_t> strides_;  // descending
  std::vector<Backwards> backwards_;
  std::vector<Time> costs_;
  std::vector<std::vector<std::uint32_t>> layers_;  // entries by cost
  std::vector<Node> to_;
  std::vector<Node> from_;
};

template <class Value>
Value product(std::span<const std::size_t> members, Value (*of)(const AgentGraph&),
              std::span<const AgentGraph> agents) {
  Value all = 1;
  for (const std::size_t member : members) all *= of(agents[member]);
  return all;
}

}  // namespace

std::size_t PatternDatabase::entries(std::span<const AgentGraph> agents,
                                     std::span<const std::size_t> members) {
  return product<std::size_t>(
      members, [](const AgentGraph& a) { return a.count(); }, agents);
}

std::int64_t PatternDatabase::work(std::span<const AgentGraph> agents,
                                   std::span<const std::size_t> members) {
  const auto moves = [](const AgentGraph& a) { return static_cast<std::int64_t>(a.move_count()); };
  return product<std::int64_t>(members, moves, agents) / effort::kMoveTuples;
}

std::optional<PatternDatabase> PatternDatabase::make(const Instance& instance,
                                                     std::span<const AgentGraph> agents,
                                                     std::vector<std::size_t> members,
                                                     const Limits& limits) {
  PatternDatabase table(std::move(members));
  std::vector<const AgentGraph*> graphs;
  for (const std::size_t member : table.members_) graphs.push_back(&agents[member]);
  for (std::size_t i = graphs.size(); i-- > 1;)
    table.strides_[i - 1] = table.strides_[i] * graphs[i]->count();
  table.excess_.resize(entries(agents, table.members_));
  Costs costs(instance, graphs, table.strides_, table.excess_.size());
  if (!costs.find(limits)) return std::nullopt;
  for (std::size_t entry = 0; entry < table.excess_.size(); ++entry) {
    Time alone = 0;
    for (std::size_t i = 0, rest = entry; i < graphs.size(); rest %= table.strides_[i++])
      alone += graphs[i]->to_go(static_cast<Node>(rest / table.strides_[i]));
    GROVE_ASSERT(costs[entry] >= alone,
                 "agents together cost at least the sum of their individual costs");
    table.excess_[entry] = costs[entry] == kNever
                               ? kUnreachable
                               : static_cast<std::uint8_t>(std::min(costs[entry] - alone, 254));
  }
  return table;
}

}  // namespace grove::detail
