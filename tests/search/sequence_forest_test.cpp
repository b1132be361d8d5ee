// SPDX-License-Identifier: MIT
#include "search/sequence_forest.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/clocks.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace sequence_forest_test {

class ForestTest : public ::testing::Test {
 protected:
  // Two agents with 3 and 2 tasks have 6 * 2 = 12 trees.
  ForestTest()
      : instance_(testing::instance_of(
            {".....", ".....", "....."},
            {{{0, 0}, Position{4, 0}, {{1, 2}, {3, 1}, {2, 0}}}, {{0, 2}, {}, {{4, 2}, {2, 1}}}})),
        problem_(instance_, limits_) {}

  Limits limits_;
  Instance instance_;
  Problem problem_;
  NodePool pool_;
};

TEST_F(ForestTest, InstantiatesEveryTreeOnceInOrderOfCost) {
  SequenceForest forest(problem_, pool_, RtspBackend::kAuto, limits_);
  std::set<std::string> seen;
  Cost last = 0;
  while (const NodePtr root = forest.next_root()) {
    EXPECT_EQ(root->tree().number, seen.size());
    EXPECT_GE(root->cost(), last);
    EXPECT_LE(forest.next_bound() == kInfiniteCost ? 0 : last, root->cost());
    last = root->cost();
    std::string key;
    for (const auto& order : root->tree().orders)
      for (Stop stop : order->sequences.prefix) key += std::to_string(stop) + ' ';
    EXPECT_TRUE(seen.insert(key).second) << key;
  }
  EXPECT_EQ(seen.size(), 12u);
  EXPECT_EQ(forest.next_bound(), kInfiniteCost);
}

TEST_F(ForestTest, NextBoundNeverExceedsTheCostOfTheNextTree) {
  SequenceForest forest(problem_, pool_, RtspBackend::kAuto, limits_);
  while (true) {
    const Cost bound = forest.next_bound();
    const NodePtr root = forest.next_root();
    if (!root) break;
    EXPECT_LE(bound, root->cost());
  }
}

TEST_F(ForestTest, TreesShareCommonOrders) {
  SequenceForest forest(problem_, pool_, RtspBackend::kAuto, limits_);
  std::set<const AgentSequencing*> orders;
  while (const NodePtr root = forest.next_root())
    for (const auto& order : root->tree().orders) orders.insert(order.get());
  EXPECT_EQ(orders.size(), 6u + 2u);
}

TEST_F(ForestTest, KeepsItsBoundAtALimit) {
  SequenceForest forest(problem_, pool_, RtspBackend::kAuto, limits_);
  ASSERT_TRUE(forest.next_root());
  limits_.set_deadline(testing::kPast);
  EXPECT_EQ(forest.next_root(), nullptr);
  EXPECT_GE(forest.next_bound(), 0);
  EXPECT_LT(forest.next_bound(), kInfiniteCost);
}

}  // namespace sequence_forest_test
}  // namespace grove::detail
