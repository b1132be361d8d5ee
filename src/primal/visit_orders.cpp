// SPDX-License-Identifier: MIT
// Agents without a destination should head for distinct last stops that are no other agent's
// destination. Their last stops are a matching of agents and cells, found by augmenting paths
// (Kuhn's algorithm). Each agent tries the last stop of its cheapest sequence first.
#include "primal/visit_orders.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "sequencing/cost_matrix.h"
#include "sequencing/rtsp.h"

namespace grove::detail {
namespace {

Sequence listed_order(const CostMatrix& matrix) {
  Sequence order(static_cast<std::size_t>(matrix.stops()));
  std::iota(order.begin(), order.end(), Stop{0});
  return order;
}

std::optional<Sequence> cheapest_order(const CostMatrix& matrix, const Limits& limits) {
  if (matrix.stops() < 2) return listed_order(matrix);
  const auto solver = make_rtsp_solver(RtspBackend::kAuto, matrix, limits);
  switch (solver->best({}, kNever).kind) {
    case RtspAnswer::Kind::kExact:
      return solver->best_sequence({});
    case RtspAnswer::Kind::kStopped:
      return std::nullopt;
    default:
      return listed_order(matrix);
  }
}

// Gives each agent without a destination, if possible, a last stop that is no other agent's last
// stop or destination.
class LastStops {
 public:
  LastStops(const Instance& instance, std::vector<Sequence>& orders)
      : instance_(instance), orders_(orders) {
    for (const Agent& agent : instance.agents())
      if (agent.goal) destinations_.insert(*agent.goal);
  }

  void place(AgentIndex agent) {
    tried_ = destinations_;
    augment(agent);
  }

 private:
  Cell cell_of(AgentIndex agent, Stop stop) const {
    return instance_.task(instance_.agent(agent).stops[stop]).cell;
  }

  bool augment(AgentIndex agent) {
    const Sequence order = orders_[agent];
    return std::any_of(order.rbegin(), order.rend(), [&](Stop stop) {
      const Cell cell = cell_of(agent, stop);
      if (!tried_.insert(cell).second) return false;
      const auto holder = holder_.find(cell);
      if (holder != holder_.end() && !augment(holder->second)) return false;
      holder_[cell] = agent;
      end_on(orders_[agent], stop);
      return true;
    });
  }

  static void end_on(Sequence& order, Stop stop) {
    const auto place = std::ranges::find(order, stop);
    std::rotate(place, place + 1, order.end());
  }

  const Instance& instance_;
  std::vector<Sequence>& orders_;
  std::unordered_set<Cell> destinations_;
  std::unordered_map<Cell, AgentIndex> holder_;
  std::unordered_set<Cell> tried_;
};

}  // namespace

std::optional<std::vector<Sequence>> cheapest_orders(const Problem& problem, const Limits& limits) {
  const Instance& instance = problem.instance;
  std::vector<Sequence> orders;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    if (limits.stop_requested()) return std::nullopt;
    auto order = cheapest_order(cost_matrix(instance, agent, problem.distances), limits);
    if (!order) return std::nullopt;
    orders.push_back(std::move(*order));
  }
  separate_ends(instance, orders);
  return orders;
}

void separate_ends(const Instance& instance, std::vector<Sequence>& orders) {
  LastStops last_stops(instance, orders);
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
    if (!instance.agent(agent).goal) last_stops.place(agent);
}

}  // namespace grove::detail
