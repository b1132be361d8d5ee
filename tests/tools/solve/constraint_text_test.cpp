// SPDX-License-Identifier: MIT
#include "tools/solve/constraint_text.h"

#include <gtest/gtest.h>

#include "tests/support/instances.h"

namespace grove::detail {
namespace constraint_text_test {

using testing::grid_of;

// A corridor of four places, numbered from 0.
Instance corridor() {
  InstanceBuilder builder{Map(grid_of({"...."}))};
  builder.add_agent("red", Position{0, 0}, Position{3, 0});
  builder.add_agent("blue", Position{3, 0}, Position{0, 0});
  return std::move(builder).build();
}

std::string text_for_red(const Constraint& c) {
  return text_of(AgentConstraint{0, c}, corridor());
}

TEST(ConstraintText, DescribesConflicts) {
  EXPECT_EQ(text_of(Conflict{.first = 0, .second = 1, .cell = 1, .time = 7}, corridor()),
            "red and blue on [1, 0] at 7");
  EXPECT_EQ(text_of(Conflict{.first = 0, .second = 1, .cell = 2, .from = 1, .time = 7}, corridor()),
            "red and blue swap [1, 0] and [2, 0] at 7");
}

TEST(ConstraintText, DescribesVertexAndEdgeConstraints) {
  EXPECT_EQ(text_for_red({.cell = 1, .begin = 7, .end = 7}), "red not on [1, 0] at 7");
  EXPECT_EQ(text_for_red({.cell = 1, .begin = 7, .end = 9}), "red not on [1, 0] from 7 to 9");
  EXPECT_EQ(text_for_red({.cell = 1, .begin = 7, .end = kNever}), "red not on [1, 0] from 7 on");
  EXPECT_EQ(text_for_red({.cell = 2, .from = 1, .begin = 7, .end = 7}),
            "red not from [1, 0] to [2, 0], arriving at 7");
}

TEST(ConstraintText, DescribesOtherConstraints) {
  EXPECT_EQ(text_for_red({.cell = 3, .end = 7, .kind = ConstraintKind::kNoRestBy}),
            "red not at rest on [3, 0] by 7");
  EXPECT_EQ(text_for_red({.cell = 3, .end = 7, .kind = ConstraintKind::kRestBy}),
            "red at rest on [3, 0] by 7, no other agent there from then on");
  EXPECT_EQ(text_for_red(
                {.cell = 3, .from = 2, .begin = 4, .end = 6, .kind = ConstraintKind::kNoTraversal}),
            "red not through the passage by [2, 0] to [3, 0], arriving from 4 to 6");
  EXPECT_EQ(text_for_red({.cell = 2, .from = 0, .begin = 0, .kind = ConstraintKind::kStopIs}),
            "red's stop 1 is on [2, 0]");
  EXPECT_EQ(text_for_red({.cell = 2, .from = 0, .begin = 0, .kind = ConstraintKind::kStopIsNot}),
            "red's stop 1 is not the one on [2, 0]");
  EXPECT_EQ(text_of(AgentConstraint{}, corridor()), "");
}

}  // namespace constraint_text_test
}  // namespace grove::detail
