// SPDX-License-Identifier: MIT
#include "lagrangian/multipliers.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/fuzz/random.h"
#include "tests/lagrangian/tiny_agents.h"

namespace grove::detail::lagrangian_test {
namespace {

using Kind = RelaxedRow::Kind;

RelaxedRow random_row(const World& world, int agents, fuzz::Random& random) {
  const Time time = random.between(1, 20);
  const Place place = random.below(world.place_count());
  switch (random.below(3)) {
    case 0:
      return {.kind = Kind::kPlace, .a = place, .time = time};
    case 1:
      for (const Place next : world.neighbors(place))
        if (next > place && !std::ranges::empty(world.neighbors(next)))
          return {.kind = Kind::kEdge, .a = place, .b = next, .time = time};
      return {.kind = Kind::kPlace, .a = place, .time = time};
    default:
      return {.kind = Kind::kFinish,
              .a = 0,
              .b = random.below(agents),
              .time = time,
              .time_b = random.between(0, 9)};
  }
}

// A replica that has received all updates, at any times, has the same multipliers.
TEST(Multipliers, AreEqualInAReplicaThatReceivedAllUpdates) {
  std::int64_t changes = 0;
  for (std::uint64_t seed = 2; seed < 60; seed += 2) {
    SCOPED_TRACE(seed);
    const Instance instance = tiny_instance(seed);
    fuzz::Random random(seed);
    Multipliers multipliers(instance.world(), instance.agent_count());
    Multipliers replica(instance.world(), instance.agent_count());
    std::vector<Multipliers::Amount> known;
    for (int update = 0; update < 20; ++update) {
      for (int i = random.below(6); i > 0; --i)
        multipliers.add(random_row(instance.world(), instance.agent_count(), random));
      for (int i = random.below(20); i > 0 && multipliers.count() > 0; --i, ++changes)
        multipliers.set_multiplier(
            static_cast<Multipliers::RowId>(random.below(static_cast<int>(multipliers.count()))),
            random.pick<int>({0, 1, 63, 64, 8191, 8192, 1 << 16}));
      if (random.percent(30)) continue;
      replica.apply(multipliers.update_for(known));
      ASSERT_EQ(replica.count(), multipliers.count());
      ASSERT_EQ(replica.digest(), multipliers.digest());
      ASSERT_EQ(replica.sum(), multipliers.sum());
      for (Multipliers::RowId id = 0; id < multipliers.count(); ++id) {
        ASSERT_EQ(replica.row(id), multipliers.row(id));
        ASSERT_EQ(replica.multiplier(id), multipliers.multiplier(id));
      }
      for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
        const Path path(static_cast<std::size_t>(random.between(1, 9)),
                        instance.agent(agent).start);
        ASSERT_EQ(replica.price(agent, path), multipliers.price(agent, path));
      }
      const MultiplierUpdate nothing = multipliers.update_for(known);
      EXPECT_TRUE(nothing.rows.empty() && nothing.multipliers.empty());
    }
  }
  EXPECT_GT(changes, 3000);
}

TEST(Multipliers, DigestDiffersForOtherMultipliers) {
  const Instance instance = tiny_instance(2);
  Multipliers multipliers(instance.world(), instance.agent_count());
  multipliers.add({.kind = Kind::kPlace, .a = 0, .time = 1});
  multipliers.add({.kind = Kind::kPlace, .a = 0, .time = 2});
  const auto none = multipliers.digest();
  multipliers.set_multiplier(0, 5);
  const auto first = multipliers.digest();
  multipliers.set_multiplier(0, 0);
  EXPECT_EQ(multipliers.digest(), none);
  multipliers.set_multiplier(1, 5);
  EXPECT_NE(multipliers.digest(), first);
  EXPECT_NE(multipliers.digest(), none);
  EXPECT_NE(first, none);
}

TEST(Multipliers, RefusesInvalidUpdates) {
  const Instance instance = tiny_instance(2);
  const auto refuses = [&](MultiplierUpdate update) {
    Multipliers multipliers(instance.world(), instance.agent_count());
    EXPECT_THROW(multipliers.apply(update), std::invalid_argument);
  };
  refuses({{{.kind = Kind::kPlace, .a = -1}}, ""});
  refuses({{{.kind = Kind::kPlace, .a = instance.world().place_count()}}, ""});
  refuses({{{.kind = Kind::kPlace, .time = -1}}, ""});
  refuses({{{.kind = Kind::kEdge, .a = 0, .b = 0}}, ""});
  refuses({{{.kind = Kind::kFinish, .a = 0, .b = instance.agent_count()}}, ""});
  const RelaxedRow row{.kind = Kind::kPlace};
  refuses({{row}, std::string{'\x00'}});          // a row without an amount
  refuses({{row}, std::string{'\x01', '\x02'}});  // no such row
  refuses({{row}, std::string{'\x00', '\x01'}});  // a negative multiplier
  refuses({{row}, std::string(12, '\xff')});      // a number that does not end
}

}  // namespace
}  // namespace grove::detail::lagrangian_test
