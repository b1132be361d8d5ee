// SPDX-License-Identifier: MIT
#include "search/wdg_heuristic.h"

#include <gtest/gtest.h>

#include "tests/search/root_fixture.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace dependencies_test {

using testing::AgentSpec;
using testing::RootFixture;
using Outcome = WdgHeuristic::Outcome;

struct Bounded : RootFixture {
  using RootFixture::RootFixture;

  // By how much the bound is above the root's cost.
  Cost excess(Cost cutoff = kInfiniteCost, BoundingEffort bounding_effort = BoundingEffort::kFull) {
    Cost bound = -1;
    EXPECT_EQ(dependencies.find_bound(view.node(), view, cutoff, bounding_effort, limits, bound),
              Outcome::kDone);
    return bound - root->cost();
  }
  std::vector<Split> splits() {
    std::vector<Split> found;
    dependencies.splits(view, found);
    return found;
  }

  WdgHeuristic dependencies{problem, options, planner, memory};
};

// One passes the door at time 2 at the earliest, the other then at time 5: three steps late.
const std::vector<std::string> kDoor{"..@..", ".....", "..@.."};
const std::vector<AgentSpec> kHeadOn{{{0, 1}, Position{4, 1}}, {{4, 1}, Position{0, 1}}};

TEST(WdgHeuristic, KnowWhatAPairCostsMore) {
  Bounded s(kDoor, kHeadOn);
  EXPECT_EQ(s.excess(), 3);
  const std::int64_t work = s.dependencies.expansions();
  EXPECT_GT(work, 0);
  EXPECT_EQ(s.excess(), 3);  // remembered
  EXPECT_EQ(s.dependencies.expansions(), work);
}

TEST(WdgHeuristic, InHasteSayOnlyWhatIsKnown) {
  Bounded s(kDoor, kHeadOn);
  EXPECT_EQ(s.excess(kInfiniteCost, BoundingEffort::kCachedOnly), 0);
  EXPECT_EQ(s.dependencies.expansions(), 0);
  EXPECT_EQ(s.excess(), 3) << "it was left for later";
  EXPECT_EQ(s.excess(kInfiniteCost, BoundingEffort::kCachedOnly), 3);
}

TEST(WdgHeuristic, SayNothingOfAgentsThatGoRoundEachOther) {
  Bounded s({"...", "...", "..."}, {{{0, 0}, Position{2, 2}}, {{0, 2}, Position{2, 0}}});
  s.take({{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}}, {{0, 2}, {0, 1}, {1, 1}, {1, 0}, {2, 0}}});
  ASSERT_FALSE(s.view.conflict_free());
  EXPECT_EQ(s.excess(), 0);
  EXPECT_TRUE(s.splits().empty());
}

TEST(WdgHeuristic, GiveTheCutoffWhereNothingIsCheaper) {
  for (const Cost above : {1, 2, 3}) {
    Bounded s(kDoor, kHeadOn);
    EXPECT_EQ(s.excess(s.root->cost() + above), above);
  }
}

// What was closed for want of slack says no more than that, whatever is asked afterwards.
TEST(WdgHeuristic, ClaimNoMoreThanTheSlackHasShown) {
  for (const Cost above : {1, 2, 3}) {
    Bounded s(kDoor, kHeadOn);
    s.excess(s.root->cost() + above);
    EXPECT_EQ(s.excess(), above);
  }
}

TEST(WdgHeuristic, AddUpPairsThatShareNobody) {
  const std::vector<std::string> twice{"..@..", ".....", "..@..", "@@@@@",
                                       "..@..", ".....", "..@.."};
  Bounded apart(twice,
                {kHeadOn[0], kHeadOn[1], {{0, 5}, Position{4, 5}}, {{4, 5}, Position{0, 5}}});
  EXPECT_EQ(apart.excess(), 6);
}

TEST(WdgHeuristic, SplitOnTheCostsOfAPairThatCannotKeepThem) {
  Bounded s(kDoor, kHeadOn);
  EXPECT_TRUE(s.splits().empty());  // before anything is known of them
  s.excess();
  const auto splits = s.splits();
  ASSERT_EQ(splits.size(), 1u);
  for (const AgentIndex agent : s.all) {
    const auto& [who, demand] = splits[0][agent];
    EXPECT_EQ(who, agent);
    EXPECT_EQ(demand.kind, ConstraintKind::kNoRestBy);
    EXPECT_EQ(demand.cell, *s.instance.agent(agent).goal);
    EXPECT_EQ(demand.end, s.view.cost_of(agent));
  }
}

// An agent that may rest on any of its tasks does not only come to rest later.
TEST(WdgHeuristic, SplitNoCostsOfAgentsWithoutADestination) {
  Bounded s(kDoor, {{{0, 1}, std::nullopt, {{4, 1}}}, {{4, 1}, std::nullopt, {{0, 1}}}});
  EXPECT_GT(s.excess(), 0);
  EXPECT_TRUE(s.splits().empty());
}

// Any two of them can keep their costs, all three cannot: two steps more, as trying all ways says.
TEST(WdgHeuristic, KnowThatAGroupCostsMoreThoughNoPairDoes) {
  const std::vector<std::string> rows{"....", "....", "...."};
  const std::vector<AgentSpec> three{
      {{2, 2}, Position{1, 1}}, {{3, 0}, Position{1, 2}}, {{2, 0}, Position{2, 2}}};
  Bounded with(rows, three);
  Bounded without(rows, three, {Techniques::defaults().without(Technique::kClusters), 0, true});
  EXPECT_EQ(without.excess(), 0);
  EXPECT_EQ(with.excess(), 2);
}

// Where a search by splits ends after its first node, joint search goes on.
TEST(WdgHeuristic, AreSettledByJointSearchWhereSplitsDoNotEnd) {
  SearchOptions options{Techniques::defaults().without({Technique::kTraversal, Technique::kTarget}),
                        0, true};
  options.tuning.pair_expansions = 1;
  Bounded with(kDoor, kHeadOn, options);
  Bounded below(kDoor, kHeadOn, options);
  options.techniques = options.techniques.without(Technique::kJointGroups);
  Bounded without(kDoor, kHeadOn, options);
  EXPECT_LT(without.excess(), 3);
  EXPECT_EQ(without.dependencies.joint_groups().states(), 0);
  EXPECT_EQ(with.excess(), 3);
  EXPECT_GT(with.dependencies.joint_groups().states(), 0);
  EXPECT_EQ(below.excess(below.root->cost() + 2), 2);
}

TEST(WdgHeuristic, StopAtALimit) {
  Bounded s(kDoor, kHeadOn);
  s.limits.set_deadline(testing::kPast);
  Cost bound = -1;
  EXPECT_EQ(s.dependencies.find_bound(s.root, s.view, kInfiniteCost, BoundingEffort::kFull,
                                      s.limits, bound),
            Outcome::kStopped);
}

TEST(WdgHeuristic, HelpUntilNothingIsLeft) {
  Bounded s(kDoor, kHeadOn);
  EXPECT_TRUE(s.dependencies.help(s.root, s.view, kInfiniteCost, 0.5, s.limits));
  const std::int64_t work = s.dependencies.expansions();
  EXPECT_FALSE(s.dependencies.help(s.root, s.view, kInfiniteCost, 0.5, s.limits));
  EXPECT_EQ(s.excess(), 3);
  EXPECT_EQ(s.dependencies.expansions(), work);
}

}  // namespace dependencies_test
}  // namespace grove::detail
