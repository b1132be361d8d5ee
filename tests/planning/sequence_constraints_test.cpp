// SPDX-License-Identifier: MIT
#include "planning/sequence_constraints.h"

#include <gtest/gtest.h>

#include "tests/planning/single_agent.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace sequence_constraints_test {

using testing::grid_of;
using testing::SingleAgent;

// Stops 0, 1, 2, 3 on the cells 1, 3, 4, 6 of a corridor.
class SequenceConstraints : public ::testing::Test {
 protected:
  Constraint is(Time number, int stop) const {
    return {stops_.place(stop), stop, number, number, ConstraintKind::kStopIs};
  }
  Constraint is_not(Time number, int stop) const {
    return {stops_.place(stop), stop, number, number, ConstraintKind::kStopIsNot};
  }
  SequenceClass narrowed(const std::vector<Constraint>& constraints,
                         SequenceClass work = {}) const {
    return grove::detail::narrowed(std::move(work), stops_, constraints);
  }

  Grid grid_ = grid_of({"........"});
  SingleAgent agent_{grid_, 0, {1, 3, 4, 6}, Cell{7}};
  AgentStops stops_{agent_.instance, agent_.distances, 0};
};

TEST_F(SequenceConstraints, NarrowTheClassInAnyOrder) {
  EXPECT_EQ(narrowed({}), SequenceClass());
  EXPECT_EQ(narrowed({is_not(0, 1), is_not(0, 3)}), SequenceClass({}, 0b1010));
  EXPECT_EQ(narrowed({is_not(1, 0), is(0, 2), is_not(0, 1)}), SequenceClass({2}, 0b0001));
  EXPECT_EQ(narrowed({is(2, 3), is(1, 0), is(0, 2)}), SequenceClass({2, 0, 3, 1}, 0));
}

TEST_F(SequenceConstraints, ExtendTheClassOfTheTree) {
  EXPECT_EQ(narrowed({is_not(0, 0)}, {{}, 0b0010}), SequenceClass({}, 0b0011));
  EXPECT_EQ(narrowed({is(1, 3)}, {{2}, 0b0010}), SequenceClass({2, 3}, 0));
}

TEST_F(SequenceConstraints, FixStopWhenAllOthersAreRuledOut) {
  EXPECT_EQ(narrowed({is_not(0, 0), is_not(0, 1), is_not(0, 2), is_not(1, 0)}),
            SequenceClass({3}, 0b0001));
}

TEST_F(SequenceConstraints, IgnorePathConstraints) {
  EXPECT_EQ(narrowed({{3, kNoCell, 0, 0}, {3, 4, 1, 1}}), SequenceClass());
}

TEST_F(SequenceConstraints, ThrowWhenTheyFormNoClass) {
  const Constraint nowhere{2, 0, 0, 0, ConstraintKind::kStopIs};
  EXPECT_THROW(narrowed({nowhere}), std::invalid_argument);
  const Constraint none{1, 4, 0, 0, ConstraintKind::kStopIs};
  EXPECT_THROW(narrowed({none}), std::invalid_argument);
  EXPECT_THROW(narrowed({is(1, 0)}), std::invalid_argument);
  EXPECT_THROW(narrowed({is(0, 0), is(1, 0)}), std::invalid_argument);
  EXPECT_THROW(narrowed({is(0, 0), is_not(0, 0)}), std::invalid_argument);
  EXPECT_THROW(narrowed({is(0, 3)}, {{}, 0b1000}), std::invalid_argument);
}

}  // namespace sequence_constraints_test
}  // namespace grove::detail
