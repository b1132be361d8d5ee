// SPDX-License-Identifier: MIT
#include "search/expander.h"

#include <gtest/gtest.h>

#include <array>
#include <deque>

#include "search/sequence_forest.h"
#include "search/single_tree.h"
#include "tests/primal/crowd.h"
#include "tests/support/clocks.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace expander_test {

using testing::AgentSpec;

// The root of an instance's first tree, with an expander.
struct Search {
  Search(const std::vector<std::string>& rows, const std::vector<AgentSpec>& agents)
      : instance(testing::instance_of(rows, agents)),
        problem(instance, limits),
        forest(problem, pool, RtspBackend::kAuto, limits),
        stops(instance, problem.distances),
        expander(problem, stops, {Techniques(), 0}),
        root(forest.next_root()) {}

  Limits limits;
  Instance instance;
  Problem problem;
  NodePool pool;
  SequenceForest forest;
  AgentStopsCache stops;
  Expander expander;
  NodePtr root;
};

TEST(Expander, TurnsAConflictFreeNodeIntoItsPlan) {
  Search s({"....", "...."}, {{{0, 0}, Position{3, 0}, {{2, 0}}}, {{0, 1}, Position{3, 1}}});
  const Expansion expansion = s.expander.expand(s.root, kInfiniteCost, s.limits);
  ASSERT_TRUE(expansion.plan);
  EXPECT_TRUE(expansion.children.empty());
  EXPECT_EQ(expansion.plan->cost, s.root->cost());
  EXPECT_EQ(expansion.plan->agents[0].path, Path({0, 1, 2, 3}));
  EXPECT_EQ(expansion.plan->agents[0].sequence, std::vector<TaskIndex>({0}));
}

TEST(Expander, MakesOneChildPerAgentWithOneConstraintEach) {
  // Two agents meet head-on in a corridor with a bay; each of them has to give way in one child.
  Search s({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{4, 0}, Position{0, 0}}});
  const Expansion expansion = s.expander.expand(s.root, kInfiniteCost, s.limits);
  ASSERT_EQ(expansion.children.size(), 2u);
  EXPECT_FALSE(expansion.plan);
  for (const NodePtr& child : expansion.children) {
    EXPECT_GT(child->cost(), s.root->cost());
    std::vector<Constraint> on_first;
    std::vector<Constraint> on_second;
    child->constraints(0, on_first);
    child->constraints(1, on_second);
    ASSERT_EQ(on_first.size() + on_second.size(), 1u);
    const AgentIndex agent = on_first.empty() ? 1 : 0;
    const Constraint c = on_first.empty() ? on_second[0] : on_first[0];
    std::vector<Path> paths;
    child->paths(s.problem, paths);
    EXPECT_EQ(c.cell, 2);
    EXPECT_NE(paths[agent][c.begin], c.cell);
  }
}

// The memory of nodes must not depend on which expander last expanded a node, because memory limits
// include it.
TEST(Expander, HoldsNoNodeBetweenExpansions) {
  Search s({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{4, 0}, Position{0, 0}}});
  const std::size_t before = s.pool.bytes();
  NodePtr node = s.root;
  for (int i = 0; i < 3 && node; ++i) {
    Expansion expansion = s.expander.expand(node, kInfiniteCost, s.limits);
    node = expansion.children.empty() ? nullptr : expansion.children.front();
  }
  ASSERT_GT(s.pool.bytes(), before);
  node = nullptr;
  EXPECT_EQ(s.pool.bytes(), before);
}

TEST(Expander, BoundsOfChildrenAreAtLeastTheParents) {
  // The second agent rests on cell 2. A constraint on this cell at the time of the conflict makes
  // it leave and return. The first agent has no alternative path, so in its child it waits.
  Search s({"...."}, {{{0, 0}, Position{1, 0}}, {{3, 0}, Position{2, 0}, {{1, 0}}}});
  const Expansion expansion = s.expander.expand(s.root, kInfiniteCost, s.limits);
  ASSERT_FALSE(expansion.children.empty());
  for (const NodePtr& child : expansion.children) EXPECT_GE(child->bound(), s.root->bound());
}

TEST(Expander, StopsWithoutChildrenAtALimit) {
  Search s({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{4, 0}, Position{0, 0}}});
  s.limits.set_deadline(testing::kPast);
  const Expansion expansion = s.expander.expand(s.root, kInfiniteCost, s.limits);
  EXPECT_TRUE(expansion.stopped);
  EXPECT_TRUE(expansion.children.empty());
  EXPECT_FALSE(expansion.plan);
}

// The pairs at the root of this dense instance take more effort than a single call of expand() is
// allowed.
TEST(Expander, BoundDoesNotDependOnTheNumberOfCalls) {
  const Instance instance =
      testing::random_crowd({.size = 20, .obstacles = 30, .agents = 60, .tasks = 120}, 3);
  const Limits limits;
  const Problem problem(instance, limits);
  AgentStopsCache stops(instance, problem.distances);
  NodePool pool;
  SingleTree forest(problem, stops, pool, limits);
  const NodePtr root = forest.next_root();

  int calls = 0;
  Expansion in_parts;
  Expander expander(problem, stops, {Techniques::defaults(), 0});
  do {
    in_parts = expander.expand(root, kInfiniteCost, limits);
    expander.publish();
    ++calls;
  } while (in_parts.unfinished);
  EXPECT_GT(calls, 2);

  // With a shared cache that succeeds another one, an expander leaves nothing to a later call.
  Expander other(problem, stops, {Techniques::defaults(), 0});
  other.use_shared_cache(std::make_shared<SharedCache>(SharedCache::Successor{}));
  const Expansion at_once = other.expand(root, kInfiniteCost, limits);
  ASSERT_FALSE(at_once.unfinished);
  ASSERT_EQ(in_parts.children.size(), at_once.children.size());
  for (std::size_t i = 0; i < at_once.children.size(); ++i)
    EXPECT_EQ(in_parts.children[i]->bound(), at_once.children[i]->bound());
}

TEST(Expander, IsAPureFunctionOfTheNode) {
  Search s({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{4, 0}, Position{0, 0}}});
  const Expansion first = s.expander.expand(s.root, kInfiniteCost, s.limits);
  for (const NodePtr& child : first.children) s.expander.expand(child, kInfiniteCost, s.limits);
  const Expansion again = s.expander.expand(s.root, kInfiniteCost, s.limits);
  ASSERT_EQ(again.children.size(), first.children.size());
  for (std::size_t k = 0; k < first.children.size(); ++k) {
    std::vector<Path> a;
    std::vector<Path> b;
    first.children[k]->paths(s.problem, a);
    again.children[k]->paths(s.problem, b);
    EXPECT_EQ(a, b);
  }
}

// Two workers, each with its own cache, expand the nodes of one tree alternately.
TEST(Expander, OneExpanderServesTwoWorkersLikeTwoExpanders) {
  const Instance instance =
      testing::random_crowd({.size = 10, .obstacles = 25, .agents = 12, .tasks = 14}, 1);
  const Limits limits;
  const Problem problem(instance, limits);
  AgentStopsCache stops(instance, problem.distances);
  NodePool pool;
  SingleTree forest(problem, stops, pool, limits);
  const NodePtr root = forest.next_root();
  struct Worker {
    std::shared_ptr<SharedCache> memory = std::make_shared<SharedCache>();
    Expander::AgentCaches caches;
  };
  // Expands nodes with `expander_of(worker)`, where the worker is 0 or 1. With `exchanges`, the
  // agent caches of the workers are swapped in and out. Returns the numbers of nodes and of
  // subproblems.
  const auto subproblems_queried = [&](auto expander_of, bool exchanges) {
    std::array<Worker, 2> workers;
    std::vector<NodePtr> nodes{root};
    for (std::size_t i = 0; i < nodes.size() && i < 40; ++i) {
      Worker& worker = workers[i % 2];
      Expander& expander = expander_of(i % 2);
      expander.use_shared_cache(worker.memory);
      if (exchanges) expander.swap_cache(worker.caches);
      Expansion expansion;
      do {
        expansion = expander.expand(nodes[i], kInfiniteCost, limits);
        expander.publish();
      } while (expansion.unfinished);
      if (exchanges) expander.swap_cache(worker.caches);
      for (NodePtr& child : expansion.children) nodes.push_back(std::move(child));
    }
    return std::pair(
        nodes.size(),
        expander_of(0).counts().subproblems +
            (&expander_of(0) == &expander_of(1) ? 0 : expander_of(1).counts().subproblems));
  };
  const SearchOptions options{Techniques::defaults(), 0};
  std::deque<Expander> own;
  for (int i = 0; i < 2; ++i) own.emplace_back(problem, stops, options);
  const auto with_own =
      subproblems_queried([&](std::size_t i) -> Expander& { return own[i]; }, false);
  EXPECT_GT(with_own.first, 50u) << "too few nodes to be a test";
  for (const bool exchanges : {true, false}) {
    Expander one(problem, stops, options);
    const auto with_one =
        subproblems_queried([&](std::size_t) -> Expander& { return one; }, exchanges);
    EXPECT_EQ(with_one.first, with_own.first);
    if (exchanges)
      EXPECT_EQ(with_one.second, with_own.second);
    else
      EXPECT_GT(with_one.second, with_own.second);
  }
}

}  // namespace expander_test
}  // namespace grove::detail
