// SPDX-License-Identifier: MIT
#include "search/tree_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include "search/expander.h"
#include "search/node_record.h"
#include "search/sequence_forest.h"
#include "search/single_tree.h"
#include "tests/primal/crowd.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace tree_record_test {

// Calls add() and returns "accepted" or the error message.
std::string answer(Trees& trees, const TreeRecord& record) {
  try {
    trees.add(record, 0);
    return "accepted";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

class TreeRecords : public ::testing::Test {
 protected:
  explicit TreeRecords(
      Instance instance = testing::random_crowd(
          {.size = 10, .obstacles = 20, .agents = 8, .tasks = 14, .no_destination = 30}, 3))
      : instance_(std::move(instance)) {}

  // Returns the roots of the first `count` trees of a forest with fixed sequences.
  std::vector<NodePtr> fixed_roots(int count) {
    std::vector<NodePtr> roots;
    while (static_cast<int>(roots.size()) < count) roots.push_back(forest_.next_root());
    return roots;
  }

  // Expects that the two roots have equal tree records, bounds, costs, paths and children.
  void expect_same(const NodePtr& root, const NodePtr& restored) {
    EXPECT_EQ(record_of(restored->tree()), record_of(root->tree()));
    EXPECT_EQ(restored->bound(), root->bound());
    EXPECT_EQ(restored->cost(), root->cost());
    std::vector<Path> paths;
    std::vector<Path> restored_paths;
    root->paths(problem_, paths);
    restored->paths(problem_, restored_paths);
    EXPECT_EQ(restored_paths, paths);
    const Expansion expected = expand(root);
    const Expansion found = expand(restored);
    ASSERT_EQ(found.children.size(), expected.children.size());
    for (std::size_t i = 0; i < found.children.size(); ++i)
      EXPECT_EQ(record_of(*found.children[i]), record_of(*expected.children[i]));
  }

  Expansion expand(const NodePtr& node) {
    Expander expander(problem_, stops_, {Techniques::defaults(), 0});
    return expander.expand(node, kInfiniteCost, limits_);
  }

  Limits limits_;
  Instance instance_;
  Problem problem_{instance_, limits_};
  AgentStopsCache stops_{instance_, problem_.distances};
  NodePool pool_;
  SequenceForest forest_{problem_, pool_, RtspBackend::kAuto, limits_};
  SingleTree single_tree_{problem_, stops_, pool_, limits_};
  Trees trees_{problem_, stops_, pool_};
};

TEST_F(TreeRecords, RestoreTreesOfFixedOrders) {
  std::set<const AgentSequencing*> orders;
  std::set<const AgentSequencing*> restored_orders;
  std::vector<NodePtr> kept;
  for (const NodePtr& root : fixed_roots(20)) {
    const NodePtr restored =
        kept.emplace_back(trees_.add(record_of(root->tree()), root->tree().number));
    expect_same(root, restored);
    EXPECT_EQ(restored->tree().number, kept.size() - 1);
    for (std::size_t agent = 0; agent < root->tree().orders.size(); ++agent) {
      EXPECT_TRUE(restored->tree().orders[agent]->goals);
      orders.insert(root->tree().orders[agent].get());
      restored_orders.insert(restored->tree().orders[agent].get());
    }
  }
  EXPECT_EQ(trees_.size(), 20u);
  EXPECT_EQ(restored_orders.size(), orders.size());  // trees share orders as before
}

TEST_F(TreeRecords, RestoreTheTreeOfAllOrders) {
  const NodePtr root = single_tree_.next_root();
  const NodePtr restored = trees_.add(record_of(root->tree()), 0);
  expect_same(root, restored);
  for (const auto& order : restored->tree().orders) EXPECT_FALSE(order->goals);
}

// A sequence class between a fixed sequence and all sequences: all orders with the same first stop
// as the tree's path. If the class also excludes the second stop of the path, the path does not
// belong to it, and the record is refused.
TEST_F(TreeRecords, RestoreTreesOfSequenceClasses) {
  TreeRecord record = record_of(fixed_roots(1)[0]->tree());
  const auto of_two = std::ranges::find_if(
      record.orders, [](const auto& order) { return order.sequences.prefix.size() >= 2; });
  ASSERT_NE(of_two, record.orders.end());
  of_two->fixed = false;
  const Stop second = of_two->sequences.prefix[1];
  of_two->sequences.prefix.resize(1);
  const NodePtr restored = trees_.add(record, 0);
  EXPECT_EQ(record_of(restored->tree()), record);

  of_two->sequences.forbidden_next = StopSet{1} << second;
  EXPECT_EQ(answer(trees_, record), "the path realizes no sequence of the class");
}

TEST_F(TreeRecords, RestoreNodesBelowARestoredRoot) {
  const NodePtr root = fixed_roots(1)[0];
  const NodePtr restored = trees_.add(record_of(root->tree()), 0);
  const Expansion expansion = expand(root);
  ASSERT_FALSE(expansion.children.empty());
  for (const NodePtr& child : expansion.children)
    EXPECT_EQ(record_of(*node_of(record_of(*child), restored, instance_)), record_of(*child));
}

// Three agents: one with tasks in two corners, one without a destination, and one that only waits.
class SmallTreeRecords : public TreeRecords {
 protected:
  SmallTreeRecords()
      : TreeRecords(testing::instance_of({"....", ".@@.", "...."},
                                         {{{0, 0}, Position{3, 2}, {{1, 0}, {3, 0}}},
                                          {{0, 2}, {}, {{2, 2}, {1, 2}}},
                                          {{0, 1}, Position{0, 1}}})) {}

  // Expects `message` from answer() after `corrupt` has changed a record with fixed sequences.
  // expect_free() does the same for a record with free sequences.
  template <class Corrupt>
  void expect(const char* message, Corrupt corrupt) {
    TreeRecord record = record_of(fixed_->tree());
    corrupt(record);
    EXPECT_EQ(answer(trees_, record), message);
  }
  template <class Corrupt>
  void expect_free(const char* message, Corrupt corrupt) {
    TreeRecord record = record_of(free_->tree());
    corrupt(record);
    EXPECT_EQ(answer(trees_, record), message);
  }
  void take_path(TreeRecord::Order& order, const std::vector<Position>& positions) {
    Path path;
    for (const Position p : positions) path.push_back(instance_.grid().cell(p));
    order.steps = static_cast<std::uint32_t>(path.size() - 1);
    order.words.assign(packed_words(instance_.world(), order.steps), 0);
    pack(instance_.grid(), path, order.words.data());
  }

  NodePtr fixed_ = forest_.next_root();
  NodePtr free_ = single_tree_.next_root();
};

TEST_F(SmallTreeRecords, AreAcceptedUnchanged) {
  expect("accepted", [](TreeRecord&) {});
  expect_free("accepted", [](TreeRecord&) {});
  // For an agent without stops, a fixed and a free order are the same class but different orders.
  EXPECT_TRUE(trees_.add(record_of(fixed_->tree()), 0)->tree().orders[2]->goals);
  EXPECT_FALSE(trees_.add(record_of(free_->tree()), 0)->tree().orders[2]->goals);
}

TEST_F(SmallTreeRecords, AreRefusedWithAWrongNumberOfAgents) {
  const char* message = "a tree must fix as many agents' orders as the instance has agents";
  expect(message, [](TreeRecord& r) { r.orders.pop_back(); });
  expect(message, [](TreeRecord& r) { r.orders.emplace_back(); });
  expect(message, [](TreeRecord& r) { r.orders.clear(); });
  EXPECT_EQ(trees_.size(), 0u);
}

TEST_F(SmallTreeRecords, AreRefusedWithWrongStops) {
  const char* message = "a fixed order must hold every stop of its agent once";
  expect(message, [](TreeRecord& r) { r.orders[0].sequences.prefix.pop_back(); });
  expect(message, [](TreeRecord& r) { r.orders[0].sequences.prefix.push_back(2); });
  expect(message, [](TreeRecord& r) { r.orders[0].sequences.prefix = {1, 1}; });
  expect(message, [](TreeRecord& r) { r.orders[0].sequences.prefix = {0, 200}; });
  expect(message, [](TreeRecord& r) { r.orders[0].sequences.forbidden_next = 1; });
  expect_free("a prefix must hold stops of its agent, each at most once", [](TreeRecord& r) {
    r.orders[0].sequences.prefix = {0, 200};
  });
}

TEST_F(SmallTreeRecords, AreRefusedIfAPathIsNoWalkOnTheMap) {
  const char* message = "a tree's path must have the length it claims";
  expect(message, [](TreeRecord& r) { r.orders[0].steps += 100; });
  expect(message, [](TreeRecord& r) { r.orders[0].words.clear(); });
  expect(message, [](TreeRecord& r) {
    r.orders[0].steps = ~std::uint32_t{0};
    r.orders[0].words.clear();
  });
  expect("a tree's path must be a walk on the map from its agent's start",
         [](TreeRecord& r) { r.orders[0].words[0] = ~std::uint64_t{0}; });
  expect("a tree's path must be a walk on the map from its agent's start",
         [](TreeRecord& r) { r.orders[0].words[0] = 0b010'001; });  // into a wall
}

TEST_F(SmallTreeRecords, AreRefusedIfAPathMissesItsStops) {
  const char* message = "a tree's path must visit its agent's stops in order";
  // These paths miss both tasks, end before the destination, visit the tasks in reverse order, or
  // miss the last task.
  expect(message, [&](TreeRecord& r) {
    take_path(r.orders[0], {{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}, {3, 2}});
  });
  expect(message, [&](TreeRecord& r) {
    take_path(r.orders[0], {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}});
  });
  expect(message, [](TreeRecord& r) { std::ranges::reverse(r.orders[0].sequences.prefix); });
  expect(message, [&](TreeRecord& r) { take_path(r.orders[1], {{0, 2}, {1, 2}, {2, 2}, {3, 2}}); });
  const char* free_message = "the path realizes no sequence of the class";
  expect_free(free_message, [&](TreeRecord& r) { take_path(r.orders[1], {{0, 2}, {1, 2}}); });
  expect_free(free_message, [&](TreeRecord& r) {
    take_path(r.orders[0], {{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  });
}

// A path longer than necessary would claim a bound that is not proven.
TEST_F(SmallTreeRecords, AreRefusedIfAPathIsNotShortest) {
  const char* message = "a tree's path must be shortest in its order of stops";
  const auto wait = [&](TreeRecord& r) { take_path(r.orders[2], {{0, 1}, {0, 1}}); };
  expect(message, wait);
  expect_free(message, wait);
  const auto detour = [&](TreeRecord& r) {
    take_path(r.orders[1], {{0, 2}, {0, 1}, {0, 2}, {1, 2}, {2, 2}});
  };
  expect(message, detour);
  expect_free(message, detour);
  EXPECT_EQ(trees_.size(), 0u);
}

}  // namespace tree_record_test
}  // namespace grove::detail
