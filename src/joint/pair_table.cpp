// SPDX-License-Identifier: MIT
// Backwards from all pairs that are at rest or may be, by Dijkstra's algorithm: a step of both costs
// 0, 1 or 2. What two agents cost at least is what any plan of more agents pays for these two.
#include "grove/detail/joint/pair_table.h"

#include <algorithm>
#include <span>

namespace grove::detail {
namespace {

using Node = AgentGraph::Node;

// The moves of an agent backwards.
class Backwards {
 public:
  explicit Backwards(const AgentGraph& graph) : first_(graph.count() + 1, 0) {
    for (std::size_t node = 0; node < graph.count(); ++node)
      for (const auto& move : graph.moves(static_cast<Node>(node))) ++first_[move.to + std::size_t{1}];
    for (std::size_t node = 0; node < graph.count(); ++node) first_[node + 1] += first_[node];
    from_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t node = 0; node < graph.count(); ++node)
      for (const auto& move : graph.moves(static_cast<Node>(node)))
        from_[next[move.to]++] = static_cast<Node>(node);
  }
  std::span<const Node> to(Node node) const {
    return {from_.data() + first_[node], from_.data() + first_[node + std::size_t{1}]};
  }

 private:
  std::vector<std::uint32_t> first_;  // by node; one more at the end
  std::vector<Node> from_;
};

class Costs {
 public:
  Costs(const Instance& instance, const AgentGraph& a, const AgentGraph& b)
      : may_follow_(instance.may_follow()), a_(a), b_(b), costs_(a.count() * b.count(), kNever) {
    begin();
    const Backwards to_a(a);
    const Backwards to_b(b);
    for (Time cost = 0; cost < static_cast<Time>(layers_.size()); ++cost)
      for (std::size_t next = 0; next < layers_[static_cast<std::size_t>(cost)].size(); ++next)
        settle(layers_[static_cast<std::size_t>(cost)][next], cost, to_a, to_b);
  }

  Time operator()(Node i, Node j) const { return costs_[index(i, j)]; }

 private:
  std::size_t index(Node i, Node j) const { return i * b_.count() + j; }

  void begin() {
    for (std::size_t i = 0; i < a_.count(); ++i)
      for (std::size_t j = 0; j < b_.count(); ++j) {
        const auto m = static_cast<Node>(i);
        const auto n = static_cast<Node>(j);
        if (a_.to_go(m) == 0 && b_.to_go(n) == 0 && a_.place(m) != b_.place(n)) reach(index(m, n), 0);
      }
  }
  void reach(std::size_t pair, Time cost) {
    if (costs_[pair] <= cost) return;
    costs_[pair] = cost;
    if (static_cast<std::size_t>(cost) >= layers_.size()) layers_.resize(static_cast<std::size_t>(cost) + 1);
    layers_[static_cast<std::size_t>(cost)].push_back(static_cast<std::uint32_t>(pair));
  }
  void settle(std::uint32_t pair, Time cost, const Backwards& to_a, const Backwards& to_b) {
    if (costs_[pair] != cost) return;
    const auto i = static_cast<Node>(pair / b_.count());
    const auto j = static_cast<Node>(pair % b_.count());
    const Time step = (a_.rests(i) ? 0 : 1) + (b_.rests(j) ? 0 : 1);
    for (const Node from_i : to_a.to(i))
      for (const Node from_j : to_b.to(j))
        if (!collide(a_.place(from_i), a_.place(i), b_.place(from_j), b_.place(j)))
          reach(index(from_i, from_j), cost + step);
  }
  bool collide(Place from_a, Place to_a, Place from_b, Place to_b) const {
    if (from_a == from_b || to_a == to_b) return true;
    return may_follow_ ? from_a == to_b && to_a == from_b : from_a == to_b || to_a == from_b;
  }

  const bool may_follow_;
  const AgentGraph& a_;
  const AgentGraph& b_;
  std::vector<Time> costs_;
  std::vector<std::vector<std::uint32_t>> layers_;  // pairs by cost
};

}  // namespace

std::optional<PairTable> PairTable::make(const Instance& instance, const AgentGraph& a,
                                         const AgentGraph& b) {
  if (a.count() * b.count() > kMostPairs) return std::nullopt;
  const Costs costs(instance, a, b);
  PairTable table;
  table.width_ = b.count();
  table.excess_.reserve(a.count() * b.count());
  for (std::size_t i = 0; i < a.count(); ++i)
    for (std::size_t j = 0; j < b.count(); ++j) {
      const auto m = static_cast<Node>(i);
      const auto n = static_cast<Node>(j);
      const Time together = costs(m, n);
      const Time more = together - a.to_go(m) - b.to_go(n);
      table.excess_.push_back(together == kNever ? kNoWay
                                                 : static_cast<std::uint8_t>(std::min(more, 254)));
    }
  return table;
}

}  // namespace grove::detail
