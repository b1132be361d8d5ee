// SPDX-License-Identifier: MIT
#include "mpi/load_balancer.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::detail {
namespace load_balancer_test {

// Returns one group for each rank, which contains only that rank.
std::vector<std::vector<int>> single_ranks(int ranks) {
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

TEST(LoadBalancer, IdleRankReceivesSurplusNodes) {
  LoadBalancer balancer(single_ranks(2));
  EXPECT_FALSE(balancer.next());
  balancer.update(0, with(0, 10, 3));
  const auto transfer = balancer.next();
  ASSERT_TRUE(transfer);
  EXPECT_EQ(transfer->from, 0);
  EXPECT_EQ(transfer->to, 1);
  EXPECT_EQ(transfer->nodes, 3);
}

TEST(LoadBalancer, NoSecondTransferBeforeTheFirstHasArrived) {
  LoadBalancer balancer(single_ranks(2));
  balancer.update(0, with(0, 10, 300));
  EXPECT_TRUE(balancer.next());
  EXPECT_FALSE(balancer.next());
  balancer.update(1, with(1, kInfiniteCost, 0));
  EXPECT_FALSE(balancer.next());
  balancer.arrived(1);
  EXPECT_TRUE(balancer.next());
}

TEST(LoadBalancer, TransfersNodesOfTheSecondBestBound) {
  LoadBalancer balancer(single_ranks(3), {.transfer_nodes = 1});
  message::Status status = with(0, 10, 1);
  status.surplus.push_back({11, 1});
  balancer.update(0, status);
  for (int transfers = 0; transfers < 2; ++transfers) EXPECT_TRUE(balancer.next());
  EXPECT_FALSE(balancer.next());
}

TEST(LoadBalancer, OneDonorServesSeveralRanks) {
  LoadBalancer balancer(single_ranks(4), {.transfer_nodes = 2});
  balancer.update(0, with(0, 10, 5));
  std::vector<int> given;
  std::int64_t nodes = 0;
  while (const auto transfer = balancer.next()) {
    given.push_back(transfer->to);
    nodes += transfer->nodes;
  }
  EXPECT_EQ(given, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(nodes, 5);
}

TEST(LoadBalancer, RankAboveTheBoundReceivesOnlyLargeSurplus) {
  LoadBalancer balancer(single_ranks(2));
  balancer.update(1, with(1, 15, 25));
  balancer.update(0, with(0, 10, 2));
  EXPECT_FALSE(balancer.next()) << "not for a few nodes";
  balancer.update(0, with(0, 10, 200));
  const auto transfer = balancer.next();
  ASSERT_TRUE(transfer);
  EXPECT_EQ(transfer->to, 1);
}

TEST(LoadBalancer, NextNodesAreForIdleRanksOnly) {
  LoadBalancer balancer(single_ranks(3), {.min_surplus_nodes = 1});
  balancer.update(1, with(1, 15, 0));
  balancer.update(2, with(2, kInfiniteCost, 0));
  message::Status status = with(0, 10, 0);
  status.surplus = {{10, 0, 1}};
  balancer.update(0, status);
  const auto expect_a_node_for = [&](int rank, bool is_idle) {
    const auto transfer = balancer.next();
    ASSERT_TRUE(transfer);
    EXPECT_EQ(transfer->to, rank);
    EXPECT_EQ(transfer->to_idle, is_idle);
    EXPECT_EQ(transfer->nodes, 1);
  };
  expect_a_node_for(2, true);
  status.surplus = {{10, 1, 1}};
  balancer.update(0, status);
  expect_a_node_for(1, false);
  EXPECT_EQ(balancer.surplus(), std::vector<message::Surplus>({{10, 0, 1}}));
}

TEST(LoadBalancer, LeavesTransfersWithinAChildToTheChild) {
  LoadBalancer balancer({{0, 1, 2}, {3, 4, 5}});
  message::Status status;
  status.surplus = {{10, 100}};
  status.work_requests = {{1, true, kInfiniteCost}, {2, true, kInfiniteCost}};
  balancer.update(0, status);
  std::vector<int> given;
  while (const auto transfer = balancer.next()) {
    EXPECT_EQ(transfer->from, 0);
    given.push_back(transfer->to);
  }
  EXPECT_EQ(given, (std::vector<int>{3, 4})) << "no nodes are left for rank 5";
}

TEST(LoadBalancer, ForwardsUnmatchedSurplus) {
  LoadBalancer balancer({{0, 1}, {2, 3}});
  message::Status status;
  using Surplus = std::vector<message::Surplus>;
  status.surplus = {{10, 6}, {11, 2}};
  balancer.update(0, status);
  status.surplus = {{11, 90}};
  balancer.update(1, status);
  EXPECT_EQ(balancer.surplus(), Surplus({{10, 6}, {11, 92}}));
  EXPECT_TRUE(balancer.work_requests().empty());
  EXPECT_EQ(balancer.donor(6), 0);
  EXPECT_EQ(balancer.surplus(), Surplus({{11, 92}}));
  EXPECT_EQ(balancer.donor(100), 1);
  EXPECT_EQ(balancer.surplus(), Surplus({{11, 2}}));
  EXPECT_EQ(balancer.donor(100), 0);
  EXPECT_TRUE(balancer.surplus().empty());
  EXPECT_EQ(balancer.donor(100), 0) << "one rank has to be the donor";
}

}  // namespace load_balancer_test
}  // namespace grove::detail
