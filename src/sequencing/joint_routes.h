// SPDX-License-Identifier: MIT
// Joint routes: sequences of visits of several agents that share stops, and the ends of these
// sequences. (The problem is a multi-depot vehicle routing problem in which each task is visited a
// given number of times.)
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "model/grid.h"
#include "model/omega.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// A way in which an agent can end its route. A route may end so only if it visits one of the stops
// `any_of` (empty: no condition).
struct RouteEnd {
  static constexpr int kNoResource = -1;
  // Two agents must not use the same resource, for example the same destination.
  int resource = kNoResource;
  Time from_start = kNever;           // cost of the last leg, for a route without stops
  std::vector<Time> from_stops = {};  // the same, by last stop
  StopSet any_of = 0;
};

// The possible routes of one agent. Stops are numbered 0, ..., n - 1.
struct AgentRoutes {
  std::vector<int> tasks;  // by stop: the shared task that a visit counts for; -1: none
  StopSet required = 0;    // stops that are part of every route
  // (n+1) x (n+1); entry (i, j) is the cost of the leg from stop i to stop j, row n the start.
  // Column n is not used.
  CostMatrix::Matrix legs;
  std::vector<RouteEnd> ends;

  int stops() const { return static_cast<int>(tasks.size()); }
};

// In a joint route each agent has one route, agents use different resources, and each shared task
// gets exactly as many visits as it needs.
struct JointRouteProblem {
  std::vector<AgentRoutes> agents;
  std::vector<int> needs;  // by shared task, at least 1
  int resources = 0;
};

struct AgentRoute {
  Sequence stops;
  int end = 0;  // position in AgentRoutes::ends
  friend bool operator==(const AgentRoute&, const AgentRoute&) = default;
  friend std::strong_ordering operator<=>(const AgentRoute& a, const AgentRoute& b);
};

struct JointRoute {
  Cost cost = 0;                   // sum of the costs of the routes
  std::vector<AgentRoute> routes;  // by agent
};

// The joint routes in which the first agents have the routes `fixed`. The route of the next agent
// begins with `prefix`, and its next decision is not forbidden: neither to continue to a stop of
// `forbidden_stops` nor to end immediately by one of `forbidden_ends`. The routes of all agents
// after it are free. The default contains every joint route.
struct JointRouteClass {
  std::vector<AgentRoute> fixed;
  Sequence prefix;
  StopSet forbidden_stops = 0;
  std::vector<int> forbidden_ends;

  int next_agent() const { return static_cast<int>(fixed.size()); }
};

// The set of the stops of a sequence.
StopSet stops_of(const Sequence& sequence);
// True if a route that visits exactly `visited` may end so, apart from the costs of legs.
bool may_end(const AgentRoutes& agent, const RouteEnd& end, StopSet visited);
// The cost of the legs of `stops`, from the start; kNever if a leg does not exist.
Time legs_cost(const AgentRoutes& agent, const Sequence& stops);
// The cost of a route; kNever if it is not a route of the agent.
Time route_cost(const AgentRoutes& agent, const AgentRoute& route);
// The cost of a route that ends so directly after the stops; `last`: the last stop or, without
// stops, AgentRoutes::stops().
inline Time end_cost(const AgentRoutes& agent, const RouteEnd& end, int last) {
  return last == agent.stops() ? end.from_start : end.from_stops[static_cast<std::size_t>(last)];
}

}  // namespace grove::detail
