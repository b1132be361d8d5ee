// SPDX-License-Identifier: MIT
#include "mpi/load_balancer.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::detail {
namespace broker_test {

// Ranks, each below a coordinator of its own children.
std::vector<std::vector<int>> alone(int ranks) {
  std::vector<std::vector<int>> children;
  for (int rank = 0; rank < ranks; ++rank) children.push_back({rank});
  return children;
}

message::Status with(int rank, Cost bound, std::int64_t surplus) {
  message::Status status;
  if (surplus > 0) status.surplus = {{bound, surplus}};
  status.work_requests = {{rank, bound == kInfiniteCost, bound}};
  return status;
}

TEST(LoadBalancer, WhoHasNothingIsGivenWhatCanBeSpared) {
  LoadBalancer broker(alone(2));
  EXPECT_FALSE(broker.next());
  broker.heard(0, with(0, 10, 3));
  const auto gift = broker.next();
  ASSERT_TRUE(gift);
  EXPECT_EQ(gift->from, 0);
  EXPECT_EQ(gift->to, 1);
  EXPECT_EQ(gift->nodes, 3);
}

TEST(LoadBalancer, NobodyIsGivenMoreBeforeTheLastHasArrived) {
  LoadBalancer broker(alone(2));
  broker.heard(0, with(0, 10, 300));
  EXPECT_TRUE(broker.next());
  EXPECT_FALSE(broker.next());
  broker.heard(1, with(1, kInfiniteCost, 0));
  EXPECT_FALSE(broker.next());
  broker.arrived(1);
  EXPECT_TRUE(broker.next());
}

TEST(LoadBalancer, TheSecondBestBoundWillDo) {
  LoadBalancer broker(alone(3), {.transfer_nodes = 1});
  message::Status status = with(0, 10, 1);
  status.surplus.push_back({11, 1});
  broker.heard(0, status);
  for (int gifts = 0; gifts < 2; ++gifts) EXPECT_TRUE(broker.next());
  EXPECT_FALSE(broker.next());
}

TEST(LoadBalancer, OneGiverServesSeveralWhileItHasSome) {
  LoadBalancer broker(alone(4), {.transfer_nodes = 2});
  broker.heard(0, with(0, 10, 5));
  std::vector<int> given;
  std::int64_t nodes = 0;
  while (const auto gift = broker.next()) {
    given.push_back(gift->to);
    nodes += gift->nodes;
  }
  EXPECT_EQ(given, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(nodes, 5);
}

TEST(LoadBalancer, WorkFarAboveTheBoundIsReplacedWhereThereIsPlentyOfBetter) {
  LoadBalancer broker(alone(2));
  broker.heard(1, with(1, 15, 25));
  broker.heard(0, with(0, 10, 2));
  EXPECT_FALSE(broker.next()) << "not for a few nodes";
  broker.heard(0, with(0, 10, 200));
  const auto gift = broker.next();
  ASSERT_TRUE(gift);
  EXPECT_EQ(gift->to, 1);
}

TEST(LoadBalancer, NextNodesAreForIdleRanksOnly) {
  LoadBalancer broker(alone(3), {.min_surplus_nodes = 1});
  broker.heard(1, with(1, 15, 0));
  broker.heard(2, with(2, kInfiniteCost, 0));
  message::Status status = with(0, 10, 0);
  status.surplus = {{10, 0, 1}};
  broker.heard(0, status);
  const auto expect_a_node_for = [&](int rank, bool is_idle) {
    const auto gift = broker.next();
    ASSERT_TRUE(gift);
    EXPECT_EQ(gift->to, rank);
    EXPECT_EQ(gift->to_idle, is_idle);
    EXPECT_EQ(gift->nodes, 1);
  };
  expect_a_node_for(2, true);
  status.surplus = {{10, 1, 1}};
  broker.heard(0, status);
  expect_a_node_for(1, false);
  EXPECT_EQ(broker.surplus(), std::vector<message::Surplus>({{10, 0, 1}}));
}

TEST(LoadBalancer, RanksOfOneChildAreLeftToIt) {
  LoadBalancer broker({{0, 1, 2}, {3, 4, 5}});
  message::Status status;
  status.surplus = {{10, 100}};
  status.work_requests = {{1, true, kInfiniteCost}, {2, true, kInfiniteCost}};
  broker.heard(0, status);
  std::vector<int> given;
  while (const auto gift = broker.next()) {
    EXPECT_EQ(gift->from, 0);
    given.push_back(gift->to);
  }
  EXPECT_EQ(given, (std::vector<int>{3, 4})) << "there is nothing left for rank 5";
}

TEST(LoadBalancer, PassesOnWhatItCannotMatch) {
  LoadBalancer broker({{0, 1}, {2, 3}});
  message::Status status;
  using Surplus = std::vector<message::Surplus>;
  status.surplus = {{10, 6}, {11, 2}};
  broker.heard(0, status);
  status.surplus = {{11, 90}};
  broker.heard(1, status);
  EXPECT_EQ(broker.surplus(), Surplus({{10, 6}, {11, 92}}));
  EXPECT_TRUE(broker.work_requests().empty());
  EXPECT_EQ(broker.donor(6), 0);
  EXPECT_EQ(broker.surplus(), Surplus({{11, 92}}));
  EXPECT_EQ(broker.donor(100), 1);
  EXPECT_EQ(broker.surplus(), Surplus({{11, 2}}));
  EXPECT_EQ(broker.donor(100), 0);
  EXPECT_TRUE(broker.surplus().empty());
  EXPECT_EQ(broker.donor(100), 0) << "one rank has to be the donor";
}

}  // namespace broker_test
}  // namespace grove::detail
