// SPDX-License-Identifier: MIT
// Tests the frontier when an allocation fails in the middle of an operation: no node is lost, and
// the bound stays valid.
#include "search/frontier.h"

#include <gtest/gtest.h>

#include <deque>
#include <new>
#include <utility>

#include "tests/support/failing_new.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace frontier_memory_test {

class ScarceFrontier : public ::testing::Test {
 protected:
  NodePtr node(Time bound) {
    Path path;
    for (Cell cell = 0; cell <= bound; ++cell) path.push_back(cell);
    trees_.push_back({&instance_.world(), &pool_, 0, {}});
    trees_.back().orders.push_back(std::make_shared<const AgentSequencing>(
        AgentSequencing{{}, std::nullopt, PackedPath(instance_.world(), path)}));
    return Node::root(trees_.back());
  }

  // Applies `change` to frontiers with one open and one taken node, failing a different allocation
  // each time until `change` succeeds. After each failure `holds` must be true. Returns the
  // number of failures.
  template <class NodeDelta, class Holds>
  int fail_everywhere(NodeDelta change, Holds holds) {
    for (int at = 0;; ++at) {
      Frontier frontier;
      frontier.push(node(3));
      const NodePtr taken = frontier.take();
      frontier.push(node(5));
      testing::allocations_until_failure = at;
      try {
        change(frontier, taken);
      } catch (const std::bad_alloc&) {
        testing::allocations_until_failure = -1;
        EXPECT_TRUE(holds(frontier)) << "failure " << at;
        frontier.take();  // the frontier must remain usable
        continue;
      }
      testing::allocations_until_failure = -1;
      return at;
    }
  }

  const Instance instance_ = testing::instance_of({"........."}, {{{0, 0}, Position{8, 0}}});
  NodePool pool_;
  std::deque<Tree> trees_;
};

TEST_F(ScarceFrontier, KeepsItsNodesWhenPushFails) {
  const NodePtr more = node(4);
  const int failures = fail_everywhere(
      [&](Frontier& frontier, const NodePtr&) { frontier.push(more); },
      [](const Frontier& frontier) { return frontier.bound() == 3 && frontier.open() == 1; });
  EXPECT_GT(failures, 0);
}

TEST_F(ScarceFrontier, KeepsItsNodesWhenTakeFails) {
  const int failures = fail_everywhere(
      [](Frontier& frontier, const NodePtr& taken) {
        frontier.complete(taken);
        frontier.take();
      },
      [](const Frontier& frontier) { return frontier.bound() == 5 && frontier.open() == 1; });
  EXPECT_GT(failures, 0);
}

TEST_F(ScarceFrontier, KeepsItsNodesWhenReinsertFails) {
  const int failures =
      fail_everywhere([](Frontier& frontier, const NodePtr& taken) { frontier.reinsert(taken); },
                      [](const Frontier& frontier) { return frontier.bound() == 3; });
  EXPECT_GT(failures, 0);
}

TEST_F(ScarceFrontier, KeepsItsNodesWhenTakeForTransferFails) {
  const std::vector<NodePtr> more{node(4), node(6), node(7)};
  const int failures = fail_everywhere(
      [&](Frontier& frontier, const NodePtr&) {
        const int at = std::exchange(testing::allocations_until_failure, -1);
        for (const NodePtr& each : more) frontier.push(each);
        testing::allocations_until_failure = at;
        frontier.take_for_transfer(4, false);
      },
      [](const Frontier& frontier) {
        return frontier.bound() == 3 && frontier.open() == 4 && frontier.live() == 5 &&
               frontier.levels(9).size() == 4;
      });
  EXPECT_GT(failures, 3);
}

TEST_F(ScarceFrontier, KeepsItsBoundWhenRestartFails) {
  const std::vector<NodePtr> roots{node(1), node(2), node(6)};
  const int failures = fail_everywhere(
      [&](Frontier& frontier, const NodePtr& taken) {
        frontier.complete(taken);
        frontier.evict(1);
        frontier.restart(roots, frontier.evicted_bound());
      },
      [](const Frontier& frontier) { return frontier.bound() == 5; });
  EXPECT_GT(failures, 0);
}

}  // namespace frontier_memory_test
}  // namespace grove::detail
