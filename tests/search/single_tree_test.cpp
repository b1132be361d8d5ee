// SPDX-License-Identifier: MIT
#include "search/single_tree.h"

#include <gtest/gtest.h>

#include "search/expander.h"
#include "search/sequence_forest.h"
#include "tests/support/clocks.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace single_tree_test {

class SingleTreeTest : public ::testing::Test {
 protected:
  SingleTreeTest()
      : instance_(testing::instance_of(
            {".....", ".....", "....."},
            {{{0, 0}, Position{4, 0}, {{1, 2}, {3, 1}, {2, 0}}}, {{0, 2}, {}, {{4, 2}, {2, 1}}}})),
        problem_(instance_, limits_) {}

  Limits limits_;
  Instance instance_;
  Problem problem_;
  AgentStopsCache stops_{instance_, problem_.distances};
  NodePool pool_;
};

TEST_F(SingleTreeTest, HasOneRootOfTheCostOfTheBestSequences) {
  SingleTree forest(problem_, stops_, pool_, limits_);
  const Cost bound = forest.next_bound();
  const NodePtr root = forest.next_root();
  ASSERT_TRUE(root);
  SequenceForest sequences(problem_, pool_, RtspBackend::kAuto, limits_);
  EXPECT_EQ(root->cost(), sequences.next_root()->cost());
  EXPECT_LE(bound, root->cost());
  EXPECT_EQ(forest.next_bound(), kInfiniteCost);
  EXPECT_FALSE(forest.next_root());
}

TEST_F(SingleTreeTest, KeepsItsBoundAtALimit) {
  SingleTree forest(problem_, stops_, pool_, limits_);
  limits_.set_deadline(testing::kPast);
  EXPECT_FALSE(forest.next_root());
  EXPECT_LT(forest.next_bound(), kInfiniteCost);
}

TEST_F(SingleTreeTest, PlansNameTheChosenSequences) {
  SingleTree forest(problem_, stops_, pool_, limits_);
  Expander expander(problem_, stops_, {Techniques(), 0});
  const Expansion expansion = expander.expand(forest.next_root(), kInfiniteCost, limits_);
  ASSERT_TRUE(expansion.plan);
  EXPECT_EQ(expansion.plan->agents[0].sequence.size(), 3u);
  const AgentPlan& free_end = expansion.plan->agents[1];
  ASSERT_EQ(free_end.sequence.size(), 2u);
  EXPECT_EQ(instance_.task(free_end.sequence.back()).cell, free_end.path.back());
}

}  // namespace single_tree_test
}  // namespace grove::detail
