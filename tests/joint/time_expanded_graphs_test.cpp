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

namespace grove::detail {
namespace timed_graphs_test {

using oracle::Way;
using Demands = std::vector<Constraint>;
constexpr std::size_t kMostWays = 1500;
constexpr std::size_t kPlenty = 30'000;
constexpr std::size_t kMostBytes = std::size_t{1} << 28;

// A tiny instance of any kind and what can be asked of its agents.
class Fuzzer {
 public:
  explicit Fuzzer(std::uint64_t seed)
      : random_(seed),
        instance_(seed % 5 == 0 ? made(seed).without_following() : made(seed)),
        distances_(instance_),
        chains_(instance_.world()),
        graphs_(instance_.world()) {}

  const Instance& instance() const { return instance_; }
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }

  AgentGraph graph(AgentIndex agent, const Demands& demands, Time most) {
    AgentStops stops(instance_, distances_, agent);
    SequenceStages goals(stops, SequenceClass());
    AgentGraph graph;
    EXPECT_EQ(graphs_.make(goals, demands, most, kPlenty, Limits(), graph),
              TimeExpandedGraphs::Outcome::kMade);
    return graph;
  }

  // Something that matters to who went this way.
  Constraint demand(const Way& way) {
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
        if (chains_.count() > 0) return traversal(t);
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
  static Instance made(std::uint64_t seed) {
    return (seed % 2 == 0 ? fuzz::random_instance(seed) : fuzz::random_world(seed)).build();
  }
  Constraint traversal(Time t) {
    const auto row = chains_.places(below(chains_.count()));
    const bool front = below(2) == 0;
    return {front ? row.front() : row.back(), front ? row[1] : row[row.size() - 2], 0, t + below(5),
            ConstraintKind::kNoTraversal};
  }

  std::mt19937_64 random_;
  const Instance instance_;
  const DistanceFields distances_;
  const Corridors chains_;
  TimeExpandedGraphs graphs_;
};

// An agent, what is asked of it, and all its ways up to some cost, of which there are some.
struct Member {
  AgentIndex agent;
  Demands demands;
  Time most = 0;
  std::vector<Way> ways;
};

std::optional<Member> member(Fuzzer& fuzzer, AgentIndex agent, Time delta_f) {
  Member m{.agent = agent, .demands = {}, .most = 0, .ways = {}};
  for (Time most = 0; m.ways.empty(); ++most) {
    const auto ways = oracle::ways_within(fuzzer.instance(), agent, m.demands, most, kMostWays);
    if (!ways || most > 12) return std::nullopt;
    m.ways = *ways;
  }
  for (int n = fuzzer.below(5); n > 0; --n)
    m.demands.push_back(fuzzer.demand(m.ways[fuzzer.below(static_cast<int>(m.ways.size()))]));
  m.most = static_cast<Time>(m.ways.front().size()) - 1 + delta_f;
  const auto ways = oracle::ways_within(fuzzer.instance(), agent, m.demands, m.most, kMostWays);
  if (!ways) return std::nullopt;
  m.ways = *ways;
  return m;
}

// What an agent costs alone under its demands is what the cheapest of all its ways costs.
TEST(TimeExpandedGraphs, KnowTheLeastCostUnderDemands) {
  int some = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(300));
       ++seed) {
    SCOPED_TRACE(seed);
    Fuzzer fuzzer(seed);
    for (AgentIndex agent = 0; agent < fuzzer.instance().agent_count(); ++agent) {
      const auto m = member(fuzzer, agent, 3);
      if (!m) continue;
      const AgentGraph graph = fuzzer.graph(agent, m->demands, m->most);
      ASSERT_EQ(graph.count() == 0, m->ways.empty());
      ++(m->ways.empty() ? none : some);
      if (m->ways.empty()) continue;
      ASSERT_EQ(graph.to_go(AgentGraph::start()) + 1, std::ssize(m->ways.front()));
    }
  }
  EXPECT_GT(some, 300);
  EXPECT_GT(none, 10);
}

// Joint search of some agents under demands finds what trying all their ways finds, and its bound
// is never above that.
TEST(TimeExpandedGraphs, LetJointSearchFindTheOptimumUnderDemands) {
  int found = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(500));
       ++seed) {
    SCOPED_TRACE(seed);
    Fuzzer fuzzer(seed);
    std::vector<std::vector<Way>> ways;
    std::vector<AgentGraph> graphs;
    for (AgentIndex agent = 0; agent < std::min(fuzzer.instance().agent_count(), 3); ++agent) {
      const auto m = member(fuzzer, agent, 2 + fuzzer.below(2));
      if (!m) break;
      ways.push_back(m->ways);
      graphs.push_back(fuzzer.graph(agent, m->demands, m->most));
    }
    if (ways.size() < 2) continue;
    const auto least = oracle::least_together(fuzzer.instance(), ways);
    EpeaStar search(fuzzer.instance(), std::move(graphs), kMostBytes);
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

TEST(TimeExpandedGraphs, AreNotMadeTooLarge) {
  Fuzzer fuzzer(2);
  const DistanceFields distances(fuzzer.instance());
  AgentStops stops(fuzzer.instance(), distances, 0);
  SequenceStages goals(stops, SequenceClass());
  AgentGraph graph;
  TimeExpandedGraphs graphs(fuzzer.instance().world());
  EXPECT_EQ(graphs.make(goals, Demands(), 40, 10, Limits(), graph),
            TimeExpandedGraphs::Outcome::kTooLarge);
  EXPECT_EQ(graph.count(), 0u);
}

}  // namespace timed_graphs_test
}  // namespace grove::detail
