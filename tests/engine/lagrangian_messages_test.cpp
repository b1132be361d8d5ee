// SPDX-License-Identifier: MIT
#include "engine/components/lagrangian_messages.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace grove::detail {
namespace lagrangian_messages_test {

PricingRequest some_request() {
  PricingRequest request;
  request.round = 7;
  request.first = 2;
  request.known = {4096, kNoCost};
  request.update.rows = {{.kind = RelaxedRow::Kind::kEdge, .a = 3, .b = 4, .time = 9}};
  request.update.multipliers = std::string("\x00\x05", 2);
  return request;
}

TEST(LagrangianMessages, RequestRoundTrips) {
  const PricingRequest sent = some_request();
  const PricingRequest request = pricing_request_of(bytes_of(sent));
  EXPECT_EQ(request.round, 7);
  EXPECT_EQ(request.first, 2);
  EXPECT_EQ(request.known, sent.known);
  EXPECT_EQ(request.update.rows, sent.update.rows);
  EXPECT_EQ(request.update.multipliers, sent.update.multipliers);
}

TEST(LagrangianMessages, ReplyRoundTrips) {
  PricingReply sent;
  sent.round = 7;
  sent.digest = 0xfedcba9876543210;
  sent.first = 2;
  sent.values = {4095, 0};
  sent.paths = {{1, 2, 3}, {}};
  sent.work = 11;
  const PricingReply reply = pricing_reply_of(bytes_of(sent));
  EXPECT_EQ(reply.round, 7);
  EXPECT_EQ(reply.digest, 0xfedcba9876543210);
  EXPECT_EQ(reply.first, 2);
  EXPECT_EQ(reply.values, sent.values);
  EXPECT_EQ(reply.paths, sent.paths);
  EXPECT_EQ(reply.work, 11);
}

TEST(LagrangianMessages, TruncatedMessageIsRefused) {
  const std::string whole = bytes_of(some_request());
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(pricing_request_of(whole.substr(0, length)), std::invalid_argument) << length;
}

}  // namespace lagrangian_messages_test
}  // namespace grove::detail
