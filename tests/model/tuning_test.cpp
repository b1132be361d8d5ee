// SPDX-License-Identifier: MIT
// Parsing of tunables. tests/structure checks that each one is used, and tests/fuzz that no value
// leads to a wrong answer.
#include "model/tuning.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

namespace grove::detail {
namespace tuning_test {

using ::testing::HasSubstr;

std::string error_of(const std::string& text) {
  try {
    Tuning tuning;
    set(tuning, text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(Tuning, SetsOnlyTheTunableOfThatName) {
  std::set<std::string> names;
  for (const Tunable& t : tunables()) {
    SCOPED_TRACE(t.name());
    EXPECT_TRUE(names.insert(t.name()).second);
    Tuning tuning;
    const std::string before = t.value(tuning);
    const std::string other = before == fmt::format("{}", t.least) ? fmt::format("{}", t.least + 1)
                                                                   : fmt::format("{}", t.least);
    set(tuning, t.name() + "=" + other);
    for (const Tunable& u : tunables())
      EXPECT_EQ(u.value(tuning), &u == &t ? other : u.value({})) << u.name();
    EXPECT_NE(tuning, Tuning());
    set(tuning, t.name() + "=" + before);
    EXPECT_EQ(tuning, Tuning());
  }
  EXPECT_GT(names.size(), 30u);
}

TEST(Tuning, DefaultsAreWithinTheirRanges) {
  for (const Tunable& t : tunables()) {
    EXPECT_LT(t.least, t.most) << t.name();
    EXPECT_EQ(error_of(t.name() + "=" + t.value({})), "none");
  }
}

TEST(Tuning, AcceptsOnlyNumbersWithinTheRange) {
  for (const char* good : {"group-agents=2", "group-agents=64", "way-memory=0", "way-memory=1.0",
                           "order-spread=5e-1", "bound-work=1000000000000000"})
    EXPECT_EQ(error_of(good), "none");
  EXPECT_EQ(error_of("group-agents=1"),
            "group-agents: found '1'; expected an integer from 2 to 64");
  EXPECT_EQ(error_of("way-memory=1.01"), "way-memory: found '1.01'; expected a number from 0 to 1");
  for (const char* bad : {"group-agents=65", "group-agents=3.5", "group-agents=", "group-agents= 3",
                          "group-agents=3x", "way-memory=-0.1", "way-memory=nan", "bound-work=1e3",
                          "bound-work=99999999999999999999"})
    EXPECT_THAT(error_of(bad), HasSubstr("expected a")) << bad;
  for (const char* bad : {"", "=", "group-agents", "group_agents=3", "agents=3"})
    EXPECT_THAT(error_of(bad), HasSubstr("expected NAME=VALUE")) << bad;
}

}  // namespace tuning_test
}  // namespace grove::detail
