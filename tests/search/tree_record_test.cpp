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

// What add() says of a record.
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

  // The first trees of the paper's forest.
  std::vector<NodePtr> fixed_roots(int count) {
    std::vector<NodePtr> roots;
    while (static_cast<int>(roots.size()) < count) roots.push_back(forest_.next_root());
    return roots;
  }

  // The same tree as far as anybody can see.
  void expect_same(const NodePtr& root, const NodePtr& again) {
    EXPECT_EQ(record_of(again->tree()), record_of(root->tree()));
    EXPECT_EQ(again->bound(), root->bound());
    EXPECT_EQ(again->cost(), root->cost());
    std::vector<Path> paths;
    std::vector<Path> paths_again;
    root->paths(problem_, paths);
    again->paths(problem_, paths_again);
    EXPECT_EQ(paths_again, paths);
    const Expansion expected = expand(root);
    const Expansion found = expand(again);
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

TEST_F(TreeRecords, MakeTreesOfAFixedOrderAgain) {
  std::set<const AgentSequencing*> orders;
  std::set<const AgentSequencing*> orders_again;
  std::vector<NodePtr> kept;
  for (const NodePtr& root : fixed_roots(20)) {
    const NodePtr again =
        kept.emplace_back(trees_.add(record_of(root->tree()), root->tree().number));
    expect_same(root, again);
    EXPECT_EQ(again->tree().number, kept.size() - 1);
    for (std::size_t agent = 0; agent < root->tree().orders.size(); ++agent) {
      EXPECT_TRUE(again->tree().orders[agent]->goals);
      orders.insert(root->tree().orders[agent].get());
      orders_again.insert(again->tree().orders[agent].get());
    }
  }
  EXPECT_EQ(trees_.size(), 20u);
  EXPECT_EQ(orders_again.size(), orders.size());  // shared as they were
}

TEST_F(TreeRecords, MakeTheTreeOfAllOrdersAgain) {
  const NodePtr root = single_tree_.next_root();
  const NodePtr again = trees_.add(record_of(root->tree()), 0);
  expect_same(root, again);
  for (const auto& order : again->tree().orders) EXPECT_FALSE(order->goals);
}

// A class between those two: every order that begins as the tree's path does, or does not.
TEST_F(TreeRecords, MakeTreesOfClassesAgain) {
  TreeRecord record = record_of(fixed_roots(1)[0]->tree());
  const auto of_two = std::ranges::find_if(
      record.orders, [](const auto& order) { return order.sequences.prefix.size() >= 2; });
  ASSERT_NE(of_two, record.orders.end());
  of_two->fixed = false;
  const Stop second = of_two->sequences.prefix[1];
  of_two->sequences.prefix.resize(1);
  const NodePtr again = trees_.add(record, 0);
  EXPECT_EQ(record_of(again->tree()), record);

  of_two->sequences.forbidden_next = StopSet{1} << second;
  EXPECT_EQ(answer(trees_, record), "a path that realizes no sequence of the class");
}

TEST_F(TreeRecords, HoldNodesMadeAgain) {
  const NodePtr root = fixed_roots(1)[0];
  const NodePtr again = trees_.add(record_of(root->tree()), 0);
  const Expansion expansion = expand(root);
  ASSERT_FALSE(expansion.children.empty());
  for (const NodePtr& child : expansion.children)
    EXPECT_EQ(record_of(*node_of(record_of(*child), again, instance_)), record_of(*child));
}

// An agent whose corner the tasks lie around, one without a destination, and one that only waits.
class SmallTreeRecords : public TreeRecords {
 protected:
  SmallTreeRecords()
      : TreeRecords(testing::instance_of({"....", ".@@.", "...."},
                                         {{{0, 0}, Position{3, 2}, {{1, 0}, {3, 0}}},
                                          {{0, 2}, {}, {{2, 2}, {1, 2}}},
                                          {{0, 1}, Position{0, 1}}})) {}

  // What add() says after spoiling a record of the fixed policy, or of the free one.
  template <class Spoil>
  void expect(const char* said, Spoil spoil) {
    TreeRecord record = record_of(fixed_->tree());
    spoil(record);
    EXPECT_EQ(answer(trees_, record), said);
  }
  template <class Spoil>
  void expect_free(const char* said, Spoil spoil) {
    TreeRecord record = record_of(free_->tree());
    spoil(record);
    EXPECT_EQ(answer(trees_, record), said);
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

TEST_F(SmallTreeRecords, AreAcceptedUnspoilt) {
  expect("accepted", [](TreeRecord&) {});
  expect_free("accepted", [](TreeRecord&) {});
  // Without stops, a fixed order and an open one are the same class and yet not the same order.
  EXPECT_TRUE(trees_.add(record_of(fixed_->tree()), 0)->tree().orders[2]->goals);
  EXPECT_FALSE(trees_.add(record_of(free_->tree()), 0)->tree().orders[2]->goals);
}

TEST_F(SmallTreeRecords, OfOtherAgentsAreRefused) {
  const char* said = "a tree must fix as many agents' orders as the instance has agents";
  expect(said, [](TreeRecord& r) { r.orders.pop_back(); });
  expect(said, [](TreeRecord& r) { r.orders.emplace_back(); });
  expect(said, [](TreeRecord& r) { r.orders.clear(); });
  EXPECT_EQ(trees_.size(), 0u);
}

TEST_F(SmallTreeRecords, OfOtherStopsAreRefused) {
  const char* said = "a fixed order must hold every stop of its agent once";
  expect(said, [](TreeRecord& r) { r.orders[0].sequences.prefix.pop_back(); });
  expect(said, [](TreeRecord& r) { r.orders[0].sequences.prefix.push_back(2); });
  expect(said, [](TreeRecord& r) { r.orders[0].sequences.prefix = {1, 1}; });
  expect(said, [](TreeRecord& r) { r.orders[0].sequences.prefix = {0, 200}; });
  expect(said, [](TreeRecord& r) { r.orders[0].sequences.forbidden_next = 1; });
  expect_free("a prefix must hold stops of its agent, each at most once", [](TreeRecord& r) {
    r.orders[0].sequences.prefix = {0, 200};
  });
}

TEST_F(SmallTreeRecords, OfPathsThatAreNoneAreRefused) {
  const char* said = "a tree's path must have the length it claims";
  expect(said, [](TreeRecord& r) { r.orders[0].steps += 100; });
  expect(said, [](TreeRecord& r) { r.orders[0].words.clear(); });
  expect(said, [](TreeRecord& r) {
    r.orders[0].steps = ~std::uint32_t{0};
    r.orders[0].words.clear();
  });
  expect("a tree's path must be a walk on the map from its agent's start",
         [](TreeRecord& r) { r.orders[0].words[0] = ~std::uint64_t{0}; });
  expect("a tree's path must be a walk on the map from its agent's start",
         [](TreeRecord& r) { r.orders[0].words[0] = 0b010'001; });  // into the wall
}

TEST_F(SmallTreeRecords, OfPathsElsewhereAreRefused) {
  const char* said = "a tree's path must visit its agent's stops in order";
  // Past its tasks; not up to its destination; its tasks the other way round; not to its last task.
  expect(said, [&](TreeRecord& r) {
    take_path(r.orders[0], {{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}, {3, 2}});
  });
  expect(said, [&](TreeRecord& r) {
    take_path(r.orders[0], {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}});
  });
  expect(said, [](TreeRecord& r) { std::ranges::reverse(r.orders[0].sequences.prefix); });
  expect(said, [&](TreeRecord& r) { take_path(r.orders[1], {{0, 2}, {1, 2}, {2, 2}, {3, 2}}); });
  const char* said_free = "a path that realizes no sequence of the class";
  expect_free(said_free, [&](TreeRecord& r) { take_path(r.orders[1], {{0, 2}, {1, 2}}); });
  expect_free(said_free, [&](TreeRecord& r) {
    take_path(r.orders[0], {{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  });
}

// A longer path would be a bound that nobody proved.
TEST_F(SmallTreeRecords, OfDetoursAreRefused) {
  const char* said = "a tree's path must be shortest in its order of stops";
  const auto wait = [&](TreeRecord& r) { take_path(r.orders[2], {{0, 1}, {0, 1}}); };
  expect(said, wait);
  expect_free(said, wait);
  const auto detour = [&](TreeRecord& r) {
    take_path(r.orders[1], {{0, 2}, {0, 1}, {0, 2}, {1, 2}, {2, 2}});
  };
  expect(said, detour);
  expect_free(said, detour);
  EXPECT_EQ(trees_.size(), 0u);
}

}  // namespace tree_record_test
}  // namespace grove::detail
