// SPDX-License-Identifier: MIT
#include "grove/search/situations.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace grove {
namespace {

std::vector<Constraint> random_constraints(std::mt19937& random) {
  std::vector<Constraint> constraints(random() % 4);
  for (Constraint& c : constraints) {
    c.cell = static_cast<Cell>(random() % 3);
    c.begin = static_cast<Time>(random() % 2);
    c.end = c.begin + static_cast<Time>(random() % 2);
    c.kind = random() % 3 == 0 ? ConstraintKind::kNoRestBy : ConstraintKind::kBar;
  }
  canonical(constraints);
  return constraints;
}

TEST(Situations, AreTheSameIfAgentOrderAndConstraintsAre) {
  std::mt19937 random(3);
  const std::vector<AgentOrder> orders(2);
  Situations situations;
  std::vector<std::tuple<AgentIndex, const AgentOrder*, std::vector<Constraint>>> keys;
  std::vector<Situations::Id> ids;
  for (int round = 0; round < 3000; ++round) {
    const auto agent = static_cast<AgentIndex>(random() % 3);
    const AgentOrder& order = orders[random() % 2];
    const auto constraints = random_constraints(random);
    const Situations::Id id = situations.id(agent, order, constraints);
    const std::tuple key{agent, &order, constraints};
    if (static_cast<std::size_t>(id) == keys.size()) {
      EXPECT_EQ(std::ranges::count(keys, key), 0);
      keys.push_back(key);
      situations.known(id) = {id, true};
    }
    ASSERT_LT(static_cast<std::size_t>(id), keys.size());
    EXPECT_EQ(keys[id], key);
    EXPECT_EQ(situations.known(id).at_least, id);
  }
  EXPECT_GT(keys.size(), 500u);
  EXPECT_GT(situations.bytes(), keys.size() * sizeof(Constraint));
  situations.clear();
  EXPECT_EQ(situations.id(2, orders[0], {}), 0);
  EXPECT_FALSE(situations.known(0).exact);
}

TEST(Situations, CanonicalListsHaveOneOrderAndNoRepeats) {
  std::vector<Constraint> a{{1, kNoCell, 2, 3}, {0, kNoCell, 1, 1}, {1, kNoCell, 2, 3}};
  std::vector<Constraint> b{{0, kNoCell, 1, 1}, {1, kNoCell, 2, 3}};
  canonical(a);
  canonical(b);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.size(), 2u);
}

}  // namespace
}  // namespace grove
