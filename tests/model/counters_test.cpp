// SPDX-License-Identifier: MIT
#include "model/counters.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace grove::detail {
namespace counters_test {

using Named = std::map<std::string, std::int64_t>;

TEST(Counters, NamesAreDistinct) {
  std::set<std::string_view> names;
  for (const CounterInfo& counter : kCounters) {
    EXPECT_TRUE(names.insert(counter.name).second) << counter.name;
    EXPECT_FALSE(counter.meaning.empty()) << counter.name;
  }
}

TEST(Counters, OnlyCountedOnesAreReported) {
  Counters counters;
  EXPECT_EQ(counters.named(), Named());
  counters[Counter::kMessages] += 0;
  counters[Counter::kJointStates] += 0;
  counters[Counter::kNodesExpanded] += 3;
  EXPECT_EQ(counters.named(), (Named{{"messages", 0}, {"nodes_expanded", 3}}))
      << "joint_states is reported only if it is positive";
}

TEST(Counters, AddUp) {
  Counters a;
  a[Counter::kMessages] = 5;
  Counters b;
  b[Counter::kMessages] = 2;
  b[Counter::kBypasses] = 1;
  a += b;
  EXPECT_EQ(a.named(), (Named{{"messages", 7}, {"bypasses", 1}}));
  a -= b;
  EXPECT_EQ(a.named(), (Named{{"messages", 5}, {"bypasses", 0}}));
  Named sum{{"messages", 1}};
  add(a, sum);
  EXPECT_EQ(sum, (Named{{"messages", 6}, {"bypasses", 0}}));
}

TEST(Counters, MissingOnesAreZeroIfTheyAreReportedAlways) {
  Named counts{{"bypasses", 4}};
  add_missing(counts);
  EXPECT_EQ(counts.at("bypasses"), 4);
  EXPECT_EQ(counts.at("primal_steps"), 0);
  EXPECT_FALSE(counts.contains("messages"));
}

TEST(Counters, AreFoundByName) {
  EXPECT_EQ(counter_named("splits_", "vertex-edge"), Counter::kSplitsVertexEdge);
  EXPECT_EQ(counter_named("", "messages"), Counter::kMessages);
  EXPECT_EQ(counter_named("splits_", "none"), std::nullopt);
}

}  // namespace counters_test
}  // namespace grove::detail
