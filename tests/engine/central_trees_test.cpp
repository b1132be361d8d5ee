// SPDX-License-Identifier: MIT
// Tests when trees are instantiated and in what order the bounds are updated.
#include "engine/central_trees.h"

#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "small_search.h"

namespace grove::detail {
namespace central_trees_test {

// A forest whose trees and roots have the costs that the test sets.
class ScriptedForest : public Forest {
 public:
  ScriptedForest(testing::SmallSearch& search, std::deque<Cost> costs)
      : search_(search), costs_(std::move(costs)) {}
  Cost next_bound() const override { return costs_.empty() ? kInfiniteCost : costs_.front(); }
  NodePtr next_root() override {
    if (costs_.empty() || stopped) return nullptr;
    const Cost cost = costs_.front();
    costs_.pop_front();
    return search_.child(cost);
  }
  std::int64_t rtsp_calls() const override { return 7; }
  bool stopped = false;

 private:
  testing::SmallSearch& search_;
  std::deque<Cost> costs_;
};

// Calls `when_pushed` when a root is pushed.
struct WatchedNodes : LocalNodes {
  void push(const NodePtr& root) override {
    when_pushed();
    LocalNodes::push(root);
  }
  std::function<void()> when_pushed = [] {};
};

class CentralTreesTest : public ::testing::Test {
 protected:
  CentralTreesTest() { options_.omega = Omega(); }

  void begin(std::deque<Cost> costs) {
    forest_.emplace(search_, std::move(costs));
    bounds_.emplace(search_.instance, options_.omega, limits_, nodes_, run_events_,
                    forest_->next_bound());
    trees_.emplace(options_, *forest_, nodes_, *bounds_, run_events_);
    trees_->begin();
  }
  std::int64_t count(const std::string& name) {
    Counters counters;
    trees_->add_counts(counters);
    return counters.named().at(name);
  }
  void complete_best() { nodes_.frontier.complete(nodes_.frontier.take()); }

  testing::SmallSearch search_;
  Limits limits_;
  SolveOptions options_;
  WatchedNodes nodes_;
  RunObserver observer_;
  RunEvents run_events_{observer_, [] { return Progress(); }};
  std::optional<ScriptedForest> forest_;
  std::optional<CentralBounds> bounds_;
  std::optional<CentralTrees> trees_;
};

TEST_F(CentralTreesTest, NextTreeIsDueAboveTheCostOfTheLastTree) {
  begin({8, 10, 12});
  EXPECT_EQ(trees_->count(), 1);
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_EQ(bounds_->lower_bound(), 8);
  complete_best();
  nodes_.frontier.push(search_.child(9));
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 2);
  EXPECT_EQ(bounds_->lower_bound(), 9);
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 2) << "9 does not exceed 10";
  EXPECT_EQ(count("roots_generated"), 2);
  EXPECT_EQ(count("rtsp_calls"), 7);
}

TEST_F(CentralTreesTest, NoTreeIsDueWithinOmegaOfTheLastTree) {
  options_.omega = Omega::parse("0.5");
  begin({8, 10});
  complete_best();
  nodes_.frontier.push(search_.child(12));
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 1);
  nodes_.frontier.prune(0);
  nodes_.frontier.push(search_.child(13));
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 2);
}

// If the bound of later trees rose first, neither a node nor a later tree would cover some plans
// until the root is pushed.
TEST_F(CentralTreesTest, RootIsPushedBeforeTheNextBoundRises) {
  std::vector<Cost> bounds_at_push;
  nodes_.when_pushed = [&] { bounds_at_push.push_back(bounds_->trees_from()); };
  begin({8, 10});
  complete_best();
  trees_->refill_nodes();
  EXPECT_EQ(bounds_at_push, (std::vector<Cost>{8, 10}));
  EXPECT_EQ(bounds_->trees_from(), kInfiniteCost);
  EXPECT_EQ(bounds_->lower_bound(), 10);
}

TEST_F(CentralTreesTest, IsNotOverWhileANodeIsLive) {
  begin({8});
  const NodePtr taken = nodes_.frontier.take();
  trees_->refill_nodes();
  EXPECT_FALSE(bounds_->over());
  nodes_.frontier.complete(taken);
  trees_->refill_nodes();
  EXPECT_TRUE(bounds_->over());
}

TEST_F(CentralTreesTest, KeepsTheNextTreeAtALimit) {
  begin({8, 10});
  forest_->stopped = true;
  complete_best();
  trees_->refill_nodes();
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_EQ(bounds_->trees_from(), 10);
  EXPECT_EQ(bounds_->lower_bound(), 10);
  EXPECT_FALSE(bounds_->over());
}

TEST_F(CentralTreesTest, PreparedTreeBoundsLaterTrees) {
  options_.policy = Policy::kFixed;
  begin({8, 10, 12});
  ASSERT_TRUE(trees_->claim_preparation());
  EXPECT_FALSE(trees_->claim_preparation()) << "one at a time";
  trees_->prepare_tree();
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_EQ(bounds_->trees_from(), 10);
  EXPECT_EQ(nodes_.frontier.open(), 1u);
  EXPECT_EQ(count("trees_prepared_unused"), 1);
  complete_best();
  trees_->refill_nodes();
  EXPECT_EQ(nodes_.bound(), 10);
  EXPECT_EQ(bounds_->trees_from(), 12);
  EXPECT_EQ(count("trees_prepared"), 1);
  EXPECT_EQ(count("trees_prepared_unused"), 0);
  EXPECT_TRUE(trees_->claim_preparation());
}

TEST_F(CentralTreesTest, PreparesTreesOnlyForTheFixedPolicy) {
  begin({8, 10});
  EXPECT_FALSE(trees_->claim_preparation());
}

TEST_F(CentralTreesTest, RestartsWhileThatRaisesTheEvictedBound) {
  begin({8});
  complete_best();
  nodes_.frontier.push(search_.child(9));
  nodes_.frontier.evict(1);
  trees_->refill_nodes();
  EXPECT_EQ(count("restarts"), 1);
  EXPECT_EQ(nodes_.frontier.open(), 1u) << "the root again";
  EXPECT_EQ(nodes_.evicted_bound(), kInfiniteCost);
  EXPECT_FALSE(bounds_->over());
  complete_best();
  nodes_.frontier.push(search_.child(9));
  nodes_.frontier.evict(1);
  trees_->refill_nodes();
  EXPECT_EQ(count("restarts"), 1) << "the last restart did not raise the bound";
  EXPECT_TRUE(bounds_->over());
  bounds_->nodes_changed();
  EXPECT_EQ(bounds_->lower_bound(), 9);
}

TEST_F(CentralTreesTest, InstantiatesCheaperTreesBeforeARestart) {
  begin({8, 9});
  complete_best();
  nodes_.frontier.push(search_.child(11));
  nodes_.frontier.evict(1);
  trees_->refill_nodes();
  EXPECT_EQ(trees_->count(), 2);
  EXPECT_EQ(count("restarts"), 0);
}

TEST_F(CentralTreesTest, ResumesWithTheGivenTrees) {
  forest_.emplace(search_, std::deque<Cost>{10});
  bounds_.emplace(search_.instance, options_.omega, limits_, nodes_, run_events_, 8);
  trees_.emplace(options_, *forest_, nodes_, *bounds_, run_events_);
  trees_->resume_with(search_.root);
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_EQ(bounds_->trees_from(), 10);
  trees_->begin();
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_FALSE(nodes_.any()) << "the caller pushes its nodes";
  EXPECT_EQ(trees_->records(1), std::vector{record_of(search_.root->tree())});
}

}  // namespace central_trees_test
}  // namespace grove::detail
