// SPDX-License-Identifier: MIT
#include "model/fingerprint.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "tests/support/instances.h"

namespace grove::detail {
namespace fingerprint_test {

using Rows = std::vector<std::string>;
using Agents = std::vector<testing::AgentSpec>;

std::uint64_t of(const Rows& rows, const Agents& agents) {
  return fingerprint(testing::instance_of(rows, agents));
}

const Rows kRows{"...", ".@.", "..."};
const Agents kAgents{{{0, 0}, Position{2, 0}, {{1, 0}, {0, 2}}}, {{0, 1}, {}, {{2, 2}}}};

// Fingerprints must still match those in files of earlier versions.
TEST(Fingerprint, IsTheSameInEveryVersion) {
  EXPECT_EQ(of(kRows, kAgents), 9616560128765021026u);
}

TEST(Fingerprint, DiffersBetweenInstances) {
  std::set<std::uint64_t> seen{of(kRows, kAgents)};
  const auto is_new = [&](std::uint64_t found) { return seen.insert(found).second; };
  EXPECT_TRUE(is_new(of({"...", "...", "..."}, kAgents)));
  EXPECT_TRUE(is_new(of({"...", ".@.", "...", "..."}, kAgents)));
  const auto other = [&](auto change) {
    Agents agents = kAgents;
    change(agents);
    return of(kRows, agents);
  };
  EXPECT_TRUE(is_new(other([](Agents& a) { a[0].start = {2, 1}; })));
  EXPECT_TRUE(is_new(other([](Agents& a) { a[0].goal = Position{2, 1}; })));
  EXPECT_TRUE(is_new(other([](Agents& a) { a[0].goal.reset(); })));
  EXPECT_TRUE(is_new(other([](Agents& a) { a[1].tasks = {{2, 1}}; })));
  EXPECT_TRUE(is_new(other([](Agents& a) { a[1].tasks.push_back({0, 2}); })));
  EXPECT_TRUE(is_new(other([](Agents& a) { std::swap(a[0].tasks[0], a[0].tasks[1]); })));
  EXPECT_TRUE(is_new(other([](Agents& a) { std::swap(a[0], a[1]); })));
  EXPECT_TRUE(is_new(other([](Agents& a) { a.pop_back(); })));
}

// In both instances the cells and durations form the same sequence of numbers.
TEST(Fingerprint, DistinguishesDurationsFromCells) {
  const auto with_tasks = [](std::vector<std::pair<Position, Time>> tasks) {
    InstanceBuilder builder(testing::grid_of({"............"}));
    builder.add_agent("a", {0, 0}, {});
    for (const auto& [cell, duration] : tasks)
      builder.add_task(fmt::format("t{}", cell.x), cell, std::vector<std::string>{"a"}, duration);
    return fingerprint(std::move(builder).build());
  };
  EXPECT_NE(with_tasks({{{5, 0}, 7}, {{9, 0}, 0}}), with_tasks({{{5, 0}, 0}, {{7, 0}, 9}}));
}

TEST(Fingerprint, IgnoresNames) {
  const auto named = [](const char* agent, const char* task) {
    InstanceBuilder builder(testing::grid_of(kRows));
    builder.add_agent(agent, {0, 0}, {});
    builder.add_task(task, {2, 2}, std::vector<std::string>{agent});
    return fingerprint(std::move(builder).build());
  };
  EXPECT_EQ(named("a", "t"), named("robot", "dock"));
}

}  // namespace fingerprint_test
}  // namespace grove::detail
