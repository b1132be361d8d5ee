// SPDX-License-Identifier: MIT
// What is told about nodes is what was found out, and whoever is told expands them alike with less
// work.
#include "search/group_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "search/expander.h"
#include "search/single_tree.h"
#include "tests/primal/crowd.h"

namespace grove::detail {
namespace findings_test {

constexpr Cost kSlack = 20;

// A search that one expander has made some way into.
struct Begun {
  explicit Begun(std::uint64_t seed)
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
  std::vector<std::pair<Cost, Cost>> children;  // cost and bound
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcome(const Expansion& expansion) {
  Outcome all{expansion.plan.has_value(), {}};
  for (const NodePtr& child : expansion.children)
    all.children.emplace_back(child->cost(), child->bound());
  return all;
}

TEST(Findings, WhoeverIsToldExpandsTheSameWithLessWork) {
  int told = 0;
  std::int64_t pair_expansions_of_told = 0;
  std::int64_t pair_expansions_of_ignorant = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Begun s(seed);
    const auto findings = group_bounds_of(s.nodes, *s.expander.memory());
    told += static_cast<int>(findings.size());
    for (const NodePtr& node : s.nodes) {
      AgentStopsCache stops = s.stops;
      Expander of_told(s.problem, stops, {Techniques::defaults(), 0});
      merge(findings, s.nodes, *of_told.memory());
      Expander ignorant(s.problem, stops, {Techniques::defaults(), 0});
      const Outcome there = outcome(s.expand(of_told, node));
      EXPECT_EQ(there, outcome(s.expand(s.expander, node))) << "seed " << seed;
      s.expand(ignorant, node);
      pair_expansions_of_told += of_told.counts().pair_expansions;
      pair_expansions_of_ignorant += ignorant.counts().pair_expansions;
    }
  }
  EXPECT_GT(told, 300) << "too little was found out to be a test";
  EXPECT_LT(2 * pair_expansions_of_told, pair_expansions_of_ignorant);
}

TEST(Findings, SayWhatTheMemoryKnowsAndNothingElse) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Begun s(seed);
    const auto findings = group_bounds_of(s.nodes, *s.expander.memory());
    SharedCache other;
    merge(findings, s.nodes, other);
    // Both number situations as they come up, so only what is said of the nodes can be compared.
    const auto again = group_bounds_of(s.nodes, other);
    ASSERT_EQ(again.size(), findings.size());
    for (std::size_t i = 0; i < findings.size(); ++i) {
      EXPECT_EQ(again[i].node, findings[i].node);
      EXPECT_EQ(again[i].agents, findings[i].agents);
      EXPECT_EQ(again[i].known.excess, findings[i].known.excess);
      EXPECT_EQ(again[i].known.exact, findings[i].known.exact);
    }
    SharedCache empty;
    EXPECT_TRUE(group_bounds_of(s.nodes, empty).empty());
  }
}

TEST(Findings, AboutANodeThatIsNotTakenOverAreIgnored) {
  const Begun s(1);
  std::vector<NodePtr> nodes = s.nodes;
  const auto findings = group_bounds_of(s.nodes, *s.expander.memory());
  ASSERT_FALSE(findings.empty());
  std::ranges::fill(nodes, NodePtr());
  SharedCache other;
  merge(findings, nodes, other);
  EXPECT_EQ(other.excesses.bytes(), 0);
}

TEST(Findings, RefusesWhatCannotBe) {
  const Begun s(1);
  const auto refuses = [&](const GroupBound& finding) {
    SharedCache memory;
    EXPECT_THROW(merge(std::vector{finding}, s.nodes, memory), std::invalid_argument);
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

}  // namespace findings_test
}  // namespace grove::detail
