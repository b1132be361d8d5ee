// SPDX-License-Identifier: MIT
#include "search/node_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "search/expander.h"
#include "search/single_tree.h"
#include "tests/primal/crowd.h"

namespace grove::detail {
namespace node_record_test {

// Nodes of a search from several levels of its tree.
class NodeRecords : public ::testing::Test {
 protected:
  NodeRecords() {
    std::vector<NodePtr> open{root_};
    for (std::size_t i = 0; i < open.size() && open.size() < 200; ++i) {
      const Expansion expansion = expander_.expand(open[i], kInfiniteCost, limits_);
      open.insert(open.end(), expansion.children.begin(), expansion.children.end());
    }
    nodes_.assign(open.begin() + 1, open.end());
  }

  Limits limits_;
  Instance instance_ =
      testing::random_crowd({.size = 10, .obstacles = 25, .agents = 12, .tasks = 12}, 5);
  Problem problem_{instance_, limits_};
  AgentStopsCache stops_{instance_, problem_.distances};
  NodePool pool_;
  SingleTree forest_{problem_, stops_, pool_, limits_};
  NodePtr root_ = forest_.next_root();
  Expander expander_{problem_, stops_, {Techniques::defaults(), 0}};
  std::vector<NodePtr> nodes_;
};

TEST_F(NodeRecords, RestoreTheNode) {
  ASSERT_GT(nodes_.size(), 50u);
  for (const NodePtr& node : nodes_) {
    const NodeRecord record = record_of(*node);
    const NodePtr restored = node_of(record, root_, instance_);
    EXPECT_EQ(record_of(*restored), record);
    EXPECT_EQ(restored->bound(), node->bound());
    EXPECT_EQ(restored->cost(), node->cost());
    EXPECT_EQ(restored->conflicts(), node->conflicts());
    EXPECT_EQ(restored->is_bounded(), node->is_bounded());
    std::vector<Path> paths;
    std::vector<Path> restored_paths;
    node->paths(problem_, paths);
    restored->paths(problem_, restored_paths);
    EXPECT_EQ(restored_paths, paths);
    std::vector<std::vector<Constraint>> constraints;
    std::vector<std::vector<Constraint>> restored_constraints;
    node->constraints(constraints);
    restored->constraints(restored_constraints);
    EXPECT_EQ(restored_constraints, constraints);
  }
}

TEST_F(NodeRecords, AreRefusedIfInvalidForTheInstance) {
  const NodeRecord record = record_of(*nodes_.back());
  ASSERT_FALSE(record.paths.empty());
  ASSERT_FALSE(record.constraints.empty());
  const auto refused = [&](auto corrupt) {
    NodeRecord corrupted = record;
    corrupt(corrupted);
    EXPECT_THROW(node_of(corrupted, root_, instance_), std::invalid_argument);
  };
  refused([](NodeRecord& r) { r.constraints[0].agent = 99; });
  refused([](NodeRecord& r) { r.constraints[0].constraint.cell = 10'000; });
  refused([](NodeRecord& r) { r.constraints[0].constraint.from = 10'000; });
  refused([](NodeRecord& r) { r.paths[0].agent = -1; });
  refused([](NodeRecord& r) { r.paths[0].steps += 100; });
  refused([](NodeRecord& r) {
    r.paths[0].steps = ~std::uint32_t{0};
    r.paths[0].words.clear();
  });
  refused([](NodeRecord& r) { r.paths[0].words[0] = ~std::uint64_t{0}; });
  refused([](NodeRecord& r) { r.bound = 0; });
  refused([](NodeRecord& r) { r.cost = r.bound + 1; });
}

// The record gets a path in which every move goes left, even through obstacles.
TEST_F(NodeRecords, AreRefusedIfPathsCrossObstacles) {
  NodeRecord record = record_of(*nodes_.back());
  record.paths[0].steps = 21;
  record.paths[0].words.assign(1, 0x36DB6DB6DB6DB6DB & 0x7FFFFFFFFFFFFFFF);
  EXPECT_THROW(node_of(record, root_, instance_), std::invalid_argument);
}

}  // namespace node_record_test
}  // namespace grove::detail
