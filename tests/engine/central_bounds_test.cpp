// SPDX-License-Identifier: MIT
// What is proven and found, whoever is at work at the moment it is asked.
#include "engine/central_bounds.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "small_search.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace central_ledger_test {

// Nodes of which is known what the test says.
struct ToldNodes : LiveNodes {
  Cost bound() const override {
    if (meanwhile) meanwhile();
    return least;
  }
  Cost evicted_bound() const override { return kInfiniteCost; }
  bool any() const override { return least < kInfiniteCost; }
  Counts counts() const override { return {}; }
  void push(const NodePtr&) override {}
  void prune(Cost cost) override { pruned.push_back(cost), when_pruned(); }
  void restart(std::span<const NodePtr>, Cost) override {}

  Cost least = 8;
  std::function<void()> meanwhile;  // what others do while the bound is read
  std::function<void()> when_pruned = [] {};
  std::vector<Cost> pruned;
};

using Heard = std::tuple<RunEvent, Cost, std::optional<Cost>>;  // lower bound, incumbent

class Listener : public RunObserver {
 public:
  void on_event(RunEvent event, const Progress& progress) override {
    heard.emplace_back(event, progress.lower_bound, progress.incumbent);
  }
  void on_pruned(Cost cost) override { pruned = cost; }
  void on_incumbent(const Plan& plan, PlanSource, const Progress&) override {
    EXPECT_EQ(pruned, plan.cost) << "said before";
    incumbents.push_back(plan.cost);
  }
  std::vector<Heard> heard;
  std::vector<Cost> incumbents;
  Cost pruned = -1;
};

class CentralLedgerTest : public ::testing::Test {
 protected:
  // The first one waits a step, the second one steps aside; or stays there for longer.
  static Plan plan(int later = 0) {
    Plan plan{11 + later, {{5, {}, {0, 0, 1, 2, 3, 4}}, {6 + later, {}, {4, 3, 2, 7, 2, 1, 0}}}};
    plan.agents[1].path.insert(plan.agents[1].path.begin() + 4, static_cast<std::size_t>(later), 7);
    return plan;
  }

  Instance instance_ = testing::two_in_a_bay();
  Limits limits_;
  ToldNodes nodes_;
  Listener listener_;
  RunEvents announcements_{
      listener_, [this] {
        return Progress{0, 0, 0, ledger_.lower_bound(), ledger_.gate().incumbent_cost()};
      }};
  CentralBounds ledger_{instance_, Omega(), limits_, nodes_, announcements_, 5};
};

TEST_F(CentralLedgerTest, TheBoundIsThatOfNodesAndTreesAndNeverFalls) {
  ledger_.nodes_changed();
  EXPECT_EQ(ledger_.lower_bound(), 5);
  ledger_.expect_trees_from(9);
  ledger_.nodes_changed();
  EXPECT_EQ(ledger_.lower_bound(), 8);
  nodes_.least = 7;
  ledger_.nodes_changed();
  EXPECT_EQ(ledger_.lower_bound(), 8);
  nodes_.least = kInfiniteCost;
  ledger_.nodes_changed();
  EXPECT_EQ(ledger_.lower_bound(), 9);
  EXPECT_FALSE(ledger_.over());
  ledger_.expect_trees_from(kInfiniteCost);
  ledger_.nodes_changed();
  EXPECT_TRUE(ledger_.over());
  EXPECT_EQ(listener_.heard, (std::vector<Heard>{{RunEvent::kBound, 5, std::nullopt},
                                                 {RunEvent::kBound, 8, std::nullopt},
                                                 {RunEvent::kBound, 9, std::nullopt}}));
}

// It holds of all plans, whatever the nodes say.
TEST_F(CentralLedgerTest, WhatIsProvenBesideTheTreesCounts) {
  ledger_.nodes_changed();
  ledger_.prove(4, BoundSource::kJointSearch);
  EXPECT_EQ(ledger_.lower_bound(), 5);
  ledger_.prove(7, BoundSource::kLagrangian);
  EXPECT_EQ(ledger_.lower_bound(), 7);
  ledger_.nodes_changed();
  EXPECT_EQ(ledger_.lower_bound(), 7);
  ledger_.expect_trees_from(9);
  ledger_.nodes_changed();
  EXPECT_EQ(ledger_.lower_bound(), 8);
  EXPECT_FALSE(ledger_.over());
  EXPECT_FALSE(ledger_.has_no_joint_plan());
  ledger_.prove(kInfiniteCost, BoundSource::kJointSearch);
  EXPECT_TRUE(ledger_.over());
  EXPECT_TRUE(ledger_.gate().proven_infeasible());
  EXPECT_TRUE(ledger_.has_no_joint_plan());
}

// With a plan, that there is no better one.
TEST_F(CentralLedgerTest, WhatIsProvenBesideTheTreesMayCloseAPlan) {
  ledger_.post(plan(), PlanSource::kStart);
  ledger_.prove(kInfiniteCost, BoundSource::kJointSearch);
  EXPECT_TRUE(ledger_.over());
  EXPECT_EQ(ledger_.lower_bound(), plan().cost);
  EXPECT_FALSE(ledger_.gate().proven_infeasible());
  EXPECT_FALSE(ledger_.has_no_joint_plan());
}

// That the trees hold no plan is no finding of who proves less beside them.
TEST_F(CentralLedgerTest, WhoProvesLessIsNotTheReasonThatThereIsNoPlan) {
  nodes_.least = kInfiniteCost;
  ledger_.expect_trees_from(kInfiniteCost);
  ledger_.nodes_changed();
  ASSERT_TRUE(ledger_.gate().proven_infeasible());
  ledger_.prove(7, BoundSource::kLagrangian);
  EXPECT_FALSE(ledger_.has_no_joint_plan());
}

// Another worker pushes the last tree's root and says so, just after the nodes were looked at.
TEST_F(CentralLedgerTest, ATreeThatComesMeanwhileIsNotOverlooked) {
  nodes_.least = kInfiniteCost;
  nodes_.meanwhile = [&] { ledger_.expect_trees_from(kInfiniteCost); };
  ledger_.nodes_changed();
  EXPECT_EQ(ledger_.lower_bound(), 5);
  EXPECT_FALSE(ledger_.over());
}

TEST_F(CentralLedgerTest, APlanIsInTheGateBeforeAnybodyPrunesByIt) {
  nodes_.when_pruned = [&] { EXPECT_EQ(ledger_.cutoff(), nodes_.pruned.back()); };
  EXPECT_EQ(ledger_.cutoff(), kInfiniteCost);
  ledger_.post(plan(2), PlanSource::kPrioritizedPlanning);
  ledger_.post(plan(3), PlanSource::kPrioritizedPlanning);
  ledger_.post(plan(), PlanSource::kTree);
  EXPECT_EQ(nodes_.pruned, (std::vector<Cost>{13, 11}));
  EXPECT_EQ(listener_.incumbents, (std::vector<Cost>{13, 11}));
  EXPECT_EQ(listener_.heard,
            (std::vector<Heard>{{RunEvent::kIncumbent, 0, 13}, {RunEvent::kIncumbent, 0, 11}}));
}

TEST_F(CentralLedgerTest, AWrongPlanIsRefused) {
  Plan wrong = plan();
  wrong.agents[1].path[3] = 2;  // where the first one is
  EXPECT_THROW(ledger_.post(wrong, PlanSource::kTree), std::logic_error);
  EXPECT_TRUE(nodes_.pruned.empty());
  EXPECT_EQ(ledger_.cutoff(), kInfiniteCost);
}

TEST_F(CentralLedgerTest, GivesThePlanToThoseWhoHaveAWorseOne) {
  EXPECT_FALSE(ledger_.plan_below(kInfiniteCost));
  ledger_.post(plan(), PlanSource::kTree);
  EXPECT_FALSE(ledger_.plan_below(11));
  ASSERT_TRUE(ledger_.plan_below(12));
  EXPECT_EQ(ledger_.plan_below(12)->cost, 11);
}

TEST_F(CentralLedgerTest, IsOverWhenTheGateOrTheLimitsSaySoOrNothingIsLeft) {
  ledger_.post(plan(), PlanSource::kTree);
  EXPECT_FALSE(ledger_.over());
  nodes_.least = 11;
  ledger_.expect_trees_from(11);
  ledger_.nodes_changed();
  EXPECT_TRUE(ledger_.over());

  CentralBounds given_up(instance_, Omega(), limits_, nodes_, announcements_, 5);
  EXPECT_FALSE(given_up.over());
  given_up.end();
  EXPECT_TRUE(given_up.over());

  CentralBounds stopped(instance_, Omega(), limits_, nodes_, announcements_, 5);
  limits_.set_deadline(testing::kPast);
  EXPECT_TRUE(stopped.over());
}

TEST_F(CentralLedgerTest, ResumesWithoutRepeatingWhatIsKnown) {
  ledger_.resume_at(7);
  ledger_.nodes_changed();
  EXPECT_EQ(ledger_.lower_bound(), 7);
  EXPECT_TRUE(listener_.heard.empty());
}

}  // namespace central_ledger_test
}  // namespace grove::detail
