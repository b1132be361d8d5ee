// SPDX-License-Identifier: MIT
#include "search/frontier.h"

#include <gtest/gtest.h>

#include <deque>

#include "tests/support/instances.h"

namespace grove::detail {
namespace frontier_test {

// Roots whose bound is the length of one agent's path.
class FrontierTest : public ::testing::Test {
 protected:
  FrontierTest()
      : instance_(testing::instance_of({"........."}, {{{0, 0}, Position{8, 0}}})),
        distances_(instance_) {}

  NodePtr node(Time bound) {
    Path path{0};
    for (Time t = 0; t < bound; ++t) path.push_back(t + 1);
    Tree& tree = trees_.emplace_back();
    tree.world = &instance_.world();
    tree.pool = &pool_;
    tree.orders.push_back(std::make_shared<const AgentSequencing>(AgentSequencing{
        {}, GoalSequence(instance_, distances_, 0, {}), PackedPath(instance_.grid(), path)}));
    return Node::root(tree);
  }

  Instance instance_;
  DistanceFields distances_;
  NodePool pool_;
  std::deque<Tree> trees_;
  Frontier frontier_;
};

TEST_F(FrontierTest, TakesTheLeastBoundAndTheNewestAmongEquals) {
  const NodePtr newest = node(2);
  frontier_.push(node(3));
  frontier_.push(node(2));
  frontier_.push(newest);
  EXPECT_EQ(frontier_.take(), newest);
  EXPECT_EQ(frontier_.take()->bound(), 2);
  EXPECT_EQ(frontier_.take()->bound(), 3);
  EXPECT_EQ(frontier_.take(), nullptr);
}

TEST_F(FrontierTest, CountsTakenNodesAsLive) {
  frontier_.push(node(1));
  frontier_.push(node(4));
  const NodePtr taken = frontier_.take();
  EXPECT_EQ(frontier_.bound(), 1);
  frontier_.complete(taken);
  EXPECT_EQ(frontier_.bound(), 4);
}

TEST_F(FrontierTest, TransferredNodesCountUntilTheyAreSettled) {
  for (const Time bound : {3, 3, 3, 3, 5, 8}) frontier_.push(node(bound));
  EXPECT_EQ(frontier_.levels(2), (std::vector<Frontier::Level>{{3, 4}, {5, 1}}));
  const auto spare = frontier_.take_for_transfer(3, true);
  ASSERT_EQ(spare.size(), 3);
  EXPECT_EQ(spare[1]->bound(), 3);
  EXPECT_EQ(spare[2]->bound(), 5);
  EXPECT_EQ(frontier_.open(), 3);
  EXPECT_EQ(frontier_.live(), 6);
  EXPECT_EQ(frontier_.levels(9), (std::vector<Frontier::Level>{{3, 2}, {8, 1}}));
  frontier_.complete(frontier_.take());
  frontier_.complete(frontier_.take());
  EXPECT_EQ(frontier_.bound(), 3);
  for (const NodePtr& given : spare) frontier_.complete(given);
  EXPECT_EQ(frontier_.bound(), 8);
}

TEST_F(FrontierTest, NextNodeIsNotTransferredWithKeepsNext) {
  frontier_.push(node(2));
  EXPECT_TRUE(frontier_.take_for_transfer(5, true).empty());
  frontier_.push(node(7));
  EXPECT_EQ(frontier_.take_for_transfer(5, true).front()->bound(), 7);
  EXPECT_EQ(frontier_.take()->bound(), 2);
  EXPECT_EQ(frontier_.take(), nullptr);
}

TEST_F(FrontierTest, NextNodeIsTransferredWithoutKeepsNext) {
  frontier_.push(node(2));
  const NodePtr taken = frontier_.take();
  frontier_.push(node(3));
  EXPECT_TRUE(frontier_.take_for_transfer(5, true).empty());
  const auto spare = frontier_.take_for_transfer(5, false);
  ASSERT_EQ(spare.size(), 1);
  EXPECT_EQ(spare.front()->bound(), 3);
  EXPECT_EQ(frontier_.bound(), 2);
  frontier_.complete(taken);
  EXPECT_EQ(frontier_.bound(), 3);
}

TEST_F(FrontierTest, TakenNodesOfEqualBoundAreCountedSeparately) {
  frontier_.push(node(1));
  frontier_.push(node(1));
  const NodePtr first = frontier_.take();
  const NodePtr second = frontier_.take();
  frontier_.complete(first);
  EXPECT_EQ(frontier_.bound(), 1);
  frontier_.reinsert(second);
  EXPECT_EQ(frontier_.bound(), 1);
  EXPECT_EQ(frontier_.open(), 1u);
}

TEST_F(FrontierTest, PrunesOnlyFromTheGivenBoundOn) {
  for (Time bound : {1, 2, 3, 3, 5}) frontier_.push(node(bound));
  EXPECT_EQ(frontier_.prune(3), 3u);
  EXPECT_EQ(frontier_.open(), 2u);
  frontier_.complete(frontier_.take());
  frontier_.complete(frontier_.take());
  EXPECT_TRUE(frontier_.empty());
}

TEST_F(FrontierTest, TakeByEstimateStaysWithinOmega) {
  const auto with_conflicts = [&](Time bound, std::uint32_t conflicts) {
    NodeDelta change;
    change.cost = bound;
    change.conflicts = conflicts;
    return Node::child(node(bound), change);
  };
  const NodePtr with_six_conflicts = with_conflicts(4, 6);
  const NodePtr promising = with_conflicts(5, 1);
  const NodePtr too_expensive = with_conflicts(7, 0);
  for (const NodePtr& pushed : {with_six_conflicts, promising, too_expensive})
    frontier_.push(pushed);
  const Omega half = Omega::parse("0.5");
  const NodePtr taken = frontier_.take_by_estimate(half, 4, 1);
  EXPECT_EQ(taken, promising);
  EXPECT_EQ(frontier_.bound(), 4);
  frontier_.complete(taken);
  EXPECT_EQ(frontier_.take_by_estimate(half, 4, 1), with_six_conflicts);
  EXPECT_EQ(frontier_.take_by_estimate(half, 4, 1), nullptr);
  EXPECT_EQ(frontier_.take_by_estimate(Omega::infinite(), 4, 1), too_expensive);
}

TEST_F(FrontierTest, EvictsTheWorstAndKeepsTheirLeastBound) {
  for (Time bound : {4, 2, 5, 3}) frontier_.push(node(bound));
  EXPECT_EQ(frontier_.evicted_bound(), kInfiniteCost);
  const auto evicted = frontier_.evict(2);
  ASSERT_EQ(evicted.size(), 2u);
  EXPECT_EQ(evicted[0]->bound() + evicted[1]->bound(), 9);
  EXPECT_EQ(frontier_.evicted_bound(), 4);
  EXPECT_EQ(frontier_.open(), 2u);
  EXPECT_EQ(frontier_.bound(), 2);
  frontier_.complete(frontier_.take());
  frontier_.complete(frontier_.take());
  EXPECT_EQ(frontier_.take(), nullptr);
  // No node is live, but no bound above that of the evicted nodes is proven.
  EXPECT_EQ(frontier_.bound(), 4);
  EXPECT_FALSE(frontier_.empty());
}

TEST_F(FrontierTest, EvictsTheOldestAmongEqualBounds) {
  const NodePtr newest = node(2);
  for (int i = 0; i < 4; ++i) frontier_.push(node(2));
  frontier_.push(newest);
  EXPECT_EQ(frontier_.evict(4).size(), 4u);
  EXPECT_EQ(frontier_.take(), newest);
  EXPECT_EQ(frontier_.bound(), 2);
}

TEST_F(FrontierTest, EvictsAtMostTheOpenNodes) {
  EXPECT_TRUE(frontier_.evict(3).empty());
  EXPECT_TRUE(frontier_.empty());
  frontier_.push(node(2));
  EXPECT_EQ(frontier_.evict(3).size(), 1u);
  EXPECT_EQ(frontier_.open(), 0u);
}

TEST_F(FrontierTest, EvictedBoundIsPrunedOnlyAtItsCostOrBelow) {
  frontier_.push(node(4));
  frontier_.evict(1);
  frontier_.prune(5);
  EXPECT_EQ(frontier_.bound(), 4);
  frontier_.prune(4);
  EXPECT_TRUE(frontier_.empty());
}

TEST_F(FrontierTest, RestartKeepsTheProvenBoundAndTakesNewestFirst) {
  frontier_.push(node(4));
  frontier_.evict(1);
  const NodePtr newest = node(3);
  frontier_.restart(std::vector{node(1), node(5), newest}, frontier_.evicted_bound());
  EXPECT_EQ(frontier_.evicted_bound(), kInfiniteCost);
  EXPECT_EQ(frontier_.live(), 3u);
  EXPECT_EQ(frontier_.bound(), 4);
  const NodePtr first = frontier_.take();
  EXPECT_EQ(first, newest);
  EXPECT_EQ(frontier_.bound(), 4);
  frontier_.complete(first);
  const NodePtr second = frontier_.take();
  EXPECT_EQ(second->bound(), 1);
  frontier_.complete(second);
  EXPECT_EQ(frontier_.bound(), 5);
}

}  // namespace frontier_test
}  // namespace grove::detail
