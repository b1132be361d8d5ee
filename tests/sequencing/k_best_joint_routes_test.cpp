// SPDX-License-Identifier: MIT
// Compares the enumeration of joint routes, with each back end, with all combinations of routes.
#include "sequencing/k_best_joint_routes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "model/random.h"
#include "tests/support/clocks.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace k_best_joint_routes_test {

using Routes = std::vector<AgentRoute>;

// The shape of a random problem.
struct Shape {
  int agents = 2;
  int tasks = 0;                // shared by all agents
  int own = 0;                  // required stops of each agent
  int goals = 0;                // resources in which agents can end; 0: they end without one
  bool has_conditions = false;  // ends that require one of some stops
};

Time random_leg(Random& random) {
  return random.below(10) == 0 ? kNever : random.below(12);
}

std::vector<Time> random_legs(int count, Random& random) {
  std::vector<Time> legs;
  for (int i = 0; i < count; ++i) legs.push_back(random_leg(random));
  return legs;
}

RouteEnd random_end(int stops, Random& random) {
  return {.from_start = random_leg(random), .from_stops = random_legs(stops, random)};
}

AgentRoutes random_agent(const Shape& shape, Random& random) {
  AgentRoutes agent;
  for (int task = 0; task < shape.tasks; ++task)
    if (random.below(4) > 0) agent.tasks.push_back(task);
  for (int i = 0; i < shape.own; ++i) {
    agent.required |= bit(agent.stops());
    agent.tasks.push_back(-1);
  }
  const int n = agent.stops();
  agent.legs = CostMatrix::Matrix(n + 1, kNever);
  for (int from = 0; from <= n; ++from)
    for (int to = 0; to < n; ++to)
      if (from != to) agent.legs(from, to) = random_leg(random);
  for (int goal = 0; goal < shape.goals; ++goal)
    if (random.below(4) > 0) {
      agent.ends.push_back(random_end(n, random));
      agent.ends.back().resource = goal;
    }
  if (shape.goals == 0 || agent.ends.empty()) agent.ends.push_back(random_end(n, random));
  if (shape.has_conditions)
    for (int i = 0; i < n; ++i) {
      agent.ends.push_back(random_end(n, random));
      agent.ends.back().any_of = static_cast<StopSet>(1 + random.below((1 << n) - 1));
    }
  return agent;
}

JointRouteProblem random_problem(const Shape& shape, Random& random) {
  JointRouteProblem problem;
  problem.resources = shape.goals;
  for (int agent = 0; agent < shape.agents; ++agent)
    problem.agents.push_back(random_agent(shape, random));
  for (int task = 0; task < shape.tasks; ++task)
    problem.needs.push_back(1 + (random.below(3) == 0 ? 1 : 0));
  return problem;
}

// Appends all routes of finite cost that begin with `stops`.
void add_routes(const AgentRoutes& agent, const Sequence& stops, Routes& routes) {
  for (int end = 0; end < static_cast<int>(agent.ends.size()); ++end)
    if (route_cost(agent, {stops, end}) < kNever) routes.push_back({stops, end});
  for (int stop = 0; stop < agent.stops(); ++stop) {
    if (std::ranges::count(stops, stop) > 0) continue;
    Sequence longer = stops;
    longer.push_back(static_cast<Stop>(stop));
    add_routes(agent, longer, routes);
  }
}

bool is_joint(const JointRouteProblem& problem, const Routes& routes) {
  std::vector<int> visits(problem.needs.size());
  std::set<int> used;
  for (std::size_t i = 0; i < routes.size(); ++i) {
    const AgentRoutes& agent = problem.agents[i];
    const RouteEnd& end = agent.ends[static_cast<std::size_t>(routes[i].end)];
    for (const Stop stop : routes[i].stops)
      if (const int task = agent.tasks[stop]; task >= 0) ++visits[static_cast<std::size_t>(task)];
    if (end.resource >= 0 && !used.insert(end.resource).second) return false;
  }
  return visits == problem.needs;
}

void combine(const JointRouteProblem& problem, const std::vector<Routes>& of_agents, Cost cost,
             Routes& chosen, std::set<std::pair<Cost, Routes>>& all) {
  if (chosen.size() == of_agents.size()) {
    if (is_joint(problem, chosen)) all.emplace(cost, chosen);
    return;
  }
  const std::size_t agent = chosen.size();
  for (const AgentRoute& route : of_agents[agent]) {
    chosen.push_back(route);
    combine(problem, of_agents, cost + route_cost(problem.agents[agent], route), chosen, all);
    chosen.pop_back();
  }
}

std::set<std::pair<Cost, Routes>> all_joint_routes(const JointRouteProblem& problem) {
  std::vector<Routes> of_agents;
  for (const AgentRoutes& agent : problem.agents) add_routes(agent, {}, of_agents.emplace_back());
  std::set<std::pair<Cost, Routes>> all;
  Routes chosen;
  combine(problem, of_agents, 0, chosen, all);
  return all;
}

// Enumerates at most `count` joint routes, and checks all guarantees of KBestJointRoutes.
// Returns their number.
std::size_t expect_all(const JointRouteProblem& problem, std::unique_ptr<JointRouteSolver> solver,
                       std::size_t count) {
  const auto all = all_joint_routes(problem);
  const Limits limits;
  KBestJointRoutes best(problem, std::move(solver), limits);
  std::set<std::pair<Cost, Routes>> seen;
  auto expected = all.begin();
  while (seen.size() < count) {
    const Cost bound = best.lower_bound();
    const auto next = best.next();
    if (!next) break;
    EXPECT_LE(bound, next->cost);
    EXPECT_GE(best.lower_bound(), next->cost);
    EXPECT_NE(expected, all.end());
    if (expected == all.end()) break;
    EXPECT_EQ(next->cost, expected->first);
    EXPECT_TRUE(all.contains({next->cost, next->routes}));
    EXPECT_TRUE(seen.emplace(next->cost, next->routes).second) << "a joint route twice";
    ++expected;
  }
  EXPECT_EQ(seen.size(), std::min(count, all.size()));
  if (seen.size() < count) {
    EXPECT_EQ(best.lower_bound(), kInfiniteCost);
  }
  return seen.size();
}

Shape random_shape(Random& random) {
  Shape shape;
  shape.agents = 1 + random.below(3);
  shape.tasks = random.below(4);
  shape.own = random.below(shape.agents == 1 ? 3 : 2);
  shape.goals = random.below(4);
  shape.has_conditions = shape.tasks < 3 && random.below(3) == 0;
  return shape;
}

using MakeSolver = std::unique_ptr<JointRouteSolver> (*)(const JointRouteProblem&, const Limits&);

// Tests a back end on 200 random problems of shape(random). Returns the number of joint routes.
template <class ShapeOf>
std::size_t found_by(MakeSolver make, std::uint64_t seed, ShapeOf shape) {
  Random random(seed);
  std::size_t found = 0;
  for (int round = 0; round < testing::fuzz_rounds(200); ++round) {
    SCOPED_TRACE(round);
    const JointRouteProblem problem = random_problem(shape(random), random);
    const Limits limits;
    auto solver = make(problem, limits);
    EXPECT_TRUE(solver);
    if (solver) found += expect_all(problem, std::move(solver), 3000);
  }
  return found;
}

TEST(KBestJointRoutes, TablesEqualAllCombinations) {
  EXPECT_GT(found_by(make_joint_route_tables, 1, random_shape), 2000u);
}

TEST(KBestJointRoutes, MatchingEqualsAllCombinations) {
  const auto without_tasks = [](Random& random) {
    const int agents = 1 + random.below(3);
    const int own = random.below(3);
    return Shape{.agents = agents, .own = own, .goals = 1 + random.below(4)};
  };
  EXPECT_GT(found_by(make_joint_route_matching, 2, without_tasks), 400u);
}

TEST(KBestJointRoutes, IntegerProgramEqualsAllCombinations) {
  if (!is_built(RtspBackend::kCbc)) GTEST_SKIP() << "Grove was built without CBC";
  Random random(3);
  std::size_t found = 0;
  for (int round = 0; round < testing::fuzz_rounds(60); ++round) {
    SCOPED_TRACE(round);
    const JointRouteProblem problem = random_problem(random_shape(random), random);
    const Limits limits;
    found += expect_all(problem, make_joint_route_solver(RtspBackend::kCbc, problem, limits), 25);
  }
  EXPECT_GT(found, 100);
}

// A cycle of two stops without a leg from the start costs less than every route.
TEST(KBestJointRoutes, IntegerProgramVisitsNoCyclesOutsideTheRoute) {
  if (!is_built(RtspBackend::kCbc)) GTEST_SKIP() << "Grove was built without CBC";
  JointRouteProblem problem;
  AgentRoutes& agent = problem.agents.emplace_back();
  agent.tasks = {0, 1};
  agent.legs = CostMatrix::Matrix(3, 100);
  agent.legs(0, 1) = agent.legs(1, 0) = 0;
  agent.ends.push_back({.from_start = 0, .from_stops = {100, 100}});
  problem.needs = {1, 1};
  const Limits limits;
  const auto answer =
      make_joint_route_solver(RtspBackend::kCbc, problem, limits)->best(JointRouteClass());
  ASSERT_EQ(answer.kind, JointRouteAnswer::Kind::kExact);
  EXPECT_EQ(answer.route.cost, 200);
}

// There are too many combinations for a brute force.
TEST(KBestJointRoutes, BackEndsAgreeOnLargerProblems) {
  if (!is_built(RtspBackend::kCbc)) GTEST_SKIP() << "Grove was built without CBC";
  Random random(4);
  for (int round = 0; round < testing::fuzz_rounds(4); ++round) {
    SCOPED_TRACE(round);
    const Shape shape{.agents = 6, .tasks = 5, .own = 1, .goals = 6};
    const JointRouteProblem problem = random_problem(shape, random);
    const Limits limits;
    auto tables = make_joint_route_tables(problem, limits);
    ASSERT_TRUE(tables);
    KBestJointRoutes by_tables(problem, std::move(tables), limits);
    KBestJointRoutes by_program(
        problem, make_joint_route_solver(RtspBackend::kCbc, problem, limits), limits);
    for (int i = 0; i < 3; ++i) {
      const auto a = by_tables.next();
      const auto b = by_program.next();
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) break;
      EXPECT_EQ(a->cost, b->cost);
    }
  }
}

TEST(KBestJointRoutes, KeepsItsBoundAtALimit) {
  Random random(7);
  const JointRouteProblem problem = random_problem({.agents = 3, .tasks = 2}, random);
  Limits limits;
  KBestJointRoutes best(problem, make_joint_route_solver(RtspBackend::kAuto, problem, limits),
                        limits);
  const auto first = best.next();
  ASSERT_TRUE(first);
  limits.set_deadline(testing::kPast);
  EXPECT_FALSE(best.next());
  EXPECT_GE(best.lower_bound(), first->cost);
  EXPECT_LT(best.lower_bound(), kInfiniteCost);
}

// Problems that are too large for tables and matchings stop the run instead of a wrong answer.
TEST(KBestJointRoutes, TooLargeProblemStopsTheRun) {
  Random random(6);
  const JointRouteProblem problem = random_problem({.agents = 2, .tasks = 30}, random);
  const Limits limits;
  EXPECT_EQ(make_joint_route_tables(problem, limits), nullptr);
  EXPECT_EQ(make_joint_route_matching(problem, limits), nullptr);
  KBestJointRoutes best(problem, make_joint_route_solver(RtspBackend::kHeldKarp, problem, limits),
                        limits);
  EXPECT_FALSE(best.next());
  EXPECT_LT(best.lower_bound(), kInfiniteCost);
  EXPECT_EQ(limits.reason(), StopReason::kMemory);
}

}  // namespace k_best_joint_routes_test
}  // namespace grove::detail
