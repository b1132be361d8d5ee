// SPDX-License-Identifier: MIT
// As in sequence_forest.cpp, a path that does not depend on constraints is planned once per agent
// and route, and shared by all trees that use it.
#include "search/route_forest.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "model/assert.h"
#include "sequencing/joint_route_solver.h"

namespace grove::detail {
namespace {

const Problem& with_joint_routes(const Problem& problem) {
  require_joint_routes(problem.instance, "policy fixed does not support", "policy free");
  return problem;
}

}  // namespace

RouteForest::RouteForest(const Problem& problem, NodePool& pool, RtspBackend backend,
                         const Limits& limits)
    : problem_(with_joint_routes(problem)),
      pool_(pool),
      limits_(limits),
      routes_(problem.instance, problem.distances),
      joint_routes_(routes_.problem(), make_joint_route_solver(backend, routes_.problem(), limits),
                    limits),
      orders_(problem.instance.agents().size()),
      low_level_(problem.instance.world()),
      others_(problem.instance.world()) {}

Cost RouteForest::next_bound() const {
  return pending_ ? pending_->cost : joint_routes_.lower_bound();
}

NodePtr RouteForest::next_root() {
  if (!pending_) pending_ = joint_routes_.next();
  if (!pending_) return nullptr;
  auto orders = orders_of(*pending_);
  if (!orders) return nullptr;

  Tree& tree = trees_.emplace_back();
  tree.world = &problem_.instance.world();
  tree.pool = &pool_;
  tree.number = static_cast<std::uint32_t>(trees_.size() - 1);
  tree.orders = *std::move(orders);
  NodePtr root = Node::root(tree);
  GROVE_CHECK(root->cost() >= pending_->cost, "a root costs at least its joint route");
  pending_.reset();  // last: an exception before this line loses no joint route
  return root;
}

// Returns nullopt if a limit was reached. Missing paths are planned around those that are known,
// which avoids conflicts caused by mere ties.
std::optional<std::vector<RouteForest::Order>> RouteForest::orders_of(const JointRoute& joint) {
  const World& world = problem_.instance.world();
  std::vector<Order> orders(joint.routes.size());
  others_.clear();
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent) {
    const auto known = orders_[agent].find(joint.routes[agent]);
    if (known == orders_[agent].end()) continue;
    orders[agent] = known->second;
    orders[agent]->path.view().unpack(world, problem_.instance.agent(agent).start, path_);
    others_.add(path_);
  }
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent) {
    if (orders[agent]) continue;
    orders[agent] = plan_order(agent, joint.routes[agent]);
    if (!orders[agent]) return std::nullopt;
    orders_[agent].emplace(joint.routes[agent], orders[agent]);
  }
  return orders;
}

// Returns nullptr if a limit was reached.
RouteForest::Order RouteForest::plan_order(AgentIndex agent, const AgentRoute& route) {
  GoalSequence goals = routes_.goals(agent, route);
  const PathOutcome outcome = low_level_.find(goals, {.others = &others_}, limits_, path_);
  if (outcome == PathOutcome::kStopped) return nullptr;
  if (outcome != PathOutcome::kFound)
    throw std::logic_error("internal error: a route of finite cost has no path");
  others_.add(path_);
  auto order = std::make_shared<AgentSequencing>();
  order->sequences.prefix = route.stops;
  order->goals.emplace(std::move(goals));
  order->path = PackedPath(problem_.instance.world(), path_);
  if (!problem_.instance.agent(agent).options.empty())
    order->visits = routes_.visits(agent, route.stops);
  return order;
}

}  // namespace grove::detail
