// SPDX-License-Identifier: MIT
#include "search/result_cache.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/search/root_fixture.h"

namespace grove::detail {
namespace result_cache_test {

using ExcessBound = DependencyTable::ExcessBound;

bool same(const ExcessBound& a, const ExcessBound& b) {
  return a.excess == b.excess && a.exact == b.exact && a.expansions == b.expansions;
}

std::vector<DependencyTable::Partner> partners_of(const auto& memory, SubproblemTable::Id id) {
  std::vector<DependencyTable::Partner> partners;
  memory.partners(id, partners);
  return partners;
}

std::vector<DependencyTable::Group> groups_at(const auto& memory,
                                              const std::vector<SubproblemTable::Id>& now) {
  std::vector<DependencyTable::Group> groups;
  memory.groups_at(now, [&](const DependencyTable::Group& group) { groups.push_back(group); });
  return groups;
}

TEST(DependencyTable, KeepsTheStrongerBound) {
  const SubproblemTable subproblems;
  DependencyTable table(subproblems);
  EXPECT_TRUE(same(table.of_pair(3, 5), ExcessBound()));
  table.merge_pair(3, 5, 1, {2, false, 16});
  table.merge_pair(3, 5, 1, {2, true, 4});
  table.merge_pair(3, 5, 1, {1, false, 1});
  EXPECT_TRUE(same(table.of_pair(3, 5), {2, true, 16}));
  EXPECT_TRUE(same(table.of_pair(5, 3), ExcessBound()));
  EXPECT_TRUE(same(table.of_pair(3, 6), ExcessBound()));
}

TEST(DependencyTable, ListsPartnersWithExcessOnce) {
  const SubproblemTable subproblems;
  DependencyTable table(subproblems);
  table.merge_pair(3, 5, 1, {0, true, 1});
  EXPECT_TRUE(partners_of(table, 3).empty());
  table.merge_pair(3, 6, 2, {1, false, 1});
  table.merge_pair(3, 6, 2, {4, false, 1});
  table.merge_pair(3, 6, 2, {2, false, 1});
  const auto partners = partners_of(table, 3);
  ASSERT_EQ(partners.size(), 1u);
  EXPECT_EQ(partners[0].agent, 2);
  EXPECT_EQ(partners[0].subproblem, 6);
  EXPECT_EQ(partners[0].excess, 4);
  EXPECT_TRUE(partners_of(table, 6).empty());
}

// Identifies subproblems by agent, number of constraints and kind of constraints.
class DependencyTableGroups : public ::testing::Test {
 protected:
  using Id = SubproblemTable::Id;

  Id id(AgentIndex agent, int constraints, Cell kind = 0) {
    std::vector<Constraint> list;
    for (int i = 0; i < constraints; ++i) list.push_back({kind, kNoCell, i, i});
    canonical(list);
    return subproblems_.id(agent, order_, list);
  }

  const AgentSequencing order_;
  SubproblemTable subproblems_;
  DependencyTable table_{subproblems_};
};

TEST_F(DependencyTableGroups, AreIdentifiedByTheirSubproblems) {
  const std::vector<Id> some{id(0, 1), id(2, 0), id(4, 2)};
  const std::vector<Id> others{id(0, 1), id(2, 0), id(4, 3)};
  EXPECT_TRUE(table_.merge_group({0, 2, 4}, some, {1, false, 8}));
  const std::size_t bytes = table_.bytes();
  EXPECT_TRUE(table_.merge_group({0, 2, 4}, some, {3, false, 2}));
  EXPECT_FALSE(table_.merge_group({0, 2, 4}, some, {2, false, 2}));
  EXPECT_EQ(table_.bytes(), bytes);
  EXPECT_TRUE(same(table_.of_group(some), {3, false, 8}));
  EXPECT_TRUE(same(table_.of_group(others), ExcessBound()));
  table_.merge_group({0, 2, 4}, others, {1, true, 1});
  EXPECT_GT(table_.bytes(), bytes);
  EXPECT_TRUE(same(table_.of_group(some), {3, false, 8}));
  EXPECT_TRUE(same(table_.of_group(others), {1, true, 1}));
}

TEST_F(DependencyTableGroups, AreFoundOnceIfAllSubproblemsMatch) {
  const Id constrained = id(2, 2);
  table_.merge_group({0, 2, 3}, {id(0, 0), constrained, id(3, 1)}, {1, false, 8});
  table_.merge_group({1, 2, 3}, {id(1, 0), constrained, id(3, 0)}, {2, false, 8});
  table_.merge_group({0, 1, 2}, {id(0, 0), id(1, 0), id(2, 0)}, {3, false, 8});
  const auto now = [&](int of_1, int of_3) {
    return std::vector<Id>{id(0, 0), id(1, of_1), constrained, id(3, of_3)};
  };
  EXPECT_EQ(groups_at(table_, now(1, 2)).size(), 0u);
  EXPECT_EQ(groups_at(table_, now(1, 0)).size(), 0u);
  const auto one = groups_at(table_, now(1, 1));
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].agents, (std::vector<AgentIndex>{0, 2, 3}));
  const auto other = groups_at(table_, now(0, 0));
  ASSERT_EQ(other.size(), 1u);
  EXPECT_EQ(other[0].agents, (std::vector<AgentIndex>{1, 2, 3}));
  EXPECT_EQ(other[0].known.excess, 2);
}

// A group is listed under its two rarest subproblems, which are here those of agents 1 and 3.
TEST_F(DependencyTableGroups, AreDistinctIfOneSubproblemDiffers) {
  for (AgentIndex differs : {0, 2, 4}) {
    const auto at = [&](Cell kind) {
      std::vector<Id> ids;
      for (AgentIndex agent = 0; agent < 5; ++agent)
        ids.push_back(id(agent, agent % 2 == 1 ? 3 : 1, agent == differs ? kind : 0));
      return ids;
    };
    DependencyTable table(subproblems_);
    table.merge_group({0, 1, 2, 3, 4}, at(1), {1, false, 8});
    table.merge_group({0, 1, 2, 3, 4}, at(2), {2, false, 8});
    for (int kind : {1, 2}) {
      EXPECT_EQ(table.of_group(at(kind)).excess, kind);
      const auto found = groups_at(table, at(kind));
      ASSERT_EQ(found.size(), 1u);
      EXPECT_EQ(found[0].known.excess, kind);
    }
    EXPECT_EQ(table.of_group(at(3)).excess, 0);
    EXPECT_TRUE(groups_at(table, at(3)).empty());
  }
}

// A query examines only groups whose two rarest subproblems match, even if many groups contain a
// subproblem that all nodes share.
TEST_F(DependencyTableGroups, AreListedUnderTheirRarestSubproblems) {
  for (int kind = 0; kind < 50; ++kind)
    table_.merge_group({0, 1, 2}, {id(0, 0), id(1, 1, kind), id(2, 2, kind)}, {kind, false, 1});
  const auto examined = [&](const std::vector<Id>& now) {
    return table_.groups_at(now, [](const auto&) {});
  };
  EXPECT_EQ(examined({id(0, 0), id(1, 0), id(2, 0)}), 0);
  EXPECT_EQ(examined({id(0, 0), id(1, 1, 7), id(2, 2, 8)}), 0);
  EXPECT_EQ(examined({id(0, 0), id(1, 1, 7), id(2, 2, 7)}), 1);
  EXPECT_EQ(examined({id(0, 5), id(1, 1, 7), id(2, 2, 7)}), 1);
  const auto found = groups_at(table_, {id(0, 0), id(1, 1, 7), id(2, 2, 7)});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].known.excess, 7);
}

// Entries that other workers or ranks send arrive in a different order.
TEST_F(DependencyTableGroups, DoNotDependOnTheNumberingOfSubproblems) {
  const std::vector<int> constraint_counts{3, 0, 2, 1};
  const std::vector<Constraint> elsewhere{{7, kNoCell, 0, 0}};
  for (int last = 0; last < 4; ++last) {
    SubproblemTable subproblems;
    DependencyTable table(subproblems);
    std::vector<Id> now(4);
    for (int i = 0; i < 4; ++i) {
      const AgentIndex agent = (last + 1 + i) % 4;
      std::vector<Constraint> list;
      for (int c = 0; c < constraint_counts[static_cast<std::size_t>(agent)]; ++c)
        list.push_back({0, kNoCell, c, c});
      now[static_cast<std::size_t>(agent)] = subproblems.id(agent, order_, list);
    }
    table.merge_group({0, 1, 2, 3}, now, {1, false, 1});
    for (std::size_t other = 0; other < 4; ++other) {
      std::vector<Id> differing = now;
      differing[other] = subproblems.id(static_cast<AgentIndex>(other), order_, elsewhere);
      const bool is_of_the_rarest_two = other == 0 || other == 2;
      EXPECT_EQ(table.groups_at(differing, [](const auto&) {}), is_of_the_rarest_two ? 0 : 1);
    }
  }
}

struct TwoWorkers : testing::RootFixture {
  TwoWorkers()
      : RootFixture({"..."}, {{{0, 0}, Position{2, 0}}}),
        other(planner, memory.common(), options.tuning.mdd_nodes) {}

  WorkerCache other;
};

// A worker reads its own new entries immediately; other workers read them only after they have been
// published.
TEST(WorkerCache, IsPrivateUntilPublished) {
  TwoWorkers s;
  const SubproblemTable::Id id = s.view.subproblem(0);
  std::vector<SubproblemTable::Id> trio;
  for (AgentIndex agent = 0; agent < 3; ++agent)
    trio.push_back(s.memory.id(agent, s.view.order(0), {}));
  std::vector<SubproblemTable::Id> elsewhere = trio;
  elsewhere[2] = s.memory.id(2, s.view.order(0), std::array{Constraint{1, kNoCell, 0, 0}});
  s.memory.merge(id, {7, true});
  s.memory.merge_pair(1, 2, 1, {3, true, 1});
  s.memory.merge_group({0, 1, 2}, trio, {5, false, 1});
  EXPECT_EQ(s.memory.known(id).lower_bound, 7);
  EXPECT_EQ(s.memory.of_pair(1, 2).excess, 3);
  EXPECT_EQ(s.memory.of_group(trio).excess, 5);
  EXPECT_EQ(groups_at(s.memory, trio).size(), 1u);
  EXPECT_TRUE(groups_at(s.memory, elsewhere).empty());
  EXPECT_EQ(partners_of(s.memory, 1).size(), 1u);
  EXPECT_EQ(s.other.known(id).lower_bound, 0);
  EXPECT_EQ(s.other.of_pair(1, 2).excess, 0);
  EXPECT_EQ(s.other.of_group(trio).excess, 0);
  EXPECT_TRUE(groups_at(s.other, trio).empty());
  EXPECT_TRUE(partners_of(s.other, 1).empty());

  const CacheDelta found = s.memory.take_delta();
  EXPECT_EQ(s.memory.known(id).lower_bound, 0);
  s.memory.common()->merge(found);
  for (const WorkerCache* memory : {&s.memory, &s.other}) {
    EXPECT_EQ(memory->known(id).lower_bound, 7);
    EXPECT_EQ(memory->of_pair(1, 2).excess, 3);
    EXPECT_EQ(memory->of_group(trio).excess, 5);
    EXPECT_EQ(groups_at(*memory, trio).size(), 1u);
    EXPECT_TRUE(groups_at(*memory, elsewhere).empty());
    EXPECT_EQ(partners_of(*memory, 1).size(), 1u);
  }
}

TEST(WorkerCache, DropsUnpublishedEntriesWhenItSwitchesCaches) {
  TwoWorkers s;
  s.memory.merge_pair(1, 2, 1, {3, true, 1});
  s.memory.use_shared_cache(s.memory.common());  // same cache: no effect
  EXPECT_EQ(s.memory.of_pair(1, 2).excess, 3);
  s.memory.use_shared_cache(std::make_shared<SharedCache>(SharedCache::Successor()));
  EXPECT_EQ(s.memory.of_pair(1, 2).excess, 0);
  EXPECT_TRUE(s.memory.take_delta().pairs.empty());
  EXPECT_TRUE(s.memory.common()->follows_another);
}

TEST(WorkerCache, BuildsAnMddOnce) {
  TwoWorkers s;
  const SubproblemTable::Id id = s.view.subproblem(0);
  const auto ask = [&](WorkerCache& memory) {
    return memory.paths(id, 0, s.view.order(0), s.view.constraints(0), 2, s.limits);
  };
  const Mdd* paths = ask(s.memory);
  ASSERT_TRUE(paths);
  EXPECT_FALSE(paths->empty());
  EXPECT_EQ(ask(s.memory), paths);
  const std::int64_t nodes = s.planner.mdd_nodes();
  s.memory.common()->merge(s.memory.take_delta());
  EXPECT_EQ(ask(s.other), s.memory.common()->mdds.find(id).get());
  EXPECT_EQ(s.planner.mdd_nodes(), nodes);
}

TEST(MddCache, DropsMddsThatWereNotUsedRecently) {
  TwoWorkers s;
  const auto set =
      MddCache::make(s.planner, 0, s.view.order(0), s.view.constraints(0), 2, 1000, s.limits);
  ASSERT_TRUE(set);
  MddCache one;
  one.add(0, set);
  constexpr int kYoung = 100;
  MddCache sets(kYoung * one.bytes());
  const auto add = [&](SubproblemTable::Id first, SubproblemTable::Id end) {
    for (SubproblemTable::Id id = first; id < end; ++id) sets.add(id, set);
    sets.trim();
  };
  add(0, kYoung);
  for (SubproblemTable::Id id = 0; id < kYoung; ++id) EXPECT_EQ(sets.find(id), set);  // now old
  add(0, 10);                                                                         // young again
  add(0, 10);
  EXPECT_EQ(sets.bytes(), kYoung * one.bytes());
  add(kYoung, 2 * kYoung - 10);
  for (SubproblemTable::Id id = 0; id < 2 * kYoung - 10; ++id)
    EXPECT_EQ(sets.find(id) != nullptr, id < 10 || id >= kYoung);
  EXPECT_EQ(sets.bytes(), kYoung * one.bytes());
  add(2 * kYoung, 4 * kYoung);
  EXPECT_EQ(sets.bytes(), 2 * kYoung * one.bytes());
}

}  // namespace result_cache_test
}  // namespace grove::detail
