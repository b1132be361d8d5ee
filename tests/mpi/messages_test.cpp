// SPDX-License-Identifier: MIT
#include "mpi/messages.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace grove::detail {
namespace messages_test {

message::Status some_status() {
  message::Status status;
  status.bound = 17;
  status.live = true;
  status.epoch = 2;
  status.stopped = StopReason::kMemory;
  status.surplus = {{17, 2}, {19, 1}};
  status.work_requests = {{3, true, kInfiniteCost}, {5, false, 19}};
  status.taken = {{3, 4, 9}};
  return status;
}

std::string bytes(const message::Message& message) {
  return bytes_of(message, 2);
}

template <class Kind>
Kind returned(const Kind& sent) {
  const message::Addressed addressed = message::message_of(bytes(sent));
  EXPECT_EQ(addressed.level, 2);
  return std::get<Kind>(addressed.message);
}

TEST(Messages, RoundTrip) {
  EXPECT_EQ(returned(some_status()), some_status());
  const auto order = returned(message::SendNodes{3, 64, true});
  EXPECT_EQ(order.to, 3);
  EXPECT_EQ(order.count, 64);
  EXPECT_TRUE(order.to_idle);
}

TEST(Messages, StatisticsRoundTripAndAddUp) {
  message::ProcessStatistics sent;
  sent.statistics.whole = {{{"branching_cost_queries", 5}},
                           {.process = 9, .nodes = 1, .groups = 3}};
  sent.statistics.ranks[7] = {.expanded = 11, .open = 2, .bound = 40, .memory = 9};
  const RunStatistics received = returned(sent).statistics;
  EXPECT_EQ(received.whole.counts, sent.statistics.whole.counts);
  EXPECT_EQ(received.whole.memory.groups, 3);
  EXPECT_EQ(received.ranks.at(7).expanded, 11);
  EXPECT_EQ(received.ranks.at(7).bound, 40);
  RunStatistics sum;
  sum.whole.counts["branching_cost_queries"] = 1;
  sum.ranks[6] = {};
  add(received, sum);
  EXPECT_EQ(sum.whole.counts.at("branching_cost_queries"), 6);
  EXPECT_EQ(sum.whole.memory.nodes, 1);
  EXPECT_EQ(sum.ranks.size(), 2);
  EXPECT_EQ(sum.ranks.at(7).open, 2);
}

TEST(Messages, LengthDoesNotDependOnProcessMemory) {
  const auto length = [](std::int64_t memory) {
    message::ProcessStatistics report;
    report.statistics.whole.memory.process = memory;
    report.statistics.ranks[7].memory = memory;
    return bytes(report).size();
  };
  EXPECT_EQ(length(0), length(std::int64_t{1} << 40));
}

TEST(Messages, LearnedBoundsRoundTrip) {
  LearnedBound fact;
  for (const AgentIndex agent : {7, 19}) {
    SubproblemRecord& situation = fact.agents.emplace_back(3, agent);
    situation.constraints = PackedConstraints(
        std::vector<Constraint>{{500, kNoCell, 9, 30, ConstraintKind::kVertexOrEdge}});
  }
  fact.excess = {2, true, 400};
  const std::string bytes = message::packed(fact);
  const LearnedBound back = message::unpacked(bytes);
  EXPECT_EQ(back.agents, fact.agents);
  EXPECT_EQ(back.cost, fact.cost);
  EXPECT_EQ(back.excess, fact.excess);
  EXPECT_THROW(message::unpacked(bytes.substr(1)), std::invalid_argument);
  EXPECT_THROW(message::unpacked(bytes + "x"), std::invalid_argument);
  const auto received = returned(message::LearnedBounds{512, {bytes, bytes}});
  EXPECT_EQ(received.reach, 512);
  EXPECT_EQ(received.facts, (std::vector{bytes, bytes}));
}

message::ForComponent some_component_message() {
  return {{ComponentId::kLagrangian, "some bytes"}};
}

TEST(Messages, ComponentMessageRoundTrips) {
  const auto received = returned(some_component_message()).message;
  EXPECT_EQ(received.component, ComponentId::kLagrangian);
  EXPECT_EQ(received.bytes, "some bytes");
  std::string unknown = bytes(some_component_message());
  constexpr std::size_t kComponentAt = 2;  // after the level and the kind of the message
  ASSERT_EQ(unknown[kComponentAt], static_cast<char>(ComponentId::kLagrangian));
  unknown[kComponentAt] = static_cast<char>(kComponentNames.size());
  EXPECT_THROW(message::message_of(unknown), std::invalid_argument);
}

TEST(Messages, TruncatedMessageIsRefused) {
  for (const std::string& whole : {bytes(some_status()), bytes(some_component_message())})
    for (std::size_t length = 0; length < whole.size(); ++length)
      EXPECT_THROW(message::message_of(whole.substr(0, length)), std::invalid_argument) << length;
}

TEST(Messages, CorruptedMessageIsRefusedOrDecoded) {
  std::mt19937 dice(1);
  const std::string whole = bytes(some_status());
  for (int i = 0; i < 3000; ++i) {
    std::string noise = whole;
    for (int k = 0; k < 3; ++k) noise[dice() % noise.size()] = static_cast<char>(dice());
    try {
      message::message_of(noise);
    } catch (const std::invalid_argument&) {
      continue;
    }
  }
}

}  // namespace messages_test
}  // namespace grove::detail
