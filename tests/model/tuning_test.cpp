// SPDX-License-Identifier: MIT
// Tests the parsing of tunables. tests/structure checks that each tunable is used, and tests/fuzz
// that no value leads to a wrong answer.
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
    const std::string other = before == fmt::format("{}", t.min) ? fmt::format("{}", t.min + 1)
                                                                 : fmt::format("{}", t.min);
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
    EXPECT_LT(t.min, t.max) << t.name();
    EXPECT_EQ(error_of(t.name() + "=" + t.value({})), "none");
  }
}

TEST(Tuning, AcceptsOnlyNumbersWithinTheRange) {
  for (const char* good : {"joint-group-agents=2", "joint-group-agents=16", "record-deviation=0",
                           "record-deviation=1.0", "large-gap=5e-1", "bound-work=1000000000000000"})
    EXPECT_EQ(error_of(good), "none");
  EXPECT_EQ(error_of("joint-group-agents=1"),
            "joint-group-agents: found '1'; expected an integer from 2 to 16");
  EXPECT_EQ(error_of("record-deviation=1.01"),
            "record-deviation: found '1.01'; expected a number from 0 to 1");
  for (const char* bad : {"joint-group-agents=17", "joint-group-agents=3.5",
                          "joint-group-agents=", "joint-group-agents= 3", "joint-group-agents=3x",
                          "record-deviation=-0.1", "record-deviation=nan", "bound-work=1e3",
                          "bound-work=99999999999999999999"})
    EXPECT_THAT(error_of(bad), HasSubstr("expected a")) << bad;
  for (const char* bad : {"", "=", "joint-group-agents", "joint_group_agents=3", "agents=3"})
    EXPECT_THAT(error_of(bad), HasSubstr("expected NAME=VALUE")) << bad;
}

TEST(Tuning, AcceptsTheOldNamesOfParameters) {
  Tuning tuning;
  set(tuning, "far-plan=0.5");
  EXPECT_EQ(tuning.large_gap, 0.5);
  EXPECT_EQ(error_of("far-plan=-1"), "far-plan: found '-1'; expected a number from 0 to 1000000");
  std::set<std::string> names;
  for (const std::string& name : accepted_tunable_names()) {
    EXPECT_TRUE(names.insert(name).second) << name << " twice";
    EXPECT_THAT(error_of(name + "=x"), HasSubstr(name + ": found 'x'; expected "));
  }
}

TEST(Tuning, RefusesToChangeFormerParameters) {
  Tuning tuning;
  set(tuning, "spot-steps=8");
  EXPECT_EQ(tuning, Tuning());
  EXPECT_EQ(error_of("spot-steps=9"),
            "spot-steps: found '9'; expected 8, because it is a constant");
  EXPECT_EQ(error_of("spot-steps"), "spot-steps: found ''; expected 8, because it is a constant");
}

}  // namespace tuning_test
}  // namespace grove::detail
