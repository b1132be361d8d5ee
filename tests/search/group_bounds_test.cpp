// SPDX-License-Identifier: MIT
// Tests group bounds that are sent together with nodes: the receiver expands the nodes to the same
// children with less effort.
#include "search/group_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "search/expander.h"
#include "search/single_tree.h"
#include "tests/primal/crowd.h"

namespace grove::detail {
namespace group_bounds_test {

constexpr Cost kSlack = 20;

// A search whose first nodes have been expanded by one expander.
struct PartialSearch {
  explicit PartialSearch(std::uint64_t seed)
      : instance(testing::random_crowd(
            {.size = 10, .obstacles = 25, .agents = 12, .tasks = 14, .no_destination = 10}, seed)),
        problem(instance, limits),
        stops(instance, problem.distances),
        forest(problem, stops, pool, limits),
        root(forest.next_root()),
        cutoff(root->cost() + kSlack),
        expander(problem, stops, {Techniques::defaults(), 0}) {
    nodes.push_back(root);
    for (std::size_t i = 0; i < nodes.size() && nodes.size() < 16; ++i)
      for (NodePtr& child : expand(expander, nodes[i]).children) nodes.push_back(std::move(child));
  }

  Expansion expand(Expander& by, const NodePtr& node) const {
    Expansion expansion;
    do {
      expansion = by.expand(node, cutoff, limits);
      by.publish();
    } while (expansion.unfinished);
    return expansion;
  }
  Limits limits;
  Instance instance;
  Problem problem;
  AgentStopsCache stops;
  NodePool pool;
  SingleTree forest;
  NodePtr root;
  Cost cutoff;
  std::vector<NodePtr> nodes;
  Expander expander;
};

struct Outcome {
  bool has_plan;
  std::vector<std::pair<Cost, Cost>> children;  // cost and bound of each
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcome(const Expansion& expansion) {
  Outcome all{expansion.plan.has_value(), {}};
  for (const NodePtr& child : expansion.children)
    all.children.emplace_back(child->cost(), child->bound());
  return all;
}

TEST(GroupBound, ReceiverExpandsTheSameWithLessWork) {
  int received = 0;
  std::int64_t pair_expansions_informed = 0;
  std::int64_t pair_expansions_uninformed = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    PartialSearch s(seed);
    const auto group_bounds = group_bounds_of(s.nodes, *s.expander.memory());
    received += static_cast<int>(group_bounds.size());
    for (const NodePtr& node : s.nodes) {
      AgentStopsCache stops = s.stops;
      Expander informed(s.problem, stops, {Techniques::defaults(), 0});
      merge(group_bounds, s.nodes, *informed.memory());
      Expander uninformed(s.problem, stops, {Techniques::defaults(), 0});
      const Outcome there = outcome(s.expand(informed, node));
      EXPECT_EQ(there, outcome(s.expand(s.expander, node))) << "seed " << seed;
      s.expand(uninformed, node);
      pair_expansions_informed += informed.counts().reported[Counter::kPairExpansions];
      pair_expansions_uninformed += uninformed.counts().reported[Counter::kPairExpansions];
    }
  }
  EXPECT_GT(received, 300) << "too few group bounds for a test";
  EXPECT_LT(2 * pair_expansions_informed, pair_expansions_uninformed);
}

TEST(GroupBound, HoldsExactlyTheEntriesOfTheCache) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const PartialSearch s(seed);
    const auto group_bounds = group_bounds_of(s.nodes, *s.expander.memory());
    SharedCache other;
    merge(group_bounds, s.nodes, other);
    // Each cache numbers subproblems in order of first occurrence, so only the bounds per node can
    // be compared.
    const auto again = group_bounds_of(s.nodes, other);
    ASSERT_EQ(again.size(), group_bounds.size());
    for (std::size_t i = 0; i < group_bounds.size(); ++i) {
      EXPECT_EQ(again[i].node, group_bounds[i].node);
      EXPECT_EQ(again[i].agents, group_bounds[i].agents);
      EXPECT_EQ(again[i].known.excess, group_bounds[i].known.excess);
      EXPECT_EQ(again[i].known.exact, group_bounds[i].known.exact);
    }
    SharedCache empty;
    EXPECT_TRUE(group_bounds_of(s.nodes, empty).empty());
  }
}

TEST(GroupBound, IsIgnoredForNodesThatWereNotTransferred) {
  const PartialSearch s(1);
  std::vector<NodePtr> nodes = s.nodes;
  const auto group_bounds = group_bounds_of(s.nodes, *s.expander.memory());
  ASSERT_FALSE(group_bounds.empty());
  std::ranges::fill(nodes, NodePtr());
  SharedCache other;
  merge(group_bounds, nodes, other);
  EXPECT_EQ(other.excesses.bytes(), 0);
}

TEST(GroupBound, RefusesInvalidBounds) {
  const PartialSearch s(1);
  const auto refuses = [&](const GroupBound& group_bound) {
    SharedCache memory;
    EXPECT_THROW(merge(std::vector{group_bound}, s.nodes, memory), std::invalid_argument);
  };
  const auto place = static_cast<std::int32_t>(s.nodes.size());
  refuses({place, {0, 1}, {1, false, 1}});
  refuses({-1, {0, 1}, {1, false, 1}});
  refuses({0, {}, {1, false, 1}});
  refuses({0, {3}, {1, false, 1}});
  refuses({0, {1, 0}, {1, false, 1}});
  refuses({0, {1, 1}, {1, false, 1}});
  refuses({0, {-1, 1}, {1, false, 1}});
  refuses({0, {0, 12}, {1, false, 1}});
  refuses({0, {0, 1}, {-1, false, 1}});
}

}  // namespace group_bounds_test
}  // namespace grove::detail
