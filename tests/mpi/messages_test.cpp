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

message::AskPrices some_question() {
  message::AskPrices ask;
  ask.share.round = 7;
  ask.share.first = 2;
  ask.share.known = {4096, kNoPrice};
  ask.share.news.rows = {{.kind = RelaxedRow::Kind::kEdge, .a = 3, .b = 4, .time = 9}};
  ask.share.news.charges = std::string("\x00\x05", 2);
  return ask;
}

TEST(Messages, AskForPricesAndTellThem) {
  const auto share =
      std::get<message::AskPrices>(message::message_of(bytes_of(some_question()))).share;
  EXPECT_EQ(share.round, 7);
  EXPECT_EQ(share.first, 2);
  EXPECT_EQ(share.known, some_question().share.known);
  EXPECT_EQ(share.news.rows, some_question().share.news.rows);
  EXPECT_EQ(share.news.charges, some_question().share.news.charges);
  message::Prices sent;
  sent.answer.round = 7;
  sent.answer.digest = 0xfedcba9876543210;
  sent.answer.first = 2;
  sent.answer.prices = {4095, 0};
  sent.answer.paths = {{1, 2, 3}, {}};
  sent.answer.work = 11;
  const auto answer = std::get<message::Prices>(message::message_of(bytes_of(sent))).answer;
  EXPECT_EQ(answer.round, 7);
  EXPECT_EQ(answer.digest, 0xfedcba9876543210);
  EXPECT_EQ(answer.first, 2);
  EXPECT_EQ(answer.prices, sent.answer.prices);
  EXPECT_EQ(answer.paths, sent.answer.paths);
  EXPECT_EQ(answer.work, 11);
}

TEST(Messages, AreRefusedWhenCutShort) {
  for (const std::string& whole : {bytes_of(some_status()), bytes_of(some_question())})
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
