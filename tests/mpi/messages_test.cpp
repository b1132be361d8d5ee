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
  status.live = 3;
  status.idle = false;
  status.era = 2;
  status.stopped = StopReason::kMemory;
  status.levels = {{17, 2}, {19, 1}};
  status.batches = {{4, 9}};
  return status;
}

TEST(Messages, ArriveAsTheyWereSent) {
  const message::Message sent = some_status();
  const auto status = std::get<message::Status>(message::message_of(bytes_of(sent)));
  EXPECT_EQ(status.bound, 17);
  EXPECT_EQ(status.evicted_bound, kInfiniteCost);
  EXPECT_EQ(status.stopped, StopReason::kMemory);
  EXPECT_EQ(status.levels, some_status().levels);
  EXPECT_EQ(status.batches, some_status().batches);
  const auto order = std::get<message::Order>(message::message_of(bytes_of(message::Order{3, 64})));
  EXPECT_EQ(order.to, 3);
  EXPECT_EQ(order.count, 64);
}

TEST(Messages, TellWhatARankHasDone) {
  message::Account sent{{{{"prices_asked", 5}}, {.process = 9, .nodes = 1, .groups = 3}}};
  const auto told = std::get<message::Account>(message::message_of(bytes_of(sent))).account;
  EXPECT_EQ(told.counts, sent.account.counts);
  EXPECT_EQ(told.memory.process, 9);
  EXPECT_EQ(told.memory.groups, 3);
  Account sum = told;
  add(told, sum);
  EXPECT_EQ(sum.counts.at("prices_asked"), 10);
  EXPECT_EQ(sum.memory.nodes, 2);
}

TEST(Messages, AreRefusedWhenCutShort) {
  const std::string whole = bytes_of(some_status());
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(message::message_of(whole.substr(0, length)), std::invalid_argument) << length;
}

TEST(Messages, NoiseIsRefusedOrTakenForOtherValues) {
  std::mt19937 dice(1);
  const std::string whole = bytes_of(some_status());
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
