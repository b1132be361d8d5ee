// SPDX-License-Identifier: MIT
#include "mpi/batch/farm_messages.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace grove::batch {
namespace farm_messages_test {

Row some_row() {
  Row row;
  row.id = "a/b";
  row.instance = "in/a/b.cts.json";
  row.digest = "0123456789abcdef";
  row.result = {.status = Status::kFeasible,
                .cost = 1'000'000'000'000,
                .lower_bound = 7,
                .nodes_expanded = 3,
                .first_plan_s = 0.1,
                .stopped_by = "time limit",
                .plan_file = "plans/a/b.plan.json"};
  row.error = "an error";
  row.version = "grove 0";
  row.ranks = 3;
  row.threads = 2;
  row.wall_s = 1.25;
  row.started_at = "2026-11-30T23:59:59Z";
  return row;
}

const std::vector<FarmMessage> kMessages{
    AskForWork{},
    Report{some_row()},
    Report{},
    GaveUp{},
    Assignment{{.id = "a-3", .path = "a.scen", .map = "m.map", .agents = 3, .digest = "01"}},
    Assignment{},
    Stop{},
    Dismissal{},
    Ended{},
    Ended{std::string("\0\xff\n", 3)}};

TEST(FarmMessages, ComeBackAsTheyWereSent) {
  for (const FarmMessage& message : kMessages) EXPECT_EQ(decode(encode(message)), message);
}

TEST(FarmMessages, CutShortAreNone) {
  for (const FarmMessage& message : kMessages) {
    const std::string bytes = encode(message);
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_THROW(decode(bytes.substr(0, size)), std::runtime_error) << message.index();
  }
}

}  // namespace farm_messages_test
}  // namespace grove::batch
