// SPDX-License-Identifier: MIT
// Tests which node a worker takes and how its expansion is recorded.
#include "engine/shared_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "small_search.h"

namespace grove::detail {
namespace shared_search_test {

class SharedSearchTest : public ::testing::Test, public testing::SmallSearch {
 protected:
  SharedSearchTest() {
    bounds.nodes = source.nodes = &nodes;
    options.omega = Omega();
  }
  SharedSearch& shared() {
    if (!shared_) shared_.emplace(options, limits, nodes, bounds, source, observer);
    return *shared_;
  }
  Cost bound_taken() {
    const NodePtr node = shared().take();
    return node ? node->bound() : -1;
  }

  SolveOptions options;
  testing::ScriptedBounds bounds;
  testing::CountingSource source;
  testing::CountingObserver observer;

 private:
  std::optional<SharedSearch> shared_;
};

TEST_F(SharedSearchTest, TakesTheBestNodeAfterInstantiatingADueTree) {
  for (const Cost bound : {12, 9, 10}) nodes.push(child(bound));
  EXPECT_EQ(bound_taken(), 9);
  EXPECT_EQ(bound_taken(), 10);
  EXPECT_EQ(source.due, 2);
  EXPECT_EQ(source.refills, 0);
}

TEST_F(SharedSearchTest, RefillsNodesOnlyWhenNoneIsLive) {
  nodes.push(root);
  const NodePtr taken = shared().take();
  EXPECT_FALSE(shared().take()) << "one is taken";
  EXPECT_FALSE(shared().may_take());
  EXPECT_EQ(source.refills, 0);
  shared().finish(taken, {}, 0);
  EXPECT_TRUE(shared().may_take()) << "a call shows that there is none";
  source.next = child(9);
  EXPECT_EQ(bound_taken(), 9);
  EXPECT_EQ(source.refills, 1);
}

TEST_F(SharedSearchTest, TakesEverySecondNodeByEstimateWithoutAPlan) {
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

TEST_F(SharedSearchTest, ExpandedNodeIsLiveUntilItsResultsAreStored) {
  nodes.push(root);
  const NodePtr taken = shared().take();
  bounds.incumbent = Plan{12, {}};
  Expansion expansion;
  expansion.children = {child(11), child(12), child(9)};
  expansion.plan = Plan{11, {}};
  shared().finish(taken, std::move(expansion), 0);
  ASSERT_EQ(bounds.posted.size(), 1u);
  EXPECT_EQ(bounds.posted[0].first.cost, 11);
  EXPECT_EQ(bounds.posted[0].second, PlanSource::kTree);
  EXPECT_EQ(bounds.live_when_posted, 3u) << "two children are below the incumbent, and the node";
  EXPECT_EQ(bounds.live_when_changed, 2u);
  EXPECT_EQ(nodes.frontier.bound(), 9);
  EXPECT_EQ(observer.expansions, 1);
  Stats stats;
  shared().add_counts(stats);
  EXPECT_EQ(stats.counts["nodes_expanded"], 1);
  EXPECT_EQ(stats.counts["nodes_generated"], 3);
}

TEST_F(SharedSearchTest, UnfinishedNodeIsReinserted) {
  nodes.push(root);
  Expansion stopped;
  stopped.stopped = true;
  shared().finish(shared().take(), std::move(stopped), 0);
  EXPECT_EQ(nodes.frontier.open(), 1u);
  EXPECT_FALSE(shared().unfinished());
  Expansion unfinished;
  unfinished.unfinished = true;
  shared().finish(shared().take(), std::move(unfinished), 0);
  EXPECT_EQ(nodes.frontier.open(), 1u);
  EXPECT_EQ(shared().unfinished(), root);
  EXPECT_EQ(nodes.expanded, 0);
  shared().finish(shared().take(), {}, 0);
  EXPECT_FALSE(shared().unfinished());
  EXPECT_EQ(nodes.frontier.live(), 0u);
  EXPECT_EQ(nodes.expanded, 1);
}

TEST_F(SharedSearchTest, EvictsTheWorstNodesAboveTheMemoryBudget) {
  for (Cost bound = 9; bound < 409; ++bound) nodes.push(child(bound));
  options.node_memory = nodes.pool.bytes() / 2;
  shared().keep_within_memory();
  EXPECT_LE(nodes.pool.bytes(), options.node_memory);
  EXPECT_GT(nodes.pool.bytes(), options.node_memory / 2) << "no more than necessary";
  EXPECT_EQ(bound_taken(), 9);
  ASSERT_FALSE(observer.evicted_bounds.empty());
  EXPECT_EQ(nodes.evicted_bound(), *std::ranges::min_element(observer.evicted_bounds));
  EXPECT_EQ(nodes.evicted_bound(), 409 - std::ssize(observer.evicted_bounds)) << "the worst";
  Stats stats;
  shared().add_counts(stats);
  EXPECT_EQ(stats.counts["nodes_evicted"], std::ssize(observer.evicted_bounds));
}

TEST_F(SharedSearchTest, EvictsNothingWithoutABudget) {
  for (Cost bound = 9; bound < 109; ++bound) nodes.push(child(bound));
  shared().keep_within_memory();
  EXPECT_TRUE(observer.evicted_bounds.empty());
}

}  // namespace shared_search_test
}  // namespace grove::detail
