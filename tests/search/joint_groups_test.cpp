// SPDX-License-Identifier: MIT
#include "search/joint_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "search/brancher.h"
#include "search/feasibility.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/group_oracle.h"
#include "tests/search/root_fixture.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace joint_groups_test {

using ExcessBound = JointGroups::ExcessBound;
constexpr std::size_t kMaxPaths = 1500;

SearchOptions options_of(std::uint64_t seed) {
  SearchOptions options{Techniques::defaults(), seed, true};
  if (seed % 3 == 0) options.techniques = options.techniques.without(Technique::kStrongBranching);
  return options;
}

// A node up to five splits below the root of a tiny instance of any kind.
struct NodeBelowRoot : testing::RootFixture {
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
  int below(int bound) { return static_cast<int>(random() % static_cast<unsigned>(bound)); }

  std::mt19937_64 random;
};

// Returns the excess of the group, or `max_excess` + 1 if it is greater than `max_excess`. Returns
// nullopt if an agent has too many paths to enumerate.
std::optional<Cost> true_excess(NodeBelowRoot& s, const std::vector<AgentIndex>& group,
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

// With enough effort the result equals the excess found by exhaustive search. With little effort
// the result never exceeds that excess.
TEST(JointGroups, ExcessEqualsThatOfAnExhaustiveSearch) {
  int exact = 0, above = 0, interrupted = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(600));
       ++seed) {
    SCOPED_TRACE(seed);
    const auto tiny = seed % 2 == 0 ? fuzz::random_instance(seed) : fuzz::random_world(seed);
    const Instance instance = tiny.build();
    if (instance.agent_count() < 2) continue;
    Limits limits;
    const Problem problem(instance, limits);
    if (presolve_infeasibility(problem)) continue;
    NodeBelowRoot s(tiny, seed);
    std::vector<AgentIndex> group(s.all.begin(), s.all.end());
    std::shuffle(group.begin(), group.end(), s.random);
    group.resize(std::min<std::size_t>(group.size(), 2 + s.random() % 2));
    std::ranges::sort(group);
    const Cost slack = 1 + s.below(3);
    const auto truth = true_excess(s, group, static_cast<Time>(slack));
    if (!truth) continue;
    Tuning tuning;
    JointGroups groups(s.instance, tuning, s.planner);
    ExcessBound known;
    ASSERT_TRUE(groups.solve(s.view, group, slack, s.limits, known));
    ASSERT_EQ(known.excess, *truth);
    ASSERT_EQ(known.exact, *truth <= slack);
    ++(known.exact ? exact : above);
    tuning.joint_group_work = s.below(40);
    ExcessBound less;
    ASSERT_TRUE(groups.solve(s.view, group, slack, s.limits, less));
    ASSERT_LE(less.excess, *truth);
    if (less.exact) {
      ASSERT_EQ(less.excess, *truth);
    }
    interrupted += less.excess < *truth ? 1 : 0;
  }
  EXPECT_GT(exact, 100);
  EXPECT_GT(above, 20);
  EXPECT_GT(interrupted, 10);
}

}  // namespace joint_groups_test
}  // namespace grove::detail
