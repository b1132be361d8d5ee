// SPDX-License-Identifier: MIT
// Builds AgentGraph: a forward breadth-first search over the reachable nodes, and then a backward
// one for the costs to go.
//
// *Touching counts.* An agent that is on a stop has visited it if its task is executed or takes no
// time. This loses nothing, because with fewer stops left an agent can do everything that it can do
// with more. An agent without a destination may rest on any of its own places with no stop left,
// whatever it visited last: if that place is moved to the end of the sequence, it is visited once
// more. Starting a task that serves none of the stops left has the same effect as a wait, which is
// a move already.
#include "joint/agent_graph.h"

#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

using Visited = std::uint64_t;

}  // namespace

class AgentGraphMaker {
 public:
  AgentGraphMaker(const Instance& instance, AgentIndex agent)
      : instance_(instance), world_(instance.world()), agent_(agent) {}

  std::optional<AgentGraph> make(std::size_t max_nodes) {
    const std::vector<TaskIndex>& stops = instance_.agent(agent_).stops;
    const Visited all = stops.empty() ? 0 : ~Visited{0} >> (64 - stops.size());
    const State start = instance_.agent(agent_).start;
    number({start, without_visited(start, all), false});
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      if (nodes_.size() > max_nodes) return std::nullopt;
      connect(nodes_[node]);
    }
    compute_costs();
    return compact();
  }

 private:
  struct Node {
    State state;
    Visited left;
    bool rests;
    auto operator<=>(const Node&) const = default;
  };

  std::uint32_t number(const Node& node) {
    const auto [at, is_new] = numbers_.try_emplace(node, static_cast<std::uint32_t>(nodes_.size()));
    if (is_new) nodes_.push_back(node);
    return at->second;
  }

  Visited without_visited(State state, Visited left) const {
    for (Visited stops = left; stops != 0; stops &= stops - 1) {
      const int stop = std::countr_zero(stops);
      if (instance_.is_visited(instance_.agent(agent_).stops[static_cast<std::size_t>(stop)],
                               state))
        left &= ~(Visited{1} << stop);
    }
    return left;
  }

  // True unless the agent executes a task that serves no stop in `left`.
  bool serves(State state, Visited left) const {
    if (!world_.is_working(state)) return true;
    const std::vector<TaskIndex>& stops = instance_.agent(agent_).stops;
    const auto at = std::ranges::find(stops, world_.work(state).task);
    return at != stops.end() && (left >> (at - stops.begin()) & 1) != 0;
  }

  void connect(Node from) {
    std::vector<std::uint32_t> to;
    if (from.rests) {
      to.push_back(number(from));
    } else {
      to.push_back(number(from));
      for (const State state : world_.moves(from.state))
        if (serves(state, from.left))
          to.push_back(number({state, without_visited(state, from.left), false}));
      if (may_rest(from)) to.push_back(number({from.state, 0, true}));
    }
    moves_.push_back(std::move(to));
  }

  bool may_rest(const Node& node) const {
    return node.rests || (node.left == 0 && instance_.may_rest(agent_, node.state));
  }

  // Backward breadth-first search from the nodes where the agent may rest. All moves cost 1, except
  // moves to a node at rest.
  void compute_costs() {
    std::vector<std::vector<std::uint32_t>> back(nodes_.size());
    for (std::uint32_t node = 0; node < nodes_.size(); ++node)
      for (const std::uint32_t to : moves_[node])
        if (!nodes_[to].rests) back[to].push_back(node);
    to_go_.assign(nodes_.size(), kNever);
    std::vector<std::uint32_t> queue;
    for (std::uint32_t node = 0; node < nodes_.size(); ++node)
      if (may_rest(nodes_[node])) {
        to_go_[node] = 0;
        queue.push_back(node);
      }
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const std::uint32_t node : back[queue[next]])
        if (to_go_[node] == kNever) {
          to_go_[node] = to_go_[queue[next]] + 1;
          queue.push_back(node);
        }
  }

  // Removes the nodes from which the agent cannot come to rest. The start, if kept, keeps number 0.
  AgentGraph compact() const {
    AgentGraph graph;
    graph.agent_ = agent_;
    graph.first_move_.push_back(0);
    if (to_go_[0] == kNever) return graph;
    std::vector<std::uint32_t> number(nodes_.size());
    std::uint32_t count = 0;
    for (std::size_t node = 0; node < nodes_.size(); ++node)
      if (to_go_[node] < kNever) number[node] = count++;
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      if (to_go_[node] == kNever) continue;
      graph.states_.push_back(nodes_[node].state);
      graph.places_.push_back(world_.place(nodes_[node].state));
      graph.rests_.push_back(nodes_[node].rests ? 1 : 0);
      graph.to_go_.push_back(to_go_[node]);
      const std::size_t first = graph.moves_.size();
      for (const std::uint32_t to : moves_[node]) {
        if (to_go_[to] == kNever) continue;
        const Time delta_f = (nodes_[to].rests ? 0 : 1) + to_go_[to] - to_go_[node];
        graph.moves_.push_back({static_cast<AgentGraph::Node>(number[to]), delta_f});
      }
      std::sort(graph.moves_.begin() + static_cast<std::ptrdiff_t>(first), graph.moves_.end(),
                [](const auto& a, const auto& b) { return a.delta_f < b.delta_f; });
      GROVE_CHECK(graph.moves_.size() > first && graph.moves_[first].delta_f == 0,
                  "the first move from a node begins a cheapest path");
      graph.first_move_.push_back(static_cast<std::uint32_t>(graph.moves_.size()));
    }
    GROVE_CHECK(graph.count() == count, "every kept node has one number");
    return graph;
  }

  const Instance& instance_;
  const World& world_;
  AgentIndex agent_;
  std::map<Node, std::uint32_t> numbers_;
  std::vector<Node> nodes_;
  std::vector<std::vector<std::uint32_t>> moves_;
  std::vector<Time> to_go_;
};

std::optional<AgentGraph> AgentGraph::make(const Instance& instance, AgentIndex agent,
                                           std::size_t max_nodes) {
  return AgentGraphMaker(instance, agent).make(std::min(max_nodes, kMaxNodes));
}

}  // namespace grove::detail
