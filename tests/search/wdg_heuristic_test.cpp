// SPDX-License-Identifier: MIT
#include "search/wdg_heuristic.h"

#include <gtest/gtest.h>

#include "tests/search/root_fixture.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace wdg_heuristic_test {

using testing::AgentSpec;
using testing::RootFixture;
using Outcome = WdgHeuristic::Outcome;

struct Bounded : RootFixture {
  using RootFixture::RootFixture;

  // Returns the bound of the root minus its cost.
  Cost excess(Cost cutoff = kInfiniteCost, BoundingEffort bounding_effort = BoundingEffort::kFull) {
    Cost bound = -1;
    EXPECT_EQ(wdg.find_bound(view.node(), view, cutoff, bounding_effort, limits, bound),
              Outcome::kDone);
    return bound - root->cost();
  }
  std::vector<Split> splits() {
    std::vector<Split> found;
    wdg.splits(view, found);
    return found;
  }

  WdgHeuristic wdg{problem, options, planner, memory};
};

// One agent passes the door at time 2 at the earliest. The other agent then passes it at time 5,
// three steps late.
const std::vector<std::string> kDoor{"..@..", ".....", "..@.."};
const std::vector<AgentSpec> kHeadOn{{{0, 1}, Position{4, 1}}, {{4, 1}, Position{0, 1}}};

TEST(WdgHeuristic, ComputesTheExcessOfAPairOnce) {
  Bounded s(kDoor, kHeadOn);
  EXPECT_EQ(s.excess(), 3);
  const std::int64_t work = s.wdg.expansions();
  EXPECT_GT(work, 0);
  EXPECT_EQ(s.excess(), 3);  // cached
  EXPECT_EQ(s.wdg.expansions(), work);
}

TEST(WdgHeuristic, UsesOnlyCachedWeightsWithCachedOnlyEffort) {
  Bounded s(kDoor, kHeadOn);
  EXPECT_EQ(s.excess(kInfiniteCost, BoundingEffort::kCachedOnly), 0);
  EXPECT_EQ(s.wdg.expansions(), 0);
  EXPECT_EQ(s.excess(), 3) << "it was left for later";
  EXPECT_EQ(s.excess(kInfiniteCost, BoundingEffort::kCachedOnly), 3);
}

TEST(WdgHeuristic, IsZeroForAgentsThatCanBypassEachOther) {
  Bounded s({"...", "...", "..."}, {{{0, 0}, Position{2, 2}}, {{0, 2}, Position{2, 0}}});
  s.take({{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}}, {{0, 2}, {0, 1}, {1, 1}, {1, 0}, {2, 0}}});
  ASSERT_FALSE(s.view.conflict_free());
  EXPECT_EQ(s.excess(), 0);
  EXPECT_TRUE(s.splits().empty());
}

TEST(WdgHeuristic, ReturnsTheCutoffIfTheExcessReachesIt) {
  for (const Cost above : {1, 2, 3}) {
    Bounded s(kDoor, kHeadOn);
    EXPECT_EQ(s.excess(s.root->cost() + above), above);
  }
}

// A bound that was computed under a low cutoff proves only the excess up to that cutoff, so a later
// query without a cutoff must not return more.
TEST(WdgHeuristic, ClaimsNoMoreThanTheSlackHasProven) {
  for (const Cost above : {1, 2, 3}) {
    Bounded s(kDoor, kHeadOn);
    s.excess(s.root->cost() + above);
    EXPECT_EQ(s.excess(), above);
  }
}

TEST(WdgHeuristic, AddsTheWeightsOfDisjointPairs) {
  const std::vector<std::string> twice{"..@..", ".....", "..@..", "@@@@@",
                                       "..@..", ".....", "..@.."};
  Bounded apart(twice,
                {kHeadOn[0], kHeadOn[1], {{0, 5}, Position{4, 5}}, {{4, 5}, Position{0, 5}}});
  EXPECT_EQ(apart.excess(), 6);
}

TEST(WdgHeuristic, SplitsOnTheCostsOfADependentPair) {
  Bounded s(kDoor, kHeadOn);
  EXPECT_TRUE(s.splits().empty());  // no weight is cached yet
  s.excess();
  const auto splits = s.splits();
  ASSERT_EQ(splits.size(), 1u);
  for (const AgentIndex agent : s.all) {
    const auto& [who, constraint] = splits[0][agent];
    EXPECT_EQ(who, agent);
    EXPECT_EQ(constraint.kind, ConstraintKind::kNoRestBy);
    EXPECT_EQ(constraint.cell, *s.instance.agent(agent).goal);
    EXPECT_EQ(constraint.end, s.view.cost_of(agent));
  }
}

// An agent without a destination may rest on any of its tasks, so it can avoid its current cost in
// other ways than by coming to rest later.
TEST(WdgHeuristic, SplitsNoCostsOfAgentsWithoutADestination) {
  Bounded s(kDoor, {{{0, 1}, std::nullopt, {{4, 1}}}, {{4, 1}, std::nullopt, {{0, 1}}}});
  EXPECT_GT(s.excess(), 0);
  EXPECT_TRUE(s.splits().empty());
}

// Any two of these agents can keep their costs, but not all three. The excess is two steps,
// according to an exhaustive search.
TEST(WdgHeuristic, ComputesTheExcessOfAGroupOfIndependentPairs) {
  const std::vector<std::string> rows{"....", "....", "...."};
  const std::vector<AgentSpec> three{
      {{2, 2}, Position{1, 1}}, {{3, 0}, Position{1, 2}}, {{2, 0}, Position{2, 2}}};
  Bounded with(rows, three);
  Bounded without(rows, three, {Techniques::defaults().without(Technique::kClusters), 0, true});
  EXPECT_EQ(without.excess(), 0);
  EXPECT_EQ(with.excess(), 2);
}

// When the search by splits reaches its node limit, joint search takes over.
TEST(WdgHeuristic, UsesJointSearchAtTheNodeLimitOfSplits) {
  SearchOptions options{Techniques::defaults().without({Technique::kCorridor, Technique::kTarget}),
                        0, true};
  options.tuning.pair_expansions = 1;
  Bounded with(kDoor, kHeadOn, options);
  Bounded below(kDoor, kHeadOn, options);
  options.techniques = options.techniques.without(Technique::kJointGroups);
  Bounded without(kDoor, kHeadOn, options);
  EXPECT_LT(without.excess(), 3);
  EXPECT_EQ(without.wdg.joint_groups().states(), 0);
  EXPECT_EQ(with.excess(), 3);
  EXPECT_GT(with.wdg.joint_groups().states(), 0);
  EXPECT_EQ(below.excess(below.root->cost() + 2), 2);
}

TEST(WdgHeuristic, StopsAtALimit) {
  Bounded s(kDoor, kHeadOn);
  s.limits.set_deadline(testing::kPast);
  Cost bound = -1;
  EXPECT_EQ(s.wdg.find_bound(s.root, s.view, kInfiniteCost, BoundingEffort::kFull, s.limits, bound),
            Outcome::kStopped);
}

TEST(WdgHeuristic, HelpsUntilNothingIsLeft) {
  Bounded s(kDoor, kHeadOn);
  EXPECT_TRUE(s.wdg.help(s.root, s.view, kInfiniteCost, 0.5, s.limits));
  const std::int64_t work = s.wdg.expansions();
  EXPECT_FALSE(s.wdg.help(s.root, s.view, kInfiniteCost, 0.5, s.limits));
  EXPECT_EQ(s.excess(), 3);
  EXPECT_EQ(s.wdg.expansions(), work);
}

}  // namespace wdg_heuristic_test
}  // namespace grove::detail
