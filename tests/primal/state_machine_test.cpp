// SPDX-License-Identifier: MIT
#include "primal/state_machine.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace state_machine_test {

enum class Door { kOpen, kShut, kLocked };
struct Open {
  int visitors = 0;
};
struct Shut {};
struct Locked {
  int key;
};
using Machine = StateMachine<Door, Open, Shut, Locked>;

constexpr std::array<Transition<Door>, 4> kTransitions{{
    {Door::kOpen, Door::kShut},
    {Door::kShut, Door::kOpen},
    {Door::kShut, Door::kLocked},
    {Door::kLocked, Door::kLocked},
}};

TEST(StateMachine, EntersPermittedStatesWithTheirData) {
  Machine machine(Open(), kTransitions);
  machine.as<Open>().visitors = 3;
  EXPECT_EQ(machine.name(), Door::kOpen);
  machine.enter(Shut());
  EXPECT_EQ(machine.name(), Door::kShut);
  machine.enter(Open());
  EXPECT_EQ(machine.as<Open>().visitors, 0);
  machine.enter(Shut());
  machine.enter(Locked{7});
  machine.enter(Locked{8});
  EXPECT_EQ(machine.name(), Door::kLocked);
  EXPECT_EQ(std::as_const(machine).as<Locked>().key, 8);
}

TEST(StateMachine, RefusesOtherTransitions) {
  Machine machine(Open(), kTransitions);
  EXPECT_THROW(machine.enter(Open()), AssertionFailed);
  EXPECT_THROW(machine.enter(Locked{7}), AssertionFailed);
  EXPECT_EQ(machine.name(), Door::kOpen);
}

TEST(StateMachine, RefusesDataOfOtherStates) {
  const Machine machine(Shut(), kTransitions);
  EXPECT_THROW(machine.as<Open>(), AssertionFailed);
  EXPECT_THROW(machine.as<Locked>(), AssertionFailed);
}

}  // namespace state_machine_test
}  // namespace grove::detail
