// SPDX-License-Identifier: MIT
#include "lagrangian/tariff.h"

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

// Whoever was told everything, at whatever times, charges the same.
TEST(Tariff, IsTheSameForWhoWasToldOfIt) {
  std::int64_t changes = 0;
  for (std::uint64_t seed = 2; seed < 60; seed += 2) {
    SCOPED_TRACE(seed);
    const Instance instance = tiny_instance(seed);
    fuzz::Random random(seed);
    Tariff tariff(instance.world(), instance.agent_count());
    Tariff copy(instance.world(), instance.agent_count());
    std::vector<Tariff::Amount> known;
    for (int telling = 0; telling < 20; ++telling) {
      for (int i = random.below(6); i > 0; --i)
        tariff.add(random_row(instance.world(), instance.agent_count(), random));
      for (int i = random.below(20); i > 0 && tariff.count() > 0; --i, ++changes)
        tariff.set_charge(
            static_cast<Tariff::RowId>(random.below(static_cast<int>(tariff.count()))),
            random.pick<int>({0, 1, 63, 64, 8191, 8192, 1 << 16}));
      if (random.percent(30)) continue;
      copy.learn(tariff.news_for(known));
      ASSERT_EQ(copy.count(), tariff.count());
      ASSERT_EQ(copy.digest(), tariff.digest());
      ASSERT_EQ(copy.sum_of_charges(), tariff.sum_of_charges());
      for (Tariff::RowId id = 0; id < tariff.count(); ++id) {
        ASSERT_EQ(copy.row(id), tariff.row(id));
        ASSERT_EQ(copy.charge(id), tariff.charge(id));
      }
      for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
        const Path path(static_cast<std::size_t>(random.between(1, 9)),
                        instance.agent(agent).start);
        ASSERT_EQ(copy.price(agent, path), tariff.price(agent, path));
      }
      const TariffNews nothing = tariff.news_for(known);
      EXPECT_TRUE(nothing.rows.empty() && nothing.charges.empty());
    }
  }
  EXPECT_GT(changes, 3000);
}

TEST(Tariff, HasAnotherDigestWhenAnythingIsCharged) {
  const Instance instance = tiny_instance(2);
  Tariff tariff(instance.world(), instance.agent_count());
  tariff.add({.kind = Kind::kPlace, .a = 0, .time = 1});
  tariff.add({.kind = Kind::kPlace, .a = 0, .time = 2});
  const auto none = tariff.digest();
  tariff.set_charge(0, 5);
  const auto first = tariff.digest();
  tariff.set_charge(0, 0);
  EXPECT_EQ(tariff.digest(), none);
  tariff.set_charge(1, 5);
  EXPECT_NE(tariff.digest(), first);
  EXPECT_NE(tariff.digest(), none);
  EXPECT_NE(first, none);
}

TEST(Tariff, RefusesWhatItCannotBeTold) {
  const Instance instance = tiny_instance(2);
  const auto refuses = [&](TariffNews news) {
    Tariff tariff(instance.world(), instance.agent_count());
    EXPECT_THROW(tariff.learn(news), std::invalid_argument);
  };
  refuses({{{.kind = Kind::kPlace, .a = -1}}, ""});
  refuses({{{.kind = Kind::kPlace, .a = instance.world().place_count()}}, ""});
  refuses({{{.kind = Kind::kPlace, .time = -1}}, ""});
  refuses({{{.kind = Kind::kEdge, .a = 0, .b = 0}}, ""});
  refuses({{{.kind = Kind::kFinish, .a = 0, .b = instance.agent_count()}}, ""});
  const RelaxedRow row{.kind = Kind::kPlace};
  refuses({{row}, std::string{'\x00'}});          // no amount
  refuses({{row}, std::string{'\x01', '\x02'}});  // no such row
  refuses({{row}, std::string{'\x00', '\x01'}});  // less than nothing
  refuses({{row}, std::string(12, '\xff')});      // no end
}

}  // namespace
}  // namespace grove::detail::lagrangian_test
