// SPDX-License-Identifier: MIT
// Tests that the search never loses the optimum, and that a loss would be detected.
#include "tests/fuzz/planted_optimum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "engine/solve.h"
#include "search/sequence_forest.h"
#include "tests/fuzz/claims.h"
#include "tests/fuzz/fuzz_case.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {
namespace planted_optimum_test {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two agents in a corridor with one bay, in opposite directions: the root has a conflict.
class PlantedInABay : public ::testing::Test {
 protected:
  const Instance instance_ =
      TinyInstance::parse(
          "map\n.....\n@@.@@\nagents\n0,0 -> 4,0\n4,0 -> 0,0\ntasks\n2,0: 0\n3,0: 1\n")
          .build();
  const Limits limits_;
  const Problem problem_{instance_, limits_};
  const Plan optimum_ = *oracle::solve_jointly(instance_).plan;
  NodePool pool_;
  SequenceForest forest_{problem_, pool_, RtspBackend::kAuto, limits_};
  AgentStopsCache stops_{instance_, problem_.distances};
  Expander expander_{problem_, stops_, {Techniques(), 0}};
  PlantedOptimum planted_{instance_, optimum_};
  const NodePtr root_ = forest_.next_root();

  // Returns a child that holds the optimum, or nullptr.
  NodePtr holder(const Expansion& expansion) const {
    for (const NodePtr& child : expansion.children)
      if (planted_.held_by(*child)) return child;
    return nullptr;
  }
};

TEST_F(PlantedInABay, ExpanderKeepsThePlan) {
  planted_.on_root(root_);
  const Expansion expansion = expander_.expand(root_, kInfiniteCost, limits_);
  planted_.on_expanded(root_, expansion, 0);
  EXPECT_THAT(planted_.complaints(), IsEmpty());
  EXPECT_GE(planted_.nodes_followed(), 2u);
  EXPECT_TRUE(holder(expansion));
}

TEST_F(PlantedInABay, ReportsLossIfTheHoldingChildIsDropped) {
  planted_.on_root(root_);
  Expansion expansion = expander_.expand(root_, kInfiniteCost, limits_);
  std::erase_if(expansion.children, [&](const NodePtr& c) { return planted_.held_by(*c); });
  planted_.on_expanded(root_, expansion, 0);
  EXPECT_THAT(planted_.complaints(), Contains(HasSubstr("lost it")));
}

TEST_F(PlantedInABay, ReportsLossIfConstraintsForbidThePlan) {
  planted_.on_root(root_);
  Expansion expansion = expander_.expand(root_, kInfiniteCost, limits_);
  for (NodePtr& child : expansion.children) {
    NodeDelta ban;
    ban.added = {0, {optimum_.agents[0].path[1], kNoCell, 1, 1}};
    ban.cost = child->cost();
    child = Node::child(child, ban);
  }
  planted_.on_expanded(root_, expansion, 0);
  EXPECT_THAT(planted_.complaints(), Contains(HasSubstr("lost it")));
}

TEST_F(PlantedInABay, ReportsNodeBoundAboveOptimum) {
  planted_.on_root(root_);
  Expansion expansion = expander_.expand(root_, kInfiniteCost, limits_);
  for (NodePtr& child : expansion.children) {
    NodeDelta raise;
    raise.cost = child->cost();
    raise.bound = optimum_.cost + 1;
    child = Node::child(child, raise);
  }
  planted_.on_expanded(root_, expansion, 0);
  EXPECT_THAT(planted_.complaints(), Contains(HasSubstr("claims the bound")));
}

TEST_F(PlantedInABay, ReportsFalseClaimsOfTheSearch) {
  planted_.on_event(RunEvent::kBound, {.lower_bound = optimum_.cost, .incumbent = std::nullopt});
  planted_.on_pruned(optimum_.cost);
  EXPECT_THAT(planted_.complaints(), IsEmpty());
  planted_.on_event(RunEvent::kBound, {.lower_bound = optimum_.cost + 1, .incumbent = {}});
  planted_.on_pruned(optimum_.cost - 1);
  planted_.on_infeasible("no way");
  EXPECT_EQ(planted_.complaints().size(), 3u);
}

TEST_F(PlantedInABay, EvictedNodeLimitsTheGlobalBound) {
  planted_.on_root(root_);
  planted_.on_evicted(root_);
  planted_.on_event(RunEvent::kBound, {.lower_bound = root_->bound(), .incumbent = std::nullopt});
  EXPECT_THAT(planted_.complaints(), IsEmpty());
  ASSERT_LT(root_->bound(), optimum_.cost);
  planted_.on_event(RunEvent::kBound, {.lower_bound = root_->bound() + 1, .incumbent = {}});
  EXPECT_THAT(planted_.complaints(), Contains(HasSubstr("evicted")));
}

TEST_F(PlantedInABay, BoundMayRiseAfterRestart) {
  planted_.on_root(root_);
  planted_.on_evicted(root_);
  planted_.on_root(root_);
  planted_.on_event(RunEvent::kBound, {.lower_bound = root_->bound() + 1, .incumbent = {}});
  EXPECT_THAT(planted_.complaints(), IsEmpty());
}

TEST(SatisfiesAll, DerivesVisitOrderFromPath) {
  const Instance instance =
      TinyInstance::parse("map\n....\nagents\n0,0 -> -\ntasks\n1,0: 0\n3,0: 0\n").build();
  const Path there{0, 1, 2, 3};
  // The agent returns to rest on its first task, so that task is its last visit.
  const Path back{0, 1, 2, 3, 2, 1};
  EXPECT_TRUE(satisfies_all(instance, 0, SequenceClass({0}, 0), {}, there));
  EXPECT_FALSE(satisfies_all(instance, 0, SequenceClass({}, 1), {}, there));
  EXPECT_TRUE(satisfies_all(instance, 0, SequenceClass({1}, 0), {}, back));
  EXPECT_FALSE(satisfies_all(instance, 0, SequenceClass({0}, 0), {}, back));
  EXPECT_FALSE(satisfies_all(instance, 0, SequenceClass({1}, 0), {}, there));
  EXPECT_TRUE(satisfies_all(instance, 0, SequenceClass({}, 1), {}, back));
}

// Interrupts the search after `expansions` expansions, a limit that is the same on any machine.
class InterruptingOptimum : public PlantedOptimum {
 public:
  InterruptingOptimum(const Instance& instance, Plan optimum, int expansions)
      : PlantedOptimum(instance, std::move(optimum)), expansions_left_(expansions) {}

  void on_expanded(const NodePtr& node, const Expansion& expansion, int worker) override {
    PlantedOptimum::on_expanded(node, expansion, worker);
    if (--expansions_left_ <= 0) enough_.store(true, std::memory_order_relaxed);
  }
  const std::atomic<bool>& enough() const { return enough_; }

 private:
  int expansions_left_;
  std::atomic<bool> enough_{false};
};

// Solves each case of the seeds 0 to `seeds` - 1 that has a plan, with the options that `choose`
// derives from the options of the case, and interrupts it after `expansions` expansions. Calls
// `look` with every solution and the PlantedOptimum that observed the run.
template <class Choose, class Look>
void follow_optima(std::uint64_t seeds, int expansions, Choose choose, Look look) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const FuzzCase fuzz_case = random_case(seed);
    const Instance instance = fuzz_case.instance.build();
    const auto truth = oracle::solve_jointly(instance);
    if (!truth.plan) continue;
    InterruptingOptimum planted(instance, *truth.plan, expansions);
    Limits limits;
    limits.watch_interrupt(&planted.enough());
    SolveOptions options = choose(fuzz_case.options);
    options.audit = true;
    const Solution solution = solve(instance, options, limits, &planted);
    EXPECT_THAT(planted.complaints(), IsEmpty()) << fuzz_case.to_text();
    EXPECT_THAT(false_claims(instance, truth, options.omega, solution, true), IsEmpty());
    look(solution, planted);
  }
}

TEST(PlantedOptimum, SurvivesWholeSearches) {
  std::size_t followed = 0;
  follow_optima(
      150, 1000,
      [](const SolveOptions& random) {
        SolveOptions options;
        options.omega = random.omega;
        return options;
      },
      [&](const Solution&, const PlantedOptimum& planted) {
        followed += planted.nodes_followed();
      });
  EXPECT_GT(followed, 300u);
}

// Plain CBS with memory for a few nodes, so that nodes must be evicted.
TEST(PlantedOptimum, SurvivesNodeEviction) {
  std::int64_t evicted = 0;
  std::int64_t restarts = 0;
  int asked = 0;
  int optimal = 0;
  follow_optima(
      400, 1000,
      [](const SolveOptions& random) {
        SolveOptions options;
        options.policy = random.policy;
        options.techniques = Techniques();
        options.node_memory = 3000;
        return options;
      },
      [&](const Solution& solution, const PlantedOptimum&) {
        const std::int64_t count = solution.stats.counts.at("nodes_evicted");
        evicted += count;
        restarts += solution.stats.counts.at("restarts");
        asked += count > 0;
        optimal += count > 0 && solution.status == Status::kOptimal;
      });
  EXPECT_GT(evicted, 1000);
  EXPECT_GT(restarts, 10);
  EXPECT_GT(asked, 20);
  EXPECT_GT(optimal, asked / 3) << "of " << asked;
  RecordProperty("optimal", optimal);
}

}  // namespace planted_optimum_test
}  // namespace grove::detail::fuzz
