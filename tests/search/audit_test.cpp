// SPDX-License-Identifier: MIT
// Tests that each audit detects the defect for which it exists.
#include "search/audit.h"

#include <gtest/gtest.h>

#include "model/assert.h"
#include "tests/search/root_fixture.h"

namespace grove::detail {
namespace audit_test {

struct TwoAgents : testing::RootFixture {
  TwoAgents()
      : RootFixture({"....", "...."}, {{{0, 0}, Position{3, 0}}, {{0, 1}, Position{3, 1}}}) {}

  // Returns a child of the root in which agent 0 takes `path` and the node claims `cost`.
  NodePtr child(const Path& path, Cost cost, const AgentConstraint& added = {}) {
    const NewPath taken{0, &path};
    NodeDelta change;
    change.added = added;
    change.paths = {&taken, 1};
    change.cost = cost;
    return Node::child(root, change);
  }
  void audit_child(const NodePtr& node) { audit(problem, *node, all); }
};

TEST(Audit, AcceptsConsistentNodes) {
  TwoAgents s;
  EXPECT_NO_THROW(s.audit_child(s.root));
  EXPECT_NO_THROW(s.audit_child(s.child({0, 0, 1, 2, 3}, 7, {0, {1, kNoCell, 1, 1}})));
}

TEST(Audit, DetectsACostThatDiffersFromThePaths) {
  TwoAgents s;
  EXPECT_THROW(s.audit_child(s.child({0, 0, 1, 2, 3}, 6)), AssertionFailed);
  EXPECT_THROW(s.audit_child(s.child({0, 1, 2, 3}, 7)), AssertionFailed);
}

TEST(Audit, DetectsAPathThatViolatesAConstraint) {
  TwoAgents s;
  const NodePtr broken = s.child({0, 1, 2, 3}, 6, {0, {1, kNoCell, 1, 1}});
  EXPECT_THROW(s.audit_child(broken), AssertionFailed);
  // An audit restricted to agent 1 does not check the path of agent 0.
  const std::array<AgentIndex, 1> other{1};
  EXPECT_NO_THROW(audit(s.problem, *broken, other));
  EXPECT_THROW(s.view.enter(broken, s.all), AssertionFailed);
}

TEST(Audit, DetectsAPathThatEndsOffTheGoal) {
  TwoAgents s;
  EXPECT_THROW(s.audit_child(s.child({0, 1, 2}, 5)), AssertionFailed);
}

TEST(Audit, DetectsAnOutdatedConflictAvoidanceTable) {
  TwoAgents s;
  ConflictAvoidanceTable table(s.instance.grid());
  const std::array<Path, 2> paths{Path{0, 1, 2, 3}, Path{4, 5, 1, 5, 6, 7}};
  for (const Path& path : paths) table.add(path);
  EXPECT_NO_THROW(audit(s.problem, table, paths));
  table.remove(paths[1]);
  EXPECT_THROW(audit(s.problem, table, paths), AssertionFailed);
  table.add({4, 0, 1, 2, 3});
  EXPECT_THROW(audit(s.problem, table, paths), AssertionFailed);
}

#ifdef GROVE_ASSERTIONS
// Packing a step between non-adjacent cells would yield a different path or access memory out of
// bounds.
TEST(Assertion, DetectsAStepBetweenNonAdjacentCells) {
  TwoAgents s;
  EXPECT_THROW(s.child({0, 2, 3}, 5), AssertionFailed);
}
#endif

}  // namespace audit_test
}  // namespace grove::detail
