// SPDX-License-Identifier: MIT
#include "src/primal/visitors_first.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/instances.h"

namespace grove::detail {
namespace visitors_first_test {

using ::testing::ElementsAre;
using testing::instance_of;

TEST(VisitorsFirst, KeepsTheOrderOfThoseWhoVisitNobody) {
  const Instance instance =
      instance_of({"......"}, {{{0, 0}, Position{1, 0}}, {{2, 0}, Position{3, 0}, {{5, 0}}}});
  EXPECT_THAT(visitors_first(instance, std::vector<AgentIndex>{1, 0}), ElementsAre(1, 0));
  EXPECT_THAT(visitors_first(instance, std::vector<AgentIndex>{0, 1}), ElementsAre(0, 1));
}

// 2 visits where 1 ends, 1 where 0 ends.
TEST(VisitorsFirst, MovesThemForwardWithTheirOwnVisitors) {
  const Instance instance = instance_of({"........"}, {{{0, 0}, Position{1, 0}},
                                                       {{2, 0}, Position{3, 0}, {{1, 0}}},
                                                       {{4, 0}, Position{5, 0}, {{3, 0}}},
                                                       {{6, 0}, Position{7, 0}}});
  EXPECT_THAT(visitors_first(instance, std::vector<AgentIndex>{3, 0, 1, 2}),
              ElementsAre(3, 2, 1, 0));
}

TEST(VisitorsFirst, HoldsEachOnceInARing) {
  const Instance instance = instance_of({"......"}, {{{0, 0}, Position{1, 0}, {{3, 0}}},
                                                     {{2, 0}, Position{3, 0}, {{1, 0}}},
                                                     {{4, 0}, std::nullopt, {{5, 0}}}});
  EXPECT_THAT(visitors_first(instance, std::vector<AgentIndex>{0, 1, 2}), ElementsAre(1, 0, 2));
}

// Its own destination as a task of its own is no reason to wait.
TEST(VisitorsFirst, DoesNotWaitForItself) {
  const Instance instance =
      instance_of({"...."}, {{{0, 0}, Position{1, 0}, {{1, 0}}}, {{2, 0}, Position{3, 0}}});
  EXPECT_THAT(visitors_first(instance, std::vector<AgentIndex>{0, 1}), ElementsAre(0, 1));
}

}  // namespace visitors_first_test
}  // namespace grove::detail
