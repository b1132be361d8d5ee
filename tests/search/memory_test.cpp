// SPDX-License-Identifier: MIT
#include "grove/detail/search/memory.h"

#include <gtest/gtest.h>

#include "tests/search/node_at_hand.h"

namespace grove::detail {
namespace memory_test {

using Known = Excesses::Known;

bool same(const Known& a, const Known& b) {
  return a.excess == b.excess && a.exact == b.exact && a.expansions == b.expansions;
}

std::vector<Excesses::Partner> partners_of(const auto& memory, Situations::Id id) {
  std::vector<Excesses::Partner> partners;
  memory.partners(id, partners);
  return partners;
}

TEST(Excesses, KeepTheStrongerStatement) {
  Excesses excesses;
  EXPECT_TRUE(same(excesses.of_pair(3, 5), Known()));
  excesses.learn_pair(3, 5, 1, {2, false, 16});
  excesses.learn_pair(3, 5, 1, {1, true, 4});
  EXPECT_TRUE(same(excesses.of_pair(3, 5), {2, true, 16}));
  EXPECT_TRUE(same(excesses.of_pair(5, 3), Known()));
  EXPECT_TRUE(same(excesses.of_pair(3, 6), Known()));
}

TEST(Excesses, ListPartnersThatCostMoreOnce) {
  Excesses excesses;
  excesses.learn_pair(3, 5, 1, {0, true, 1});
  EXPECT_TRUE(partners_of(excesses, 3).empty());
  excesses.learn_pair(3, 6, 2, {1, false, 1});
  excesses.learn_pair(3, 6, 2, {4, false, 1});
  excesses.learn_pair(3, 6, 2, {2, false, 1});
  const auto partners = partners_of(excesses, 3);
  ASSERT_EQ(partners.size(), 1u);
  EXPECT_EQ(partners[0].agent, 2);
  EXPECT_EQ(partners[0].situation, 6);
  EXPECT_EQ(partners[0].excess, 4);
  EXPECT_TRUE(partners_of(excesses, 6).empty());
}

TEST(Excesses, KnowGroupsBySituations) {
  Excesses excesses;
  excesses.learn_group({0, 2, 4}, {10, 12, 14}, {1, false, 8});
  const std::size_t bytes = excesses.bytes();
  excesses.learn_group({0, 2, 4}, {10, 12, 14}, {3, false, 2});
  EXPECT_EQ(excesses.bytes(), bytes);
  EXPECT_TRUE(same(excesses.of_group({10, 12, 14}), {3, false, 8}));
  EXPECT_TRUE(same(excesses.of_group({10, 12, 15}), Known()));
  excesses.learn_group({0, 2, 4}, {10, 12, 15}, {1, true, 1});
  EXPECT_GT(excesses.bytes(), bytes);
  EXPECT_TRUE(same(excesses.of_group({10, 12, 14}), {3, false, 8}));
  EXPECT_TRUE(same(excesses.of_group({10, 12, 15}), {1, true, 1}));
}

TEST(Excesses, ListGroupsUnderTheirNewestSituation) {
  Excesses excesses;
  excesses.learn_group({0, 2, 4}, {10, 32, 14}, {1, false, 8});
  excesses.learn_group({1, 2, 3}, {11, 32, 13}, {2, false, 8});
  excesses.learn_group({1, 2, 3}, {11, 12, 33}, {3, false, 8});
  std::vector<Excesses::Group> listed;
  for (const Situations::Id id : {10, 11, 12, 13, 14, 32})
    excesses.groups_listed_under(id, [&](const auto& group) { listed.push_back(group); });
  ASSERT_EQ(listed.size(), 2u);
  EXPECT_EQ(listed[0].agents, (std::vector<AgentIndex>{0, 2, 4}));
  EXPECT_EQ(listed[1].agents, (std::vector<AgentIndex>{1, 2, 3}));
  EXPECT_EQ(listed[1].known.excess, 2);
  EXPECT_TRUE(listed[0].is_in({10, 0, 32, 0, 14}));
  EXPECT_FALSE(listed[0].is_in({10, 0, 32, 0, 15}));
}

struct TwoWorkers : testing::NodeAtHand {
  TwoWorkers()
      : NodeAtHand({"..."}, {{{0, 0}, Position{2, 0}}}),
        other(planner, memory.common(), options.tuning.path_set_nodes) {}

  Memory other;
};

// What one finds out it knows at once, the others when it is handed over.
TEST(Memory, IsTheWorkersOwnUntilItIsCommon) {
  TwoWorkers s;
  const Situations::Id id = s.view.situation(0);
  s.memory.learn(id, {7, true});
  s.memory.learn_pair(1, 2, 1, {3, true, 1});
  s.memory.learn_group({0, 1, 2}, {1, 2, 3}, {5, false, 1});
  EXPECT_EQ(s.memory.known(id).at_least, 7);
  EXPECT_EQ(s.memory.of_pair(1, 2).excess, 3);
  EXPECT_EQ(s.memory.of_group({1, 2, 3}).excess, 5);
  EXPECT_EQ(partners_of(s.memory, 1).size(), 1u);
  EXPECT_EQ(s.other.known(id).at_least, 0);
  EXPECT_EQ(s.other.of_pair(1, 2).excess, 0);
  EXPECT_EQ(s.other.of_group({1, 2, 3}).excess, 0);
  EXPECT_TRUE(partners_of(s.other, 1).empty());

  const FoundOut found = s.memory.take_found();
  EXPECT_EQ(s.memory.known(id).at_least, 0);
  s.memory.common()->learn(found);
  for (const Memory* memory : {&s.memory, &s.other}) {
    EXPECT_EQ(memory->known(id).at_least, 7);
    EXPECT_EQ(memory->of_pair(1, 2).excess, 3);
    EXPECT_EQ(memory->of_group({1, 2, 3}).excess, 5);
    EXPECT_EQ(partners_of(*memory, 1).size(), 1u);
  }
}

TEST(Memory, ForgetsWhatWasNotHandedOverWhenItTurnsToAnother) {
  TwoWorkers s;
  s.memory.learn_pair(1, 2, 1, {3, true, 1});
  s.memory.turn_to(s.memory.common());  // the same: nothing happens
  EXPECT_EQ(s.memory.of_pair(1, 2).excess, 3);
  s.memory.turn_to(std::make_shared<CommonMemory>(CommonMemory::Successor()));
  EXPECT_EQ(s.memory.of_pair(1, 2).excess, 0);
  EXPECT_TRUE(s.memory.take_found().pairs.empty());
  EXPECT_TRUE(s.memory.common()->follows_another);
}

TEST(Memory, MakesASetOfPathsOnce) {
  TwoWorkers s;
  const Situations::Id id = s.view.situation(0);
  const auto ask = [&](Memory& memory) {
    return memory.paths(id, 0, s.view.order(0), s.view.constraints(0), 2, s.limits);
  };
  const OptimalPaths* paths = ask(s.memory);
  ASSERT_TRUE(paths);
  EXPECT_FALSE(paths->empty());
  EXPECT_EQ(ask(s.memory), paths);
  const std::int64_t nodes = s.planner.optimal_nodes();
  s.memory.common()->learn(s.memory.take_found());
  EXPECT_EQ(ask(s.other), s.memory.common()->path_sets.find(id).get());
  EXPECT_EQ(s.planner.optimal_nodes(), nodes);
}

TEST(PathSets, ForgetWhatWasNotAskedForLately) {
  TwoWorkers s;
  const auto set =
      PathSets::make(s.planner, 0, s.view.order(0), s.view.constraints(0), 2, 1000, s.limits);
  ASSERT_TRUE(set);
  PathSets one;
  one.add(0, set);
  constexpr int kYoung = 100;
  PathSets sets(kYoung * one.bytes());
  const auto add = [&](Situations::Id first, Situations::Id end) {
    for (Situations::Id id = first; id < end; ++id) sets.add(id, set);
    sets.trim();
  };
  add(0, kYoung);
  for (Situations::Id id = 0; id < kYoung; ++id) EXPECT_EQ(sets.find(id), set);  // old
  add(0, 10);                                                                    // young again
  add(0, 10);
  EXPECT_EQ(sets.bytes(), kYoung * one.bytes());
  add(kYoung, 2 * kYoung - 10);
  for (Situations::Id id = 0; id < 2 * kYoung - 10; ++id)
    EXPECT_EQ(sets.find(id) != nullptr, id < 10 || id >= kYoung);
  EXPECT_EQ(sets.bytes(), kYoung * one.bytes());
  add(2 * kYoung, 4 * kYoung);
  EXPECT_EQ(sets.bytes(), 2 * kYoung * one.bytes());
}

}  // namespace memory_test
}  // namespace grove::detail
