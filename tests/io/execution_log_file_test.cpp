// SPDX-License-Identifier: MIT
#include "io/execution_log_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "io/input_error.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace execution_log_file_test {

using ::testing::HasSubstr;

Instance instance() {
  InstanceBuilder builder(Grid(3, 2, std::vector<bool>(6, true)));
  builder.add_agent("a", {0, 0}, Position{2, 0});
  builder.add_agent("b", {0, 1}, std::nullopt);
  return std::move(builder).build();
}

Plan plan() {
  return {2, {{2, {}, {0, 1, 2}}, {0, {}, {3}}}};
}

const std::string kHeader =
    "{\"format\": \"grove drive 1\", \"order\": \"o.json\", \"robots\": [\"a\", \"b\"], "
    "\"seconds_per_step\": 1.5}\n";
const std::string kSeen =
    "{\"t\": 0.5, \"robot\": \"a\", \"at\": [0.25, -0.1], \"angle\": 90, \"action\": 0, "
    "\"state\": \"moving\"}\n";
const std::string kDone =
    "{\"t\": 4, \"robot\": \"a\", \"at\": [2, 0], \"action\": 2, \"state\": \"done\"}\n";

class ExecutionLogFile : public ::testing::Test {
 protected:
  ExecutionLog read(const std::string& content) {
    return read_drive_file(directory_.write("d.jsonl", content), instance_,
                           ActionDependencyGraph(instance_, plan()));
  }
  std::string refused(const std::string& content) {
    return refusal([&] { read(content); });
  }
  // Returns the message for a log in whose second line `from` is replaced by `to`.
  std::string refused_with(const std::string& from, const std::string& to) {
    std::string line = kSeen;
    EXPECT_NE(line.find(from), std::string::npos) << from;
    return refused(kHeader + line.replace(line.find(from), from.size(), to));
  }

  const Instance instance_ = instance();
  TemporaryDirectory directory_;
};

TEST_F(ExecutionLogFile, IsRead) {
  const ExecutionLog log = read(kHeader + kSeen + "\n" + kDone);
  EXPECT_EQ(log.order, "o.json");
  EXPECT_EQ(log.seconds_per_step, 1.5);
  ASSERT_EQ(log.robots.size(), 2u);
  ASSERT_EQ(log.robots[0].size(), 2u);
  EXPECT_TRUE(log.robots[1].empty());
  const PoseSample& seen = log.robots[0][0];
  EXPECT_EQ(seen.seconds, 0.5);
  EXPECT_EQ(seen.x, 0.25);
  EXPECT_EQ(seen.y, -0.1);
  EXPECT_EQ(seen.angle, 90);
  EXPECT_EQ(seen.completed, 0);
  EXPECT_STREQ(kDriveStates[seen.state], "moving");
  EXPECT_TRUE(std::isnan(log.robots[0][1].angle));
  EXPECT_EQ(log.robots[0][1].completed, 2);
}

TEST_F(ExecutionLogFile, MayBeTruncatedAnywhere) {
  const std::string whole = kHeader + kSeen + kDone;
  for (std::size_t size = kHeader.size(); size <= whole.size(); ++size) {
    const std::size_t lines = size < kHeader.size() + kSeen.size() ? 0u
                              : size < whole.size()                ? 1u
                                                                   : 2u;
    EXPECT_EQ(read(whole.substr(0, size)).robots[0].size(), lines) << size;
  }
}

TEST_F(ExecutionLogFile, OtherFilesAreRefused) {
  for (const std::string text : {"", "\n", "red\n", "[]\n", "{}\n", "{\"format\": 1}\n"})
    EXPECT_THAT(refused(text), HasSubstr("d.jsonl: line 1: expected the log of an execution"))
        << text;
  EXPECT_THAT(refused(kHeader.substr(0, 20)),
              HasSubstr("line 1: expected the log of an execution"));
  std::string other = kHeader;
  EXPECT_THAT(refused(other.replace(other.find("\"b\""), 3, "\"r2\"")),
              HasSubstr("line 1: /robots/1: found \"r2\"; expected a robot of the instance"));
}

TEST_F(ExecutionLogFile, InvalidLinesAreNamed) {
  EXPECT_THAT(refused(kHeader + kSeen + "{\"t\": \n"),
              HasSubstr("d.jsonl: line 3: found {\"t\": ; expected a JSON object"));
  EXPECT_THAT(refused_with("\"a\"", "\"z\""),
              HasSubstr("line 2: /robot: found \"z\"; expected a robot that the first line names"));
  EXPECT_THAT(refused_with("\"moving\"", "\"asleep\""),
              HasSubstr("line 2: /state: found \"asleep\"; expected one of waiting, moving"));
  EXPECT_THAT(refused_with("\"action\": 0", "\"action\": 3"),
              HasSubstr("line 2: /action: found 3; expected an integer from 0 to 2"));
  EXPECT_THAT(refused_with("[0.25, -0.1]", "[0.25]"), HasSubstr("line 2: /at"));
  EXPECT_THAT(refused_with("0.25", "1e300"), HasSubstr("line 2: /at/0"));
  EXPECT_THAT(refused_with("0.5", "-0.5"), HasSubstr("/t: found -0.5; expected seconds from 0 on"));
  EXPECT_THAT(refused_with("0.5", "1e999"), HasSubstr("expected a JSON object"));
  EXPECT_THAT(refused_with("\"t\"", "\"time\""), HasSubstr("line 2: /: key 't' is missing"));
  EXPECT_THAT(refused(kHeader + kDone + kSeen),
              HasSubstr("line 3: /t: found 0.5; expected seconds from 4"));
}

TEST_F(ExecutionLogFile, DamagedFilesAreReadOrRefused) {
  std::mt19937 random(5);
  const std::string whole = kHeader + kSeen + kDone;
  int refusals = 0;
  for (int round = 0; round < 500; ++round) {
    std::string text = whole;
    for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random() % 256);
    try {
      read(text);
    } catch (const InputError&) {
      ++refusals;
    }
  }
  EXPECT_GT(refusals, 250);
}

}  // namespace execution_log_file_test
}  // namespace grove::detail
