// SPDX-License-Identifier: MIT
#include "grove/search/frontier.h"

#include <gtest/gtest.h>

#include <deque>

#include "tests/support/instances.h"

namespace grove {
namespace {

// Roots whose bound is the length of one agent's walk.
class FrontierTest : public ::testing::Test {
 protected:
  FrontierTest()
      : instance_(testing::instance_of({"........."}, {{{0, 0}, Position{8, 0}}})),
        distances_(instance_) {}

  NodePtr node(Time bound) {
    Path path{0};
    for (Time t = 0; t < bound; ++t) path.push_back(t + 1);
    Tree& tree = trees_.emplace_back();
    tree.pool = &pool_;
    tree.orders.push_back(std::make_shared<const AgentOrder>(AgentOrder{
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
  frontier_.settle(taken);
  EXPECT_EQ(frontier_.bound(), 4);
}

TEST_F(FrontierTest, TwoTakenNodesOfOneBoundAreTwo) {
  frontier_.push(node(1));
  frontier_.push(node(1));
  const NodePtr first = frontier_.take();
  const NodePtr second = frontier_.take();
  frontier_.settle(first);
  EXPECT_EQ(frontier_.bound(), 1);
  frontier_.give_back(second);
  EXPECT_EQ(frontier_.bound(), 1);
  EXPECT_EQ(frontier_.open(), 1u);
}

TEST_F(FrontierTest, PrunesOnlyFromTheGivenBoundOn) {
  for (Time bound : {1, 2, 3, 3, 5}) frontier_.push(node(bound));
  EXPECT_EQ(frontier_.prune(3), 3u);
  EXPECT_EQ(frontier_.open(), 2u);
  frontier_.settle(frontier_.take());
  frontier_.settle(frontier_.take());
  EXPECT_TRUE(frontier_.empty());
}

}  // namespace
}  // namespace grove
