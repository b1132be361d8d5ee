// SPDX-License-Identifier: MIT
#include "mpi/batch/farm_messages.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/result_rows.h"

namespace grove::detail::batch {
namespace farm_messages_test {

const std::vector<FarmMessage> kMessages{
    RequestWork{},
    Report{grove::detail::testing::solved_row()},
    Report{grove::detail::testing::failed_row()},
    Aborted{},
    Assignment{{.id = "a-3", .path = "a.scen", .map = "m.map", .agents = 3, .digest = "01"}},
    Assignment{},
    Stop{},
    NoMoreWork{},
    Ended{},
    Ended{std::string("\0\xff\n", 3)}};

TEST(FarmMessages, RoundTrip) {
  for (const FarmMessage& message : kMessages) EXPECT_EQ(decode(encode(message)), message);
}

TEST(FarmMessages, TruncatedMessageIsRefused) {
  for (const FarmMessage& message : kMessages) {
    const std::string bytes = encode(message);
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_THROW(decode(bytes.substr(0, size)), std::invalid_argument) << message.index();
  }
}

}  // namespace farm_messages_test
}  // namespace grove::detail::batch
