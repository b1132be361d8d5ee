// SPDX-License-Identifier: MIT
#include "joint/time_expanded_graphs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "joint/epea_star.h"
#include "model/omega.h"
#include "planning/corridors.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/group_oracle.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace time_expanded_graphs_test {

using oracle::PlacePath;
using Constraints = std::vector<Constraint>;
constexpr std::size_t kMaxWays = 1500;
constexpr std::size_t kPlenty = 30'000;
constexpr std::size_t kMaxBytes = std::size_t{1} << 28;

// A tiny random instance of any kind, with random constraints on its agents.
class Fuzzer {
 public:
  explicit Fuzzer(std::uint64_t seed)
      : random_(seed),
        instance_(seed % 5 == 0 ? made(seed).without_following() : made(seed)),
        distances_(instance_),
        corridors_(instance_.world()),
        graphs_(instance_.world()) {}

  const Instance& instance() const { return instance_; }
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }

  AgentGraph graph(AgentIndex agent, const Constraints& constraints, Time max_cost) {
    AgentStops stops(instance_, distances_, agent);
    SequenceStages goals(stops, SequenceClass());
    AgentGraph graph;
    EXPECT_EQ(graphs_.make(goals, constraints, max_cost, kPlenty, Limits(), graph),
              TimeExpandedGraphs::Outcome::kMade);
    return graph;
  }

  // Returns a constraint that `way` is likely to violate.
  Constraint constraint(const PlacePath& way) {
    const auto cost = static_cast<Time>(way.size()) - 1;
    const Time t = below(cost + 2);
    const Place here = way[static_cast<std::size_t>(std::min(t, cost))];
    const Place before = way[static_cast<std::size_t>(std::clamp(t - 1, 0, cost))];
    switch (below(8)) {
      case 0:
        return {way.back(), kNoPlace, 0, cost - 1 + below(3), ConstraintKind::kNoRestBy};
      case 1:
        return {way.back(), kNoPlace, 0, cost - 1 + below(4), ConstraintKind::kRestBy};
      case 2:
      case 3:
        if (corridors_.count() > 0) return traversal(t);
        [[fallthrough]];
      case 4:
      case 5:
        if (before != here) return {here, before, t - below(2), t + below(3)};
        [[fallthrough]];
      default:
        return {here, kNoPlace, std::max(t, 1), std::max(t, 1) + below(3)};
    }
  }

 private:
  static Instance made(std::uint64_t seed) { return fuzz::any_instance(seed).build(); }
  Constraint traversal(Time t) {
    const auto row = corridors_.places(below(corridors_.count()));
    const bool front = below(2) == 0;
    return {front ? row.front() : row.back(), front ? row[1] : row[row.size() - 2], 0, t + below(5),
            ConstraintKind::kNoTraversal};
  }

  std::mt19937_64 random_;
  const Instance instance_;
  const DistanceFields distances_;
  const Corridors corridors_;
  TimeExpandedGraphs graphs_;
};

// An agent with its constraints and all its paths that satisfy them and cost at most `max_cost`.
struct Member {
  AgentIndex agent;
  Constraints constraints;
  Time max_cost = 0;
  std::vector<PlacePath> ways;
};

std::optional<Member> member(Fuzzer& fuzzer, AgentIndex agent, Time delta_f) {
  Member m{.agent = agent, .constraints = {}, .max_cost = 0, .ways = {}};
  for (Time max_cost = 0; m.ways.empty(); ++max_cost) {
    const auto ways =
        oracle::paths_within(fuzzer.instance(), agent, m.constraints, max_cost, kMaxWays);
    if (!ways || max_cost > 12) return std::nullopt;
    m.ways = *ways;
  }
  for (int n = fuzzer.below(5); n > 0; --n)
    m.constraints.push_back(
        fuzzer.constraint(m.ways[fuzzer.below(static_cast<int>(m.ways.size()))]));
  m.max_cost = static_cast<Time>(m.ways.front().size()) - 1 + delta_f;
  const auto ways =
      oracle::paths_within(fuzzer.instance(), agent, m.constraints, m.max_cost, kMaxWays);
  if (!ways) return std::nullopt;
  m.ways = *ways;
  return m;
}

// The least cost of an agent under its constraints is the cost of the cheapest enumerated path.
TEST(TimeExpandedGraphs, HaveTheLeastCostUnderConstraints) {
  int some = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(300));
       ++seed) {
    SCOPED_TRACE(seed);
    Fuzzer fuzzer(seed);
    for (AgentIndex agent = 0; agent < fuzzer.instance().agent_count(); ++agent) {
      const auto m = member(fuzzer, agent, 3);
      if (!m) continue;
      const AgentGraph graph = fuzzer.graph(agent, m->constraints, m->max_cost);
      ASSERT_EQ(graph.count() == 0, m->ways.empty());
      ++(m->ways.empty() ? none : some);
      if (m->ways.empty()) continue;
      ASSERT_EQ(graph.to_go(AgentGraph::start()) + 1, std::ssize(m->ways.front()));
    }
  }
  EXPECT_GT(some, 300);
  EXPECT_GT(none, 10);
}

// Joint search for several agents under constraints finds the same optimum as enumeration, and its
// bound never exceeds this optimum.
TEST(TimeExpandedGraphs, LetJointSearchFindOptimumUnderConstraints) {
  int found = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(500));
       ++seed) {
    SCOPED_TRACE(seed);
    Fuzzer fuzzer(seed);
    std::vector<std::vector<PlacePath>> ways;
    std::vector<AgentGraph> graphs;
    for (AgentIndex agent = 0; agent < std::min(fuzzer.instance().agent_count(), 3); ++agent) {
      const auto m = member(fuzzer, agent, 2 + fuzzer.below(2));
      if (!m) break;
      ways.push_back(m->ways);
      graphs.push_back(fuzzer.graph(agent, m->constraints, m->max_cost));
    }
    if (ways.size() < 2) continue;
    const auto least = oracle::least_joint_cost(fuzzer.instance(), ways);
    EpeaStar search(fuzzer.instance(), std::move(graphs), kMaxBytes);
    auto outcome = EpeaStar::Outcome::kWorking;
    while (outcome == EpeaStar::Outcome::kWorking) {
      outcome = search.run(3, kInfiniteCost, {});
      ASSERT_LE(search.lower_bound(), least.value_or(kInfiniteCost));
    }
    ASSERT_EQ(outcome, EpeaStar::Outcome::kEnded);
    ASSERT_EQ(search.lower_bound(), least.value_or(kInfiniteCost));
    ASSERT_EQ(search.paths().has_value(), least.has_value());
    ++(least ? found : none);
    if (!least) continue;
    Cost cost = 0;
    for (const Path& path : *search.paths()) cost += std::ssize(path) - 1;
    ASSERT_EQ(cost, *least);
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(none, 10);
}

TEST(TimeExpandedGraphs, AreRefusedAboveTheNodeLimit) {
  Fuzzer fuzzer(2);
  const DistanceFields distances(fuzzer.instance());
  AgentStops stops(fuzzer.instance(), distances, 0);
  SequenceStages goals(stops, SequenceClass());
  AgentGraph graph;
  TimeExpandedGraphs graphs(fuzzer.instance().world());
  EXPECT_EQ(graphs.make(goals, Constraints(), 40, 10, Limits(), graph),
            TimeExpandedGraphs::Outcome::kTooLarge);
  EXPECT_EQ(graph.count(), 0u);
}

TEST(TimeExpandedGraphs, AreRefusedIfTheCostsToGoWouldBeTooLarge) {
  std::vector<Position> tasks;
  for (int i = 1; i < 24; ++i) tasks.push_back({i % 5, i / 5});
  const Instance instance = testing::instance_of({".....", ".....", ".....", ".....", "....."},
                                                 {{{0, 0}, Position{4, 4}, tasks}});
  const DistanceFields distances(instance);
  AgentStops stops(instance, distances, 0);
  SequenceStages goals(stops, SequenceClass());
  AgentGraph graph;
  TimeExpandedGraphs graphs(instance.world());
  EXPECT_EQ(graphs.make(goals, Constraints(), 80, kPlenty, Limits(), graph),
            TimeExpandedGraphs::Outcome::kTooLarge);
}

}  // namespace time_expanded_graphs_test
}  // namespace grove::detail
