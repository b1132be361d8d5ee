// SPDX-License-Identifier: MIT
#include "mpi/broker.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace broker_test {

message::Status with(std::vector<Frontier::Level> levels) {
  message::Status status;
  for (const Frontier::Level& level : levels) status.open += level.open;
  status.idle = status.open == 0;
  status.levels = std::move(levels);
  return status;
}

TEST(Broker, WhoHasNothingIsGivenHalfOfTheBest) {
  Broker broker(2);
  EXPECT_FALSE(broker.next());
  broker.heard(0, with({{10, 6}, {11, 40}}));
  const auto gift = broker.next();
  ASSERT_TRUE(gift);
  EXPECT_EQ(gift->from, 0);
  EXPECT_EQ(gift->to, 1);
  EXPECT_EQ(gift->nodes, 3);
}

TEST(Broker, NobodyIsGivenMoreBeforeTheLastHasArrived) {
  Broker broker(2);
  broker.heard(0, with({{10, 600}}));
  EXPECT_TRUE(broker.next());
  EXPECT_FALSE(broker.next());
  broker.heard(1, with({}));
  EXPECT_FALSE(broker.next());
  broker.arrived(1);
  EXPECT_TRUE(broker.next());
}

TEST(Broker, TheLastNodeOfARankStays) {
  Broker broker(2);
  broker.heard(0, with({{10, 1}}));
  EXPECT_FALSE(broker.next());
  broker.heard(0, with({{10, 1}, {12, 1}}));
  EXPECT_TRUE(broker.next()) << "the worse one can be spared";
}

TEST(Broker, OneGiverServesSeveralWhileItHasSome) {
  Broker broker(4);
  broker.heard(0, with({{10, 8}}));
  std::vector<int> given;
  while (const auto gift = broker.next()) given.push_back(gift->to);
  EXPECT_EQ(given.size(), 3);
}

TEST(Broker, WorkFarAboveTheBoundIsReplacedWhereThereIsPlentyOfBetter) {
  Broker broker(2);
  broker.heard(1, with({{15, 50}}));
  broker.arrived(1);
  broker.heard(0, with({{10, 4}}));
  EXPECT_FALSE(broker.next()) << "not for a few nodes";
  broker.heard(0, with({{10, 400}}));
  const auto gift = broker.next();
  ASSERT_TRUE(gift);
  EXPECT_EQ(gift->to, 1);
}

}  // namespace broker_test
}  // namespace grove::detail
