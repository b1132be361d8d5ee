// SPDX-License-Identifier: MIT
// When trees are instantiated, and in which order the ledger hears of it.
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

// Trees of the costs that the test says, as roots that cost so much.
class ToldForest : public Forest {
 public:
  ToldForest(testing::SmallSearch& search, std::deque<Cost> costs)
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

// Looks at what the ledger knows when a root is pushed.
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
    ledger_.emplace(search_.instance, options_.omega, limits_, nodes_, announcements_,
                    forest_->next_bound());
    trees_.emplace(options_, *forest_, nodes_, *ledger_, announcements_);
    trees_->begin();
  }
  std::int64_t count(const std::string& name) {
    Stats stats;
    trees_->add_counts(stats);
    return stats.counts.at(name);
  }
  void settle_best() { nodes_.frontier.settle(nodes_.frontier.take()); }

  testing::SmallSearch search_;
  Limits limits_;
  SolveOptions options_;
  WatchedNodes nodes_;
  RunObserver silent_;
  RunEvents announcements_{silent_, [] { return Progress(); }};
  std::optional<ToldForest> forest_;
  std::optional<CentralBounds> ledger_;
  std::optional<CentralTrees> trees_;
};

TEST_F(CentralTreesTest, TheNextTreeIsDueWhenTheBestNodeIsDearerThanTheLastTree) {
  begin({8, 10, 12});
  EXPECT_EQ(trees_->count(), 1);
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_EQ(ledger_->lower_bound(), 8);
  settle_best();
  nodes_.frontier.push(search_.child(9));
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 2);
  EXPECT_EQ(ledger_->lower_bound(), 9);
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 2) << "9 is not dearer than 10";
  EXPECT_EQ(count("roots_generated"), 2);
  EXPECT_EQ(count("rtsp_calls"), 7);
}

TEST_F(CentralTreesTest, WithinOmegaOfTheLastTreeNoneIsDue) {
  options_.omega = Omega::parse("0.5");
  begin({8, 10});
  settle_best();
  nodes_.frontier.push(search_.child(12));
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 1);
  nodes_.frontier.prune(0);
  nodes_.frontier.push(search_.child(13));
  trees_->instantiate_due_tree();
  EXPECT_EQ(trees_->count(), 2);
}

// Between the two a plan would be in no node and no tree that the bound covers.
TEST_F(CentralTreesTest, ARootIsPushedBeforeTheBoundOfTheTreesAfterItIsSaid) {
  std::vector<Cost> said;
  nodes_.when_pushed = [&] { said.push_back(ledger_->trees_from()); };
  begin({8, 10});
  settle_best();
  trees_->refill_nodes();
  EXPECT_EQ(said, (std::vector<Cost>{8, 10}));
  EXPECT_EQ(ledger_->trees_from(), kInfiniteCost);
  EXPECT_EQ(ledger_->lower_bound(), 10);
}

TEST_F(CentralTreesTest, NothingIsLeftOnlyWhenNoNodeIsLive) {
  begin({8});
  const NodePtr in_hand = nodes_.frontier.take();
  trees_->refill_nodes();
  EXPECT_FALSE(ledger_->over());
  nodes_.frontier.settle(in_hand);
  trees_->refill_nodes();
  EXPECT_TRUE(ledger_->over());
}

TEST_F(CentralTreesTest, ALimitLosesNoTree) {
  begin({8, 10});
  forest_->stopped = true;
  settle_best();
  trees_->refill_nodes();
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_EQ(ledger_->trees_from(), 10);
  EXPECT_EQ(ledger_->lower_bound(), 10);
  EXPECT_FALSE(ledger_->over());
}

TEST_F(CentralTreesTest, APreparedTreeIsNotInstantiatedAndBoundsThoseToCome) {
  options_.policy = Policy::kFixed;
  begin({8, 10, 12});
  ASSERT_TRUE(trees_->claim_preparation());
  EXPECT_FALSE(trees_->claim_preparation()) << "one at a time";
  trees_->prepare_tree();
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_EQ(ledger_->trees_from(), 10);
  EXPECT_EQ(nodes_.frontier.open(), 1u);
  EXPECT_EQ(count("trees_prepared_unused"), 1);
  settle_best();
  trees_->refill_nodes();
  EXPECT_EQ(nodes_.bound(), 10);
  EXPECT_EQ(ledger_->trees_from(), 12);
  EXPECT_EQ(count("trees_prepared"), 1);
  EXPECT_EQ(count("trees_prepared_unused"), 0);
  EXPECT_TRUE(trees_->claim_preparation());
}

TEST_F(CentralTreesTest, OnlyThePapersTreesArePrepared) {
  begin({8, 10});
  EXPECT_FALSE(trees_->claim_preparation());
}

TEST_F(CentralTreesTest, BeginsAnewWhenNodesWereGivenUpUntilThatLeadsNowhere) {
  begin({8});
  settle_best();
  nodes_.frontier.push(search_.child(9));
  nodes_.frontier.evict(1);
  trees_->refill_nodes();
  EXPECT_EQ(count("restarts"), 1);
  EXPECT_EQ(nodes_.frontier.open(), 1u) << "the root again";
  EXPECT_EQ(nodes_.evicted_bound(), kInfiniteCost);
  EXPECT_FALSE(ledger_->over());
  settle_best();
  nodes_.frontier.push(search_.child(9));
  nodes_.frontier.evict(1);
  trees_->refill_nodes();
  EXPECT_EQ(count("restarts"), 1) << "the last one was no better";
  EXPECT_TRUE(ledger_->over());
  ledger_->nodes_changed();
  EXPECT_EQ(ledger_->lower_bound(), 9);
}

TEST_F(CentralTreesTest, BeforeItBeginsAnewATreeBelowWhatWasGivenUpComes) {
  begin({8, 9});
  settle_best();
  nodes_.frontier.push(search_.child(11));
  nodes_.frontier.evict(1);
  trees_->refill_nodes();
  EXPECT_EQ(trees_->count(), 2);
  EXPECT_EQ(count("restarts"), 0);
}

TEST_F(CentralTreesTest, ResumesWithTheTreesThatItWasGiven) {
  forest_.emplace(search_, std::deque<Cost>{10});
  ledger_.emplace(search_.instance, options_.omega, limits_, nodes_, announcements_, 8);
  trees_.emplace(options_, *forest_, nodes_, *ledger_, announcements_);
  trees_->resume_with(search_.root);
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_EQ(ledger_->trees_from(), 10);
  trees_->begin();
  EXPECT_EQ(trees_->count(), 1);
  EXPECT_FALSE(nodes_.any()) << "its nodes are pushed by others";
  EXPECT_EQ(trees_->records(1), std::vector{record_of(search_.root->tree())});
}

}  // namespace central_trees_test
}  // namespace grove::detail
