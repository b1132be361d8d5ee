// SPDX-License-Identifier: MIT
#include "mpi/bound_broadcast.h"

#include <gtest/gtest.h>

#include <deque>
#include <limits>

#include "mpi/polling.h"

namespace grove::detail {
namespace bound_broadcast_test {

constexpr double kPlenty = 1e12;

LearnedBound bound(AgentIndex agent, std::int32_t expansions = 0) {
  return {{{0, agent, {}}}, {7, true}, {0, false, expansions}};
}

void add_bounds(int count, BoundBroadcast& broadcast) {
  for (int i = 0; i < count; ++i) broadcast.add(bound(i, i));
}

class Ranks : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, Ranks, ::testing::Values(2, 3, 4, 5, 7, 8, 13, 16, 31, 64, 100));

TEST_P(Ranks, ReceiveEachBoundOnceFromAnyFinder) {
  const int ranks = GetParam();
  for (const int finder : {0, ranks / 2, ranks - 1}) {
    std::deque<BoundBroadcast> all;
    for (int rank = 0; rank < ranks; ++rank) all.emplace_back(rank, ranks, kPlenty);
    std::vector<int> received(static_cast<std::size_t>(ranks));
    all[finder].add(bound(3));
    int rounds = 1;
    for (bool any_sent = true; any_sent; ++rounds) {
      any_sent = false;
      std::vector<BoundBroadcast::OutgoingMessage> in_transit;
      for (BoundBroadcast& one : all)
        for (auto& sent : one.due(rounds)) in_transit.push_back(std::move(sent));
      for (auto& [to, message] : in_transit) {
        any_sent = true;
        ASSERT_EQ(message.facts.size(), 1u);
        ++received[to];
        all[to].add(1, std::move(message.facts[0]), message.reach);
      }
    }
    for (int rank = 0; rank < ranks; ++rank)
      EXPECT_EQ(received[rank], rank == finder ? 0 : 1) << "rank " << rank << " of " << ranks;
    EXPECT_LE(1 << (rounds - 3), ranks) << "the number of rounds is logarithmic";
  }
}

TEST(BoundBroadcast, IsOffWithOneRankOrRateZero) {
  EXPECT_FALSE(BoundBroadcast(0, 1, 1e6).is_on());
  EXPECT_FALSE(BoundBroadcast(0, 9, 0).is_on());
  EXPECT_TRUE(BoundBroadcast(0, 2, 1).is_on());
}

TEST(BoundBroadcast, KeepsTheRateAndSendsByDecreasingUtility) {
  constexpr double kRate = 5e4;
  BoundBroadcast broadcast(0, 2, kRate);
  broadcast.due(0);
  add_bounds(1500, broadcast);
  double bytes_sent = 0;
  double last = 1e9;
  int count = 0;
  double now = 0;
  for (; broadcast.next_send_time() < 100; now = broadcast.next_send_time())
    for (const auto& [to, message] : broadcast.due(now)) {
      EXPECT_EQ(to, 1);
      EXPECT_EQ(message.reach, 1);
      for (const std::string& received : message.facts) {
        ++count;
        bytes_sent += static_cast<double>(received.size() + 1);
        const double utility = message::unpacked(received).utility();
        EXPECT_LE(utility, last);
        last = utility;
      }
      EXPECT_LE(bytes_sent, kRate * (now + 0.011));
    }
  EXPECT_EQ(count, 1500);
  EXPECT_GT(now, 0.5);
}

TEST(BoundBroadcast, SendIntervalGrowsWithTheRun) {
  BoundBroadcast broadcast(0, 2, 1e4);
  add_bounds(3000, broadcast);
  for (const double now : {0.0, 1.0, 100.0}) {
    broadcast.due(now);
    EXPECT_EQ(broadcast.next_send_time(), now + pause_at(now, 1e-3));
  }
}

TEST(BoundBroadcast, SendRateFallsWithTheRun) {
  constexpr double kRate = 1e5;
  const auto bytes_sent_in_a_second_after = [&](double begin) {
    BoundBroadcast broadcast(0, 2, kRate);
    add_bounds(2000, broadcast);
    broadcast.due(begin);  // uses up the accumulated allowance
    double bytes_sent = 0;
    for (double now = begin; now < begin + 1; now += 1e-3) {
      add_bounds(10, broadcast);
      for (const auto& [to, message] : broadcast.due(now))
        for (const std::string& received : message.facts)
          bytes_sent += static_cast<double>(received.size() + 1);
    }
    return bytes_sent;
  };
  EXPECT_NEAR(bytes_sent_in_a_second_after(0), kRate, kRate / 10);
  EXPECT_NEAR(bytes_sent_in_a_second_after(100), kRate / 100, kRate / 500);
}

// A bound that is too long for the current rate is sent later or never, and does not delay the
// others.
TEST(BoundBroadcast, IsNotDelayedByALongBound) {
  for (const int constraints : {150, 20'000}) {
    BoundBroadcast broadcast(0, 2, 1e6);
    broadcast.due(36'000);
    LearnedBound expensive;
    expensive.agents.emplace_back(0, 0, PackedConstraints(std::vector<Constraint>(constraints)));
    expensive.excess = {1, true, 1'000'000'000};
    broadcast.add(expensive);
    add_bounds(100, broadcast);
    std::size_t count = 0;
    for (double now = 36'000; now < 43'200; now += 10)
      for (const auto& sent : broadcast.due(now)) count += sent.facts.facts.size();
    EXPECT_GE(count, 100u);
  }
}

// If too many bounds are waiting, those with the least utility are dropped.
TEST(BoundBroadcast, LimitsTheNumberOfWaitingBounds) {
  BoundBroadcast broadcast(0, 2, kPlenty);
  for (int i = 0; i < 30; ++i) add_bounds(1000, broadcast);
  std::size_t count = 0;
  for (const auto& sent : broadcast.due(1)) count += sent.facts.facts.size();
  EXPECT_LT(count, 2500u);
  EXPECT_GT(count, 900u);
  EXPECT_EQ(broadcast.next_send_time(), std::numeric_limits<double>::infinity());
}

}  // namespace bound_broadcast_test
}  // namespace grove::detail
