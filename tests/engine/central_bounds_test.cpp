// SPDX-License-Identifier: MIT
// Tests the global bounds and the incumbent under concurrent calls by workers.
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
namespace central_bounds_test {

// Live nodes with the bounds that the test sets.
struct ScriptedNodes : LiveNodes {
  Cost bound() const override {
    if (when_read) when_read();
    return least;
  }
  Cost evicted_bound() const override { return kInfiniteCost; }
  bool any() const override { return least < kInfiniteCost; }
  Counts counts() const override { return {}; }
  void push(const NodePtr&) override {}
  void prune(Cost cost) override { pruned.push_back(cost), when_pruned(); }
  void restart(std::span<const NodePtr>, Cost) override {}

  Cost least = 8;
  std::function<void()> when_read;  // simulates calls by other workers during a read of the bound
  std::function<void()> when_pruned = [] {};
  std::vector<Cost> pruned;
};

using Event = std::tuple<RunEvent, Cost, std::optional<Cost>>;  // lower bound, incumbent

class Listener : public RunObserver {
 public:
  void on_event(RunEvent event, const Progress& progress) override {
    events.emplace_back(event, progress.lower_bound, progress.incumbent);
  }
  void on_pruned(Cost cost) override { pruned = cost; }
  void on_incumbent(const Plan& plan, PlanSource, const Progress&) override {
    EXPECT_EQ(pruned, plan.cost) << "on_pruned() comes first";
    incumbents.push_back(plan.cost);
  }
  std::vector<Event> events;
  std::vector<Cost> incumbents;
  Cost pruned = -1;
};

class CentralBoundsTest : public ::testing::Test {
 protected:
  // A plan in which agent 0 waits one step and agent 1 steps aside, where it stays `later` more
  // steps.
  static Plan plan(int later = 0) {
    Plan plan{11 + later, {{5, {}, {0, 0, 1, 2, 3, 4}}, {6 + later, {}, {4, 3, 2, 7, 2, 1, 0}}}};
    plan.agents[1].path.insert(plan.agents[1].path.begin() + 4, static_cast<std::size_t>(later), 7);
    return plan;
  }

  Instance instance_ = testing::two_in_a_bay();
  Limits limits_;
  ScriptedNodes nodes_;
  Listener listener_;
  RunEvents run_events_{
      listener_, [this] {
        return Progress{0, 0, 0, bounds_.lower_bound(), bounds_.global_bounds().incumbent_cost()};
      }};
  CentralBounds bounds_{instance_, Omega(), limits_, nodes_, run_events_, 5};
};

TEST_F(CentralBoundsTest, BoundCoversNodesAndTreesAndNeverFalls) {
  bounds_.nodes_changed();
  EXPECT_EQ(bounds_.lower_bound(), 5);
  bounds_.expect_trees_from(9);
  bounds_.nodes_changed();
  EXPECT_EQ(bounds_.lower_bound(), 8);
  nodes_.least = 7;
  bounds_.nodes_changed();
  EXPECT_EQ(bounds_.lower_bound(), 8);
  nodes_.least = kInfiniteCost;
  bounds_.nodes_changed();
  EXPECT_EQ(bounds_.lower_bound(), 9);
  EXPECT_FALSE(bounds_.over());
  bounds_.expect_trees_from(kInfiniteCost);
  bounds_.nodes_changed();
  EXPECT_TRUE(bounds_.over());
  EXPECT_EQ(listener_.events, (std::vector<Event>{{RunEvent::kBound, 5, std::nullopt},
                                                  {RunEvent::kBound, 8, std::nullopt},
                                                  {RunEvent::kBound, 9, std::nullopt}}));
}

// A bound proven outside the tree search holds for all plans, whatever the bound of the nodes.
TEST_F(CentralBoundsTest, BoundProvenOutsideTheTreeSearchCounts) {
  bounds_.nodes_changed();
  bounds_.prove(4, ComponentId::kJoint);
  EXPECT_EQ(bounds_.lower_bound(), 5);
  bounds_.prove(7, ComponentId::kLagrangian);
  EXPECT_EQ(bounds_.lower_bound(), 7);
  bounds_.nodes_changed();
  EXPECT_EQ(bounds_.lower_bound(), 7);
  bounds_.expect_trees_from(9);
  bounds_.nodes_changed();
  EXPECT_EQ(bounds_.lower_bound(), 8);
  EXPECT_FALSE(bounds_.over());
  EXPECT_FALSE(bounds_.has_no_joint_plan());
  bounds_.prove(kInfiniteCost, ComponentId::kJoint);
  EXPECT_TRUE(bounds_.over());
  EXPECT_TRUE(bounds_.global_bounds().proven_infeasible());
  EXPECT_TRUE(bounds_.has_no_joint_plan());
}

// A bound proven outside the trees can reach the cost of the incumbent, which is then optimal.
TEST_F(CentralBoundsTest, BoundProvenOutsideTheTreesCanCloseTheGap) {
  bounds_.post(plan(), PlanSource::kStart);
  bounds_.prove(kInfiniteCost, ComponentId::kJoint);
  EXPECT_TRUE(bounds_.over());
  EXPECT_EQ(bounds_.lower_bound(), plan().cost);
  EXPECT_FALSE(bounds_.global_bounds().proven_infeasible());
  EXPECT_FALSE(bounds_.has_no_joint_plan());
}

// If the tree search proves infeasibility, a later, weaker bound from elsewhere does not count as
// the proof.
TEST_F(CentralBoundsTest, WeakerBoundIsNotTheReasonForInfeasibility) {
  nodes_.least = kInfiniteCost;
  bounds_.expect_trees_from(kInfiniteCost);
  bounds_.nodes_changed();
  ASSERT_TRUE(bounds_.global_bounds().proven_infeasible());
  bounds_.prove(7, ComponentId::kLagrangian);
  EXPECT_FALSE(bounds_.has_no_joint_plan());
}

// While the bound of the nodes is read, another worker reports that it has pushed the root of the
// last tree. The bound that is read does not include this root yet.
TEST_F(CentralBoundsTest, TreeAddedWhileTheBoundIsReadIsCounted) {
  nodes_.least = kInfiniteCost;
  nodes_.when_read = [&] { bounds_.expect_trees_from(kInfiniteCost); };
  bounds_.nodes_changed();
  EXPECT_EQ(bounds_.lower_bound(), 5);
  EXPECT_FALSE(bounds_.over());
}

TEST_F(CentralBoundsTest, PlanIsPostedBeforeNodesArePrunedByIt) {
  nodes_.when_pruned = [&] { EXPECT_EQ(bounds_.cutoff(), nodes_.pruned.back()); };
  EXPECT_EQ(bounds_.cutoff(), kInfiniteCost);
  bounds_.post(plan(2), PlanSource::kPrioritizedPlanning);
  bounds_.post(plan(3), PlanSource::kPrioritizedPlanning);
  bounds_.post(plan(), PlanSource::kTree);
  EXPECT_EQ(nodes_.pruned, (std::vector<Cost>{13, 11}));
  EXPECT_EQ(listener_.incumbents, (std::vector<Cost>{13, 11}));
  EXPECT_EQ(listener_.events,
            (std::vector<Event>{{RunEvent::kIncumbent, 0, 13}, {RunEvent::kIncumbent, 0, 11}}));
}

TEST_F(CentralBoundsTest, InvalidPlanIsRefused) {
  Plan wrong = plan();
  wrong.agents[1].path[3] = 2;  // where agent 0 is at that time
  EXPECT_THROW(bounds_.post(wrong, PlanSource::kTree), std::logic_error);
  EXPECT_TRUE(nodes_.pruned.empty());
  EXPECT_EQ(bounds_.cutoff(), kInfiniteCost);
}

TEST_F(CentralBoundsTest, PlanBelowReturnsOnlyACheaperPlan) {
  EXPECT_FALSE(bounds_.plan_below(kInfiniteCost));
  bounds_.post(plan(), PlanSource::kTree);
  EXPECT_FALSE(bounds_.plan_below(11));
  ASSERT_TRUE(bounds_.plan_below(12));
  EXPECT_EQ(bounds_.plan_below(12)->cost, 11);
}

TEST_F(CentralBoundsTest, IsOverIfOptimalOrEndedOrAtALimit) {
  bounds_.post(plan(), PlanSource::kTree);
  EXPECT_FALSE(bounds_.over());
  nodes_.least = 11;
  bounds_.expect_trees_from(11);
  bounds_.nodes_changed();
  EXPECT_TRUE(bounds_.over());

  CentralBounds ended(instance_, Omega(), limits_, nodes_, run_events_, 5);
  EXPECT_FALSE(ended.over());
  ended.end();
  EXPECT_TRUE(ended.over());

  CentralBounds stopped(instance_, Omega(), limits_, nodes_, run_events_, 5);
  limits_.set_deadline(testing::kPast);
  EXPECT_TRUE(stopped.over());
}

TEST_F(CentralBoundsTest, ResumesWithoutRepeatingTheBoundEvent) {
  bounds_.resume_at(7);
  bounds_.nodes_changed();
  EXPECT_EQ(bounds_.lower_bound(), 7);
  EXPECT_TRUE(listener_.events.empty());
}

}  // namespace central_bounds_test
}  // namespace grove::detail
