// SPDX-License-Identifier: MIT
// Tests which node a worker takes and how its expansion is recorded.
#include "engine/components/tree_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "small_search.h"

namespace grove::detail {
namespace tree_search_test {

class TreeSearchTest : public ::testing::Test, public testing::SmallSearch {
 protected:
  TreeSearchTest() {
    bounds.nodes = source.nodes = &nodes;
    options.omega = Omega();
  }
  Components& components() {
    if (!components_)
      components_.emplace(problem, options, limits, stops, nodes, bounds, source, observer);
    return *components_;
  }
  TreeSearch& search() { return components().tree(); }
  Cost bound_taken() {
    const NodePtr node = search().take();
    return node ? node->bound() : -1;
  }
  Counters counters() {
    Counters counters;
    search().add_counts(counters);
    return counters;
  }

  SolveOptions options;
  testing::ScriptedBounds bounds;
  testing::CountingSource source;
  testing::CountingObserver observer;

 private:
  std::optional<Components> components_;
};

TEST_F(TreeSearchTest, TakesTheBestNodeAfterInstantiatingADueTree) {
  for (const Cost bound : {12, 9, 10}) nodes.push(child(bound));
  EXPECT_EQ(bound_taken(), 9);
  EXPECT_EQ(bound_taken(), 10);
  EXPECT_EQ(source.due, 2);
  EXPECT_EQ(source.refills, 0);
}

TEST_F(TreeSearchTest, RefillsNodesOnlyWhenNoneIsLive) {
  nodes.push(root);
  const NodePtr taken = search().take();
  EXPECT_FALSE(search().take()) << "one is taken";
  EXPECT_FALSE(search().has_work());
  EXPECT_EQ(source.refills, 0);
  search().finish(taken, {}, 0);
  EXPECT_FALSE(components().has_live_nodes()) << "a call shows that there is none";
  source.next = child(9);
  EXPECT_EQ(bound_taken(), 9);
  EXPECT_EQ(source.refills, 1);
}

TEST_F(TreeSearchTest, TakesEverySecondNodeByEstimateWithoutAPlan) {
  options.omega = Omega::parse("1");
  bounds.bound = 8;
  for (const auto& [bound, conflicts] : {std::pair(9, 90u), {9, 8u}, {10, 0u}, {11, 0u}})
    nodes.push(child(bound, conflicts));
  EXPECT_EQ(bound_taken(), 10) << "no conflicts";
  EXPECT_EQ(bound_taken(), 9) << "the best";
  bounds.incumbent = Plan{16, {}};
  nodes.push(child(15));
  for (const Cost bound : {9, 11, 15})
    EXPECT_EQ(bound_taken(), bound) << "with a plan the estimate is not used";
}

TEST_F(TreeSearchTest, ExpandedNodeIsLiveUntilItsResultsAreStored) {
  nodes.push(root);
  const NodePtr taken = search().take();
  bounds.incumbent = Plan{12, {}};
  Expansion expansion;
  expansion.children = {child(11), child(12), child(9)};
  expansion.plan = Plan{11, {}};
  search().finish(taken, std::move(expansion), 0);
  ASSERT_EQ(bounds.posted.size(), 1u);
  EXPECT_EQ(bounds.posted[0].first.cost, 11);
  EXPECT_EQ(bounds.posted[0].second, PlanSource::kTree);
  EXPECT_EQ(bounds.live_when_posted, 3u) << "two children are below the incumbent, and the node";
  EXPECT_EQ(bounds.live_when_changed, 2u);
  EXPECT_EQ(nodes.frontier.bound(), 9);
  EXPECT_EQ(observer.expansions, 1);
  const Counters counted = counters();
  EXPECT_EQ(counted[Counter::kNodesExpanded], 1);
  EXPECT_EQ(counted[Counter::kNodesGenerated], 3);
}

TEST_F(TreeSearchTest, UnfinishedNodeIsReinserted) {
  nodes.push(root);
  Expansion stopped;
  stopped.stopped = true;
  search().finish(search().take(), std::move(stopped), 0);
  EXPECT_EQ(nodes.frontier.open(), 1u);
  EXPECT_FALSE(search().unfinished());
  Expansion unfinished;
  unfinished.unfinished = true;
  search().finish(search().take(), std::move(unfinished), 0);
  EXPECT_EQ(nodes.frontier.open(), 1u);
  EXPECT_EQ(search().unfinished(), root);
  EXPECT_EQ(nodes.expanded, 0);
  search().finish(search().take(), {}, 0);
  EXPECT_FALSE(search().unfinished());
  EXPECT_EQ(nodes.frontier.live(), 0u);
  EXPECT_EQ(nodes.expanded, 1);
}

TEST_F(TreeSearchTest, EvictsTheWorstNodesAboveTheMemoryBudget) {
  for (Cost bound = 9; bound < 409; ++bound) nodes.push(child(bound));
  options.node_memory = nodes.pool.bytes() / 2;
  search().keep_within_memory();
  EXPECT_LE(nodes.pool.bytes(), options.node_memory);
  EXPECT_GT(nodes.pool.bytes(), options.node_memory / 2) << "no more than necessary";
  EXPECT_EQ(bound_taken(), 9);
  ASSERT_FALSE(observer.evicted_bounds.empty());
  EXPECT_EQ(nodes.evicted_bound(), *std::ranges::min_element(observer.evicted_bounds));
  EXPECT_EQ(nodes.evicted_bound(), 409 - std::ssize(observer.evicted_bounds)) << "the worst";
  const Counters counted = counters();
  EXPECT_EQ(counted[Counter::kNodesEvicted], std::ssize(observer.evicted_bounds));
}

TEST_F(TreeSearchTest, EvictsNothingWithoutABudget) {
  for (Cost bound = 9; bound < 109; ++bound) nodes.push(child(bound));
  search().keep_within_memory();
  EXPECT_TRUE(observer.evicted_bounds.empty());
}

}  // namespace tree_search_test
}  // namespace grove::detail
