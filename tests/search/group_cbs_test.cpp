// SPDX-License-Identifier: MIT
#include "search/group_cbs.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/search/group_cases.h"

namespace grove::detail {
namespace group_cbs_test {

using ExcessBound = GroupCbs::ExcessBound;
constexpr std::int64_t kEnough = 5000;  // expansions

// After any number of expansions the result is a lower bound on the excess found by exhaustive
// search. It equals this excess if the search ends.
TEST(GroupCbs, ExcessNeverExceedsThatOfAnExhaustiveSearch) {
  int exact = 0, above = 0, interrupted = 0, expanded = 0;
  testing::for_each_group(600, [&](testing::NodeBelowRoot& s, const std::vector<AgentIndex>& group,
                                   Cost slack, Cost truth) {
    GroupCbs search(s.problem, s.options, s.planner, s.memory);
    for (const std::int64_t max_expansions : {std::int64_t{1 + s.below(20)}, kEnough}) {
      ExcessBound known;
      ASSERT_TRUE(search.solve(s.view.node(), group, slack, max_expansions, s.limits, known));
      ASSERT_LE(known.excess, truth) << "after at most " << max_expansions << " expansions";
      ASSERT_LE(known.expansions, max_expansions);
      if (known.exact || known.expansions < max_expansions) {
        ASSERT_EQ(known.excess, truth);
      }
      if (known.exact) {
        ASSERT_LE(truth, slack);
      }
      if (max_expansions < kEnough)
        interrupted += known.excess < truth ? 1 : 0;
      else
        ++(known.exact ? exact : above);
      expanded += known.expansions > 10 ? 1 : 0;
    }
  });
  EXPECT_GT(exact, 100);
  EXPECT_GT(above, 20);
  EXPECT_GT(interrupted, 5);
  EXPECT_GT(expanded, 5);
}

// Agent 1 passes the destination of agent 0 at time 80. If agent 0 rests there only later, its
// tasks can be done in too many orders.
TEST(GroupCbs, EndsIfTheCostsToGoWouldBeTooLarge) {
  std::vector<std::string> rows(5, std::string(5, '.') + std::string(80, '@'));
  rows[2] = std::string(85, '.');
  std::vector<Position> tasks;
  for (int i = 1; i < 24; ++i) tasks.push_back({i % 5, i / 5});
  testing::RootFixture s(rows, {{{0, 0}, Position{5, 2}, tasks}, {{84, 2}, Position{0, 0}}});
  GroupCbs search(s.problem, s.options, s.planner, s.memory);
  ExcessBound known;
  EXPECT_TRUE(search.solve(s.root, s.all, 1000, kEnough, s.limits, known));
  EXPECT_FALSE(known.exact);
  EXPECT_GT(known.expansions, 0);
  EXPECT_LE(known.excess, 80);
}

}  // namespace group_cbs_test
}  // namespace grove::detail
