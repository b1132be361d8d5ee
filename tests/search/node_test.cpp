// SPDX-License-Identifier: MIT
#include "search/node.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/support/instances.h"

namespace grove::detail {
namespace node_test {

TEST(PackedPath, UnpacksWhatWasPacked) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const int width = 1 + static_cast<int>(random() % 6);
    const Grid grid(width, 5, std::vector<bool>(static_cast<std::size_t>(width) * 5, true));
    Path path{static_cast<Cell>(random() % grid.cell_count())};
    const auto steps = random() % 100;
    for (std::size_t s = 0; s < steps; ++s) {
      const auto neighbors = grid.neighbors(path.back());
      const auto pick = random() % (neighbors.size() + 1);
      path.push_back(pick < neighbors.size() ? neighbors[pick] : path.back());
    }
    const PackedPath packed(grid, path);
    Path unpacked{99};
    packed.view().unpack(grid, path[0], unpacked);
    EXPECT_EQ(unpacked, path);
    EXPECT_EQ(packed.cost(), static_cast<Time>(steps));
  }
}

class NodeTest : public ::testing::Test {
 protected:
  NodeTest()
      : instance_(testing::instance_of(
            {"....", "...."}, {{{0, 0}, Position{2, 0}}, {{0, 1}, Position{1, 1}, {{2, 1}}}})),
        problem_(instance_, Limits()),
        tree_{&instance_.world(), &pool_, 0, {}} {
    add_order(0, {}, {0, 1, 2});
    add_order(1, {0}, {4, 5, 6, 5});
    root_ = Node::root(tree_);
  }

  void add_order(AgentIndex agent, const Sequence& sequence, const Path& path) {
    SequenceClass sequences{sequence, 0};
    tree_.orders.push_back(std::make_shared<const AgentSequencing>(
        AgentSequencing{std::move(sequences), goals_in_order(problem_, agent, sequence),
                        PackedPath(instance_.grid(), path)}));
  }

  NodePtr child(const NodePtr& parent, AgentIndex agent, Time barred, const Path& path, Cost cost) {
    const AgentConstraint added{agent, {1, kNoCell, barred, barred}};
    const NewPath changed{agent, &path};
    NodeDelta change;
    change.added = added;
    change.paths = {&changed, 1};
    change.cost = cost;
    return Node::child(parent, change);
  }

  Instance instance_;
  Problem problem_;
  NodePool pool_;
  Tree tree_;
  NodePtr root_;
};

TEST_F(NodeTest, ChildrenInheritPathsAndConstraints) {
  const NodePtr first = child(root_, 0, 1, {0, 0, 1, 2}, 6);
  const NodePtr second = child(first, 1, 7, {4, 4, 5, 6, 5}, 7);
  const NodePtr third = child(second, 0, 2, {0, 0, 0, 1, 2}, 8);
  std::vector<Path> paths;
  third->paths(problem_, paths);
  EXPECT_EQ(paths[0], Path({0, 0, 0, 1, 2}));
  EXPECT_EQ(paths[1], Path({4, 4, 5, 6, 5}));
  first->paths(problem_, paths);
  EXPECT_EQ(paths[1], Path({4, 5, 6, 5}));

  std::vector<Constraint> constraints;
  third->constraints(0, constraints);
  ASSERT_EQ(constraints.size(), 2u);
  EXPECT_EQ(constraints[0].begin, 2);
  EXPECT_EQ(constraints[1].begin, 1);
}

TEST_F(NodeTest, BoundIsNeverBelowTheParents) {
  EXPECT_EQ(root_->bound(), 5);
  const NodePtr node = child(root_, 0, 1, {0, 1}, 4);  // a cost below the parent's bound
  EXPECT_EQ(node->cost(), 4);
  EXPECT_EQ(node->bound(), 5);
}

TEST_F(NodeTest, ReleasesVeryDeepChains) {
  NodePtr node = root_;
  for (int depth = 0; depth < 500'000; ++depth) node = child(node, 0, 1, {0, 1, 2}, 5);
  const std::size_t full = pool_.bytes();
  node = nullptr;
  EXPECT_LT(pool_.bytes(), full / 1000);
}

TEST_F(NodeTest, DeltaMayHoldSeveralPathsOrNone) {
  const Path first{0, 0, 1, 2};
  const Path second{4, 4, 4, 5, 6, 5};
  const std::array<NewPath, 2> both{{{1, &second}, {0, &first}}};
  NodeDelta change;
  change.paths = both;
  change.cost = 8;
  change.conflicts = 3;
  const NodePtr node = Node::child(root_, change);
  NodeDelta raise;
  raise.cost = 8;
  raise.bound = 11;
  raise.bounded = true;
  const NodePtr raised = Node::child(node, raise);
  EXPECT_EQ(node->conflicts(), 3u);
  EXPECT_FALSE(node->is_bounded());
  EXPECT_TRUE(raised->is_bounded());
  EXPECT_EQ(raised->bound(), 11);
  std::vector<Path> paths;
  raised->paths(problem_, paths);
  EXPECT_EQ(paths[0], first);
  EXPECT_EQ(paths[1], second);
  raised->paths(problem_, std::array<AgentIndex, 1>{1}, paths);
  EXPECT_TRUE(paths[0].empty());
  EXPECT_EQ(paths[1], second);
  std::vector<std::vector<Constraint>> constraints;
  raised->constraints(constraints);
  ASSERT_EQ(constraints.size(), 2u);
  EXPECT_TRUE(constraints[0].empty());
  EXPECT_TRUE(constraints[1].empty());
}

TEST_F(NodeTest, RestByConstraintBarsTheOtherAgents) {
  NodeDelta change;
  change.added = {0, {2, kNoCell, 0, 4, ConstraintKind::kRestBy}};
  change.cost = 5;
  const NodePtr node = Node::child(root_, change);
  std::vector<std::vector<Constraint>> constraints;
  node->constraints(constraints);
  EXPECT_EQ(constraints[0], std::vector{change.added.constraint});
  EXPECT_EQ(constraints[1], (std::vector{Constraint{2, kNoCell, 4, kNever}}));
  for (AgentIndex agent : {0, 1}) {
    std::vector<Constraint> one;
    node->constraints(agent, one);
    EXPECT_EQ(one, constraints[agent]);
  }
}

}  // namespace node_test
}  // namespace grove::detail
