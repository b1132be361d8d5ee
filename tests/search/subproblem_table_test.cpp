// SPDX-License-Identifier: MIT
#include "search/subproblem_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <thread>
#include <tuple>

namespace grove::detail {
namespace subproblem_table_test {

std::vector<Constraint> random_constraints(std::mt19937& random) {
  std::vector<Constraint> constraints(random() % 4);
  for (Constraint& c : constraints) {
    c.cell = static_cast<Cell>(random() % 3);
    c.begin = static_cast<Time>(random() % 2);
    c.end = c.begin + static_cast<Time>(random() % 2);
    c.kind = random() % 3 == 0 ? ConstraintKind::kNoRestBy : ConstraintKind::kVertexOrEdge;
  }
  canonical(constraints);
  return constraints;
}

TEST(SubproblemTable, IdIsUniquePerAgentOrderAndConstraints) {
  std::mt19937 random(3);
  const std::vector<AgentSequencing> orders(2);
  SubproblemTable subproblems;
  using Key = std::tuple<AgentIndex, const AgentSequencing*, std::vector<Constraint>>;
  std::map<SubproblemTable::Id, Key> keys;
  for (int round = 0; round < 3000; ++round) {
    const auto agent = static_cast<AgentIndex>(random() % 3);
    const AgentSequencing& order = orders[random() % 2];
    const auto constraints = random_constraints(random);
    const SubproblemTable::Id id = subproblems.id(agent, order, constraints);
    const Key key{agent, &order, constraints};
    if (!keys.contains(id)) {
      EXPECT_TRUE(std::ranges::none_of(keys, [&](const auto& k) { return k.second == key; }));
      EXPECT_EQ(subproblems.known(id), SubproblemTable::CostBound());
      keys.emplace(id, key);
      subproblems.merge(id, {id, true});
    }
    EXPECT_EQ(keys.at(id), key);
    const AgentSubproblem subproblem = subproblems.subproblem(id);
    EXPECT_EQ(subproblem.agent, agent);
    EXPECT_EQ(subproblem.order, &order);
    EXPECT_EQ(subproblem.constraints, PackedConstraints(constraints));
    EXPECT_EQ(subproblems.id(subproblem), id);
    EXPECT_EQ(subproblems.known(id).lower_bound, id);
  }
  EXPECT_GT(keys.size(), 500u);
  EXPECT_GT(subproblems.bytes(), keys.size() * (sizeof(AgentIndex) + sizeof(AgentSequencing*)));
}

TEST(SubproblemTable, KeepsTheStrongerBound) {
  SubproblemTable subproblems;
  const AgentSequencing order;
  const SubproblemTable::Id id = subproblems.id(0, order, {});
  subproblems.merge(id, {5, false});
  subproblems.merge(id, {3, false});
  EXPECT_EQ(subproblems.known(id), (SubproblemTable::CostBound{5, false}));
  subproblems.merge(id, {7, true});
  subproblems.merge(id, {6, false});
  EXPECT_EQ(subproblems.known(id), (SubproblemTable::CostBound{7, true}));
}

TEST(SubproblemTable, IdsAreTheSameForAllThreads) {
  const std::vector<AgentSequencing> orders(1);
  SubproblemTable subproblems;
  constexpr int kThreads = 4;
  std::vector<std::vector<SubproblemTable::Id>> ids(kThreads);
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < kThreads; ++thread)
    threads.emplace_back([&, thread] {
      std::mt19937 random(9);
      for (int round = 0; round < 2000; ++round) {
        const auto id = subproblems.id(static_cast<AgentIndex>(random() % 3), orders[0],
                                       random_constraints(random));
        subproblems.merge(id, {id, true});
        ids[static_cast<std::size_t>(thread)].push_back(id);
      }
    });
  threads.clear();
  for (int thread = 1; thread < kThreads; ++thread)
    EXPECT_EQ(ids[static_cast<std::size_t>(thread)], ids[0]);
  for (const SubproblemTable::Id id : ids[0]) EXPECT_EQ(subproblems.known(id).lower_bound, id);
}

TEST(SubproblemTable, CanonicalListsAreSortedAndUnique) {
  std::vector<Constraint> a{{1, kNoCell, 2, 3}, {0, kNoCell, 1, 1}, {1, kNoCell, 2, 3}};
  std::vector<Constraint> b{{0, kNoCell, 1, 1}, {1, kNoCell, 2, 3}};
  canonical(a);
  canonical(b);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.size(), 2u);
}

TEST(CanonicalConstraints, AreTheSameWhenAddedOneByOne) {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    std::vector<Constraint> all;
    std::vector<Constraint> grown;
    for (int i = 0; i < 6; ++i) {
      const auto cell = static_cast<Cell>(random() % 3);
      all.push_back({cell, kNoCell, 1, static_cast<Time>(1 + random() % 2)});
      add_to_canonical(grown, all.back());
    }
    canonical(all);
    ASSERT_EQ(grown, all);
  }
}

}  // namespace subproblem_table_test
}  // namespace grove::detail
