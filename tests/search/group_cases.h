// SPDX-License-Identifier: MIT
// Random nodes and groups of agents, and the excess of a group by exhaustive search.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "search/brancher.h"
#include "search/feasibility.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/group_oracle.h"
#include "tests/search/root_fixture.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail::testing {

inline constexpr std::size_t kMaxPaths = 1500;  // of an agent

inline SearchOptions options_of(std::uint64_t seed) {
  SearchOptions options{Techniques::defaults(), seed, true};
  if (seed % 3 == 0) options.techniques = options.techniques.without(Technique::kStrongBranching);
  return options;
}

// True if the instance has a group of agents, and its search begins with a tree.
inline bool has_groups(const Instance& instance) {
  if (instance.agent_count() < 2) return false;
  Limits limits;
  const Problem problem(instance, limits);
  return !presolve_infeasibility(problem);
}

// A node up to five splits below the root of a tiny instance.
struct NodeBelowRoot : RootFixture {
  NodeBelowRoot(const fuzz::TinyInstance& tiny, std::uint64_t seed)
      : RootFixture(seed % 5 == 0 ? tiny.build().without_following() : tiny.build(),
                    options_of(seed)),
        random(seed) {
    Brancher brancher(problem, options, planner, memory);
    for (int depth = below(6); depth > 0 && !view.conflict_free(); --depth) {
      std::vector<NodePtr> children;
      const auto outcome = brancher.branch(view, kInfiniteCost, {}, limits, children);
      if (outcome != Brancher::Outcome::kBranched || children.empty()) return;
      view.enter(children[below(static_cast<int>(children.size()))], all);
    }
  }
  // Two or three random agents, in ascending order.
  std::vector<AgentIndex> random_group() {
    std::vector<AgentIndex> group(all.begin(), all.end());
    std::shuffle(group.begin(), group.end(), random);
    group.resize(std::min<std::size_t>(group.size(), 2 + random() % 2));
    std::ranges::sort(group);
    return group;
  }
  int below(int bound) { return static_cast<int>(random() % static_cast<unsigned>(bound)); }

  std::mt19937_64 random;
};

// Returns the excess of the group, or `max_excess` + 1 if it is greater than `max_excess`. Returns
// nullopt if an agent has too many paths to enumerate.
inline std::optional<Cost> true_excess(NodeBelowRoot& s, const std::vector<AgentIndex>& group,
                                       Time max_excess) {
  std::vector<std::vector<oracle::PlacePath>> paths;
  Cost apart = 0;
  for (const AgentIndex agent : group) {
    const auto constraints = s.view.constraints(agent);
    auto all = oracle::paths_within(s.instance, agent, constraints,
                                    s.view.cost_of(agent) + max_excess, kMaxPaths);
    if (!all) return std::nullopt;
    apart += s.view.cost_of(agent);
    paths.push_back(std::move(*all));
  }
  const auto least = oracle::least_joint_cost(s.instance, paths);
  return least ? std::min<Cost>(*least - apart, max_excess + 1) : max_excess + 1;
}

// Calls test(node, group, slack, truth) for random groups of agents at random nodes, with the
// excess `truth` of the group by exhaustive search, or slack + 1 if it is greater than `slack`.
template <class Test>
void for_each_group(int rounds, Test test) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(fuzz_rounds(rounds)); ++seed) {
    SCOPED_TRACE(seed);
    const fuzz::TinyInstance tiny = fuzz::any_instance(seed);
    if (!has_groups(tiny.build())) continue;
    NodeBelowRoot s(tiny, seed);
    const std::vector<AgentIndex> group = s.random_group();
    const Cost slack = 1 + s.below(3);
    const auto truth = true_excess(s, group, static_cast<Time>(slack));
    if (truth) test(s, group, slack, *truth);
  }
}

}  // namespace grove::detail::testing
