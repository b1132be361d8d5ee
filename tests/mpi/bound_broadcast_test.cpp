// SPDX-License-Identifier: MIT
#include "mpi/bound_broadcast.h"

#include <gtest/gtest.h>

#include <deque>
#include <limits>

#include "mpi/polling.h"

namespace grove::detail {
namespace knowledge_test {

constexpr double kPlenty = 1e12;

LearnedBound fact(AgentIndex agent, std::int32_t expansions = 0) {
  return {{{0, agent, {}}}, {7, true}, {0, false, expansions}};
}

void add_facts(int count, BoundBroadcast& knowledge) {
  for (int i = 0; i < count; ++i) knowledge.add(fact(i, i));
}

class Ranks : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, Ranks, ::testing::Values(2, 3, 4, 5, 7, 8, 13, 16, 31, 64, 100));

TEST_P(Ranks, AreToldEachFactOnceByWhoeverFoundIt) {
  const int ranks = GetParam();
  for (const int finder : {0, ranks / 2, ranks - 1}) {
    std::deque<BoundBroadcast> all;
    for (int rank = 0; rank < ranks; ++rank) all.emplace_back(rank, ranks, kPlenty);
    std::vector<int> told(static_cast<std::size_t>(ranks));
    all[finder].add(fact(3));
    int rounds = 1;
    for (bool news = true; news; ++rounds) {
      news = false;
      std::vector<BoundBroadcast::OutgoingMessage> under_way;
      for (BoundBroadcast& one : all)
        for (auto& parcel : one.due(rounds)) under_way.push_back(std::move(parcel));
      for (auto& [to, message] : under_way) {
        news = true;
        ASSERT_EQ(message.facts.size(), 1u);
        ++told[to];
        all[to].add(1, std::move(message.facts[0]), message.reach);
      }
    }
    for (int rank = 0; rank < ranks; ++rank)
      EXPECT_EQ(told[rank], rank == finder ? 0 : 1) << "rank " << rank << " of " << ranks;
    EXPECT_LE(1 << (rounds - 3), ranks) << "as many rounds as the number of ranks has digits";
  }
}

TEST(BoundBroadcast, IsOffWhereThereIsNobodyToTellOrNothingMayBeSaid) {
  EXPECT_FALSE(BoundBroadcast(0, 1, 1e6).is_on());
  EXPECT_FALSE(BoundBroadcast(0, 9, 0).is_on());
  EXPECT_TRUE(BoundBroadcast(0, 2, 1).is_on());
}

TEST(BoundBroadcast, SaysNoMoreThanItMayAndTheMostWorthwhileFirst) {
  constexpr double kRate = 5e4;
  BoundBroadcast knowledge(0, 2, kRate);
  knowledge.due(0);
  add_facts(1500, knowledge);
  double said = 0;
  double last = 1e9;
  int count = 0;
  double now = 0;
  for (; knowledge.next_send_time() < 100; now = knowledge.next_send_time())
    for (const auto& [to, message] : knowledge.due(now)) {
      EXPECT_EQ(to, 1);
      EXPECT_EQ(message.reach, 1);
      for (const std::string& told : message.facts) {
        ++count;
        said += static_cast<double>(told.size() + 1);
        const double utility = message::unpacked(told).utility();
        EXPECT_LE(utility, last);
        last = utility;
      }
      EXPECT_LE(said, kRate * (now + 0.011));
    }
  EXPECT_EQ(count, 1500);
  EXPECT_GT(now, 0.5);
}

TEST(BoundBroadcast, SpeaksMoreRarelyLaterInARun) {
  BoundBroadcast knowledge(0, 2, 1e4);
  add_facts(3000, knowledge);
  for (const double now : {0.0, 1.0, 100.0}) {
    knowledge.due(now);
    EXPECT_EQ(knowledge.next_send_time(), now + pause_at(now, 1e-3));
  }
}

TEST(BoundBroadcast, SaysLessLaterInARun) {
  constexpr double kRate = 1e5;
  const auto said_in_a_second_after = [&](double begin) {
    BoundBroadcast knowledge(0, 2, kRate);
    add_facts(2000, knowledge);
    knowledge.due(begin);  // what was saved up
    double said = 0;
    for (double now = begin; now < begin + 1; now += 1e-3) {
      add_facts(10, knowledge);
      for (const auto& [to, message] : knowledge.due(now))
        for (const std::string& told : message.facts) said += static_cast<double>(told.size() + 1);
    }
    return said;
  };
  EXPECT_NEAR(said_in_a_second_after(0), kRate, kRate / 10);
  EXPECT_NEAR(said_in_a_second_after(100), kRate / 100, kRate / 500);
}

// However little may be said: what does not fit now fits later, or nobody waits for it.
TEST(BoundBroadcast, IsNotHeldUpByALongFact) {
  for (const int constraints : {150, 20'000}) {
    BoundBroadcast knowledge(0, 2, 1e6);
    knowledge.due(36'000);
    LearnedBound expensive;
    expensive.agents.emplace_back(0, 0, PackedConstraints(std::vector<Constraint>(constraints)));
    expensive.excess = {1, true, 1'000'000'000};
    knowledge.add(expensive);
    add_facts(100, knowledge);
    std::size_t count = 0;
    for (double now = 36'000; now < 43'200; now += 10)
      for (const auto& parcel : knowledge.due(now)) count += parcel.facts.facts.size();
    EXPECT_GE(count, 100u);
  }
}

// What is worth least is given up when too much waits.
TEST(BoundBroadcast, KeepsSomeHundredWaiting) {
  BoundBroadcast knowledge(0, 2, kPlenty);
  for (int i = 0; i < 30; ++i) add_facts(1000, knowledge);
  std::size_t count = 0;
  for (const auto& parcel : knowledge.due(1)) count += parcel.facts.facts.size();
  EXPECT_LT(count, 2500u);
  EXPECT_GT(count, 900u);
  EXPECT_EQ(knowledge.next_send_time(), std::numeric_limits<double>::infinity());
}

}  // namespace knowledge_test
}  // namespace grove::detail
