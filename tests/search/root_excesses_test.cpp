// SPDX-License-Identifier: MIT
#include "search/root_excesses.h"

#include <gtest/gtest.h>

#include "search/single_tree.h"
#include "tests/primal/crowd.h"

namespace grove::detail {
namespace root_excesses_test {

class RootExcessesTest : public ::testing::Test {
 protected:
  const Limits limits_;
  const Instance instance_ =
      testing::random_crowd({.size = 10, .obstacles = 20, .agents = 8, .tasks = 6}, 1);
  const Problem problem_{instance_, limits_};
  AgentStopsCache stops_{instance_, problem_.distances};
  NodePool pool_;
  SingleTree forest_{problem_, stops_, pool_, limits_};
  const NodePtr root_ = forest_.next_root();
  SharedCache cache_;
};

TEST_F(RootExcessesTest, AreReadAsTheyWereAdded) {
  RootExcesses excesses(cache_, root_->tree());
  EXPECT_TRUE(excesses.all().empty());
  const std::vector<GroupExcess> added{{{0, 3}, 2}, {{1, 2, 5}, 1}, {{3, 4}, 1}};
  excesses.add(added);
  const std::vector<GroupExcess> all = RootExcesses(cache_, root_->tree()).all();
  ASSERT_EQ(all.size(), added.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].agents, added[i].agents);
    EXPECT_EQ(all[i].excess, added[i].excess);
  }
}

TEST_F(RootExcessesTest, KeepTheGreatestExcessOfAGroup) {
  RootExcesses excesses(cache_, root_->tree());
  excesses.add(std::vector<GroupExcess>{{{0, 3}, 2}, {{1, 2, 5}, 1}});
  excesses.add(std::vector<GroupExcess>{{{0, 3}, 1}, {{1, 2, 5}, 4}});
  const std::vector<GroupExcess> all = excesses.all();
  ASSERT_EQ(all.size(), 2);
  EXPECT_EQ(all[0].excess, 2);
  EXPECT_EQ(all[1].excess, 4);
}

// A statement about agents that have a constraint is not one about the root.
TEST_F(RootExcessesTest, OmitStatementsUnderConstraints) {
  RootExcesses excesses(cache_, root_->tree());
  const Tree& tree = root_->tree();
  const std::vector<Constraint> constraints{{.cell = 5, .begin = 1, .end = 1}};
  CacheDelta delta;
  delta.pairs.push_back({cache_.subproblems.id(0, *tree.orders[0], constraints),
                         cache_.subproblems.id(1, *tree.orders[1], {}),
                         1,
                         {.excess = 3}});
  cache_.merge(delta);
  EXPECT_TRUE(excesses.all().empty());
}

}  // namespace root_excesses_test
}  // namespace grove::detail
