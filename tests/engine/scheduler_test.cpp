// SPDX-License-Identifier: MIT
// Tests the policy at the head of scheduler.cpp with scripted components.
#include "engine/scheduler.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "small_search.h"

namespace grove::detail {
namespace scheduler_test {

// A component whose answers the test sets.
struct Script {
  std::string name;
  std::int64_t start = 0;
  Claim claim = {};
  Share share = {};
  int items = 1'000'000;  // left
  bool uses_idle_time = true;
  bool pays = true;
  EffortAccount account = EffortAccount();
};

class ScriptedItem : public WorkItem {
 public:
  ScriptedItem(std::string_view name, std::int64_t effort) : name_(name) { set_effort(effort, 0); }
  std::string_view name() const override { return name_; }
  void perform(Workspace&) override {}
  void commit() override {}

 private:
  std::string_view name_;
};

class ScriptedSource : public WorkSource {
 public:
  ScriptedSource(Script& script, const std::int64_t& effort)
      : WorkSource(script.account), script_(script), effort_(effort) {}

  std::int64_t start_effort() const override { return script_.start; }
  Claim claim() override { return script_.claim; }
  Share share(std::int64_t) override { return script_.share; }
  bool uses_idle_time() const override { return script_.uses_idle_time; }
  bool pays() const override { return script_.pays; }
  std::unique_ptr<WorkItem> next() override {
    if (script_.items == 0) return nullptr;
    --script_.items;
    return std::make_unique<ScriptedItem>(script_.name, effort_);
  }

 private:
  Script& script_;
  const std::int64_t& effort_;
};

// A tree search, a primal search, and two components that prove bounds.
class SchedulerTest : public ::testing::Test {
 protected:
  Scheduler& scheduler() {
    if (scheduler_) return *scheduler_;
    std::vector<Scheduler::Entry> entries;
    const auto add = [&](EffortTier tier, Script& script) {
      entries.push_back({tier, std::make_unique<ScriptedSource>(script, effort)});
    };
    add(EffortTier::kTree, tree);
    add(EffortTier::kPrimal, primal);
    add(EffortTier::kBound, first);
    add(EffortTier::kBound, second);
    scheduler_ = std::make_unique<Scheduler>(std::move(entries), bounds);
    return *scheduler_;
  }
  // Chooses an item, commits it with the given effort, and returns the component's name.
  std::string turn(std::int64_t the_effort = 1) {
    effort = the_effort;
    const auto item = scheduler().choose();
    if (!item) return "none";
    scheduler().charge(*item);
    return std::string(item->name());
  }
  // Returns the effort of the component `name` while the tree search spends `of_tree`.
  std::int64_t effort_beside_tree(const std::string& name, std::int64_t of_tree) {
    std::int64_t spent = 0;
    for (std::int64_t tree_effort = 0; tree_effort < of_tree;) {
      const std::string chosen = turn(1);
      tree_effort += chosen == "tree";
      spent += chosen == name;
    }
    return spent;
  }

  std::int64_t effort = 1;
  testing::ScriptedBounds bounds;
  Script tree{.name = "tree"};
  Script primal{.name = "primal"};
  Script first{.name = "first"};
  Script second{.name = "second"};

 private:
  std::unique_ptr<Scheduler> scheduler_;
};

TEST_F(SchedulerTest, TreeSearchGetsTheTimeThatIsNotClaimed) {
  for (int i = 0; i < 3; ++i) EXPECT_EQ(turn(), "tree");
}

TEST_F(SchedulerTest, LastRegisteredComponentThatIsDueComesFirst) {
  for (Script* script : {&primal, &first, &second}) script->claim.is_open = true;
  EXPECT_EQ(turn(), "second") << "credit 0 suffices";
  EXPECT_EQ(turn(), "first");
  EXPECT_EQ(turn(), "primal");
  EXPECT_EQ(turn(), "tree");
}

TEST_F(SchedulerTest, ComponentWithoutAnItemDoesNotBlockTheOthers) {
  second.claim.is_open = first.claim.is_open = true;
  second.items = 0;
  EXPECT_EQ(turn(), "first");
}

TEST_F(SchedulerTest, ComponentSpendsItsShareOfTheEffortOfLowerTiers) {
  for (const double share : {0.25, 1.0, 4.0}) {
    primal.claim.is_open = true;
    primal.share = {.wanted = share, .cap = 8};
    EXPECT_NEAR(static_cast<double>(effort_beside_tree("primal", 1000)), 1000 * share, 4 * share)
        << share;
  }
}

TEST_F(SchedulerTest, TierOfBoundsEarnsOnTreeAndPrimalSearchButNotOnItself) {
  primal.claim.is_open = second.claim.is_open = true;
  primal.share = {.wanted = 1, .cap = 1};
  second.share = first.share = {.wanted = 0.5, .cap = 0.5};
  EXPECT_NEAR(static_cast<double>(effort_beside_tree("second", 1000)), 1000, 3);
  EXPECT_EQ(tree.account.lower_tier_effort(), 0);
  EXPECT_EQ(primal.account.lower_tier_effort(), 1000);
  EXPECT_EQ(first.account.lower_tier_effort(), second.account.lower_tier_effort());
  EXPECT_NEAR(static_cast<double>(first.account.lower_tier_effort()), 2000, 3);
}

TEST_F(SchedulerTest, ComponentStartsAfterSomeEffortOfLowerTiers) {
  primal.claim = {.is_open = true, .is_urgent = true};
  primal.start = 30;
  EXPECT_EQ(turn(29), "tree");
  EXPECT_EQ(turn(1), "tree");
  EXPECT_EQ(turn(1), "primal");
}

TEST_F(SchedulerTest, UrgentClaimNeedsNoCredit) {
  primal.claim.is_open = true;
  EXPECT_EQ(turn(100), "primal");
  EXPECT_EQ(turn(), "tree") << "in debt";
  primal.claim.is_urgent = true;
  EXPECT_EQ(turn(), "primal");
}

TEST_F(SchedulerTest, ItemAfterWhichTheComponentDoesNotPayIsFree) {
  primal.claim.is_open = true;
  primal.pays = false;
  EXPECT_EQ(turn(100), "primal");
  EXPECT_EQ(turn(), "primal");
}

TEST_F(SchedulerTest, ClosedClaimIsNotDueDespiteCredit) {
  primal.share = {.wanted = 8, .cap = 8};
  EXPECT_EQ(turn(100), "tree");
  EXPECT_TRUE(primal.account.has_credit());
  EXPECT_EQ(turn(), "tree");
}

TEST_F(SchedulerTest, IdleTimeGoesToTheFirstRegisteredComponentThatUsesIt) {
  tree.items = 0;
  EXPECT_EQ(turn(), "primal");
  primal.uses_idle_time = false;
  EXPECT_EQ(turn(), "first");
  first.items = 0;
  EXPECT_EQ(turn(), "second");
  second.items = 0;
  EXPECT_EQ(turn(), "none");
}

TEST_F(SchedulerTest, NoBoundAndNoIdleWorkIsChosenWhenTheRunIsOver) {
  second.claim = {.is_open = true, .is_urgent = true};
  bounds.is_over = true;
  EXPECT_EQ(turn(), "tree");
  tree.items = 0;
  EXPECT_EQ(turn(), "none");
}

TEST_F(SchedulerTest, FloorIsBelowTheCap) {
  EXPECT_EQ(rate_of({.wanted = 2, .floor = 1, .cap = 4}), 2);
  EXPECT_EQ(rate_of({.wanted = 0.5, .floor = 1, .cap = 4}), 1);
  EXPECT_EQ(rate_of({.wanted = 8, .floor = 1, .cap = 4}), 4);
  EXPECT_EQ(rate_of({.wanted = 0.5, .floor = 1, .cap = 0.25}), 0.25) << "the cap has precedence";
}

TEST(EffortAccount, DebtIsKeptOrForgiven) {
  EffortAccount keeps;
  EffortAccount cancels({.cancels_debt = true});
  for (EffortAccount* account : {&keeps, &cancels}) {
    account->spend(100);
    account->spend(10);
    account->earn(50, 1);
  }
  EXPECT_FALSE(keeps.has_credit()) << "60 are left";
  EXPECT_TRUE(cancels.has_credit()) << "only the last 10 counted";
}

TEST(EffortAccount, EffortInThisProcessIsLimitedSeparately) {
  EffortAccount account({.max_local_ratio = 4});
  account.earn(10, 100);
  account.spend(900, true);
  EXPECT_TRUE(account.has_credit());
  account.spend(40);
  EXPECT_TRUE(account.has_credit());
  account.spend(1);
  EXPECT_FALSE(account.has_credit()) << "more than 4 units per unit of other effort here";
  account.earn(1, 0);
  EXPECT_TRUE(account.has_credit());
}

TEST(EffortAccount, EstimateOfRemoteEffortIsCorrected) {
  EffortAccount account;
  account.earn(100, 1);
  account.spend(150, true);
  EXPECT_FALSE(account.has_credit());
  account.spend(80 - 150, true);
  EXPECT_TRUE(account.has_credit());
}

}  // namespace scheduler_test
}  // namespace grove::detail
