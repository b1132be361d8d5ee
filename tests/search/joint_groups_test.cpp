// SPDX-License-Identifier: MIT
#include "search/joint_groups.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/search/group_cases.h"

namespace grove::detail {
namespace joint_groups_test {

using ExcessBound = JointGroups::ExcessBound;

// With enough effort the result equals the excess found by exhaustive search. With little effort
// the result never exceeds that excess.
TEST(JointGroups, ExcessEqualsThatOfAnExhaustiveSearch) {
  int exact = 0, above = 0, interrupted = 0;
  testing::for_each_group(600, [&](testing::NodeBelowRoot& s, const std::vector<AgentIndex>& group,
                                   Cost slack, Cost truth) {
    Tuning tuning;
    JointGroups groups(s.instance, tuning, s.planner);
    ExcessBound known;
    ASSERT_TRUE(groups.solve(s.view, group, slack, s.limits, known));
    ASSERT_EQ(known.excess, truth);
    ASSERT_EQ(known.exact, truth <= slack);
    ++(known.exact ? exact : above);
    tuning.joint_group_work = s.below(40);
    ExcessBound less;
    ASSERT_TRUE(groups.solve(s.view, group, slack, s.limits, less));
    ASSERT_LE(less.excess, truth);
    if (less.exact) {
      ASSERT_EQ(less.excess, truth);
    }
    interrupted += less.excess < truth ? 1 : 0;
  });
  EXPECT_GT(exact, 100);
  EXPECT_GT(above, 20);
  EXPECT_GT(interrupted, 10);
}

}  // namespace joint_groups_test
}  // namespace grove::detail
