// SPDX-License-Identifier: MIT
// Tests learned bounds that are sent as values: the receiver's cache then holds the same bounds as
// if the receiver had computed them itself.
#include "search/learned_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "search/expander.h"
#include "search/single_tree.h"
#include "tests/primal/crowd.h"

namespace grove::detail {
namespace learned_bounds_test {

// A process with an expander. It numbers its subproblems independently of other processes.
struct Process {
  explicit Process(std::uint64_t seed)
      : instance(testing::random_crowd(
            {.size = 10, .obstacles = 25, .agents = 12, .tasks = 14, .no_destination = 10}, seed)),
        problem(instance, limits),
        stops(instance, problem.distances),
        forest(problem, stops, pool, limits),
        root(forest.next_root()),
        expander(problem, stops, {Techniques::defaults(), 0}) {
    expander.memory()->take_new_entries();
    trees.add(root->tree());
  }

  // Expands at most `max_nodes` nodes. Returns the cost and bound of the root and of every
  // generated node.
  std::vector<std::pair<Cost, Cost>> expand(std::size_t max_nodes) {
    std::vector<NodePtr> nodes{root};
    for (std::size_t i = 0; i < nodes.size() && i < max_nodes; ++i) {
      Expansion expansion;
      do {
        expansion = expander.expand(nodes[i], root->cost() + 20, limits);
        expander.publish();
      } while (expansion.unfinished);
      for (NodePtr& child : expansion.children) nodes.push_back(std::move(child));
    }
    std::vector<std::pair<Cost, Cost>> all;
    for (const NodePtr& node : nodes) all.emplace_back(node->cost(), node->bound());
    return all;
  }
  std::vector<LearnedBound> learned_bounds() {
    return learned_bounds_of(expander.memory()->take_new_entries(), *expander.memory(), trees);
  }

  Limits limits;
  Instance instance;
  Problem problem;
  AgentStopsCache stops;
  NodePool pool;
  SingleTree forest;
  NodePtr root;
  Expander expander;
  TreeIndex trees;
};

TEST(LearnedBound, ReceiverExpandsAsIfItHadComputedThem) {
  std::int64_t received = 0;
  Counters of_sender;
  Counters of_receiver;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Process sender(seed);
    const auto found = sender.expand(8);
    const auto bounds = sender.learned_bounds();
    received += std::ssize(bounds);
    Process receiver(seed);
    for (const LearnedBound& bound : bounds)
      merge(bound, receiver.trees, *receiver.expander.memory());
    EXPECT_TRUE(receiver.learned_bounds().empty()) << "a received bound is not new";
    EXPECT_EQ(receiver.expand(8), found) << "seed " << seed;
    of_sender += sender.expander.counts().reported;
    of_receiver += receiver.expander.counts().reported;
  }
  EXPECT_GT(received, 300) << "too few learned bounds for a test";
  EXPECT_GT(of_sender[Counter::kPairExpansions], 100);
  EXPECT_EQ(of_receiver[Counter::kPairExpansions], 0);
  EXPECT_LT(2 * of_receiver[Counter::kLowLevelCalls], of_sender[Counter::kLowLevelCalls]);
}

TEST(LearnedBound, IsNewOnce) {
  Process sender(1);
  sender.expand(4);
  EXPECT_FALSE(sender.learned_bounds().empty());
  EXPECT_TRUE(sender.learned_bounds().empty());
}

// Two trees in which the first agent has the same order and the second agent has different orders.
struct TwoTrees {
  TwoTrees() {
    for (int i = 0; i < 3; ++i) orders.push_back(std::make_shared<AgentSequencing>());
    trees[0].number = 4;
    trees[0].orders = {orders[0], orders[1]};
    trees[1].number = 7;
    trees[1].orders = {orders[0], orders[2]};
    for (const Tree& tree : trees) known.add(tree);
  }
  DependencyTable::ExcessBound of_pair(std::size_t first, std::size_t second,
                                       const std::vector<Constraint>& constraints) {
    return memory.excesses.of_pair(memory.subproblems.id(0, *orders[first], {}),
                                   memory.subproblems.id(1, *orders[second], constraints));
  }

  std::vector<std::shared_ptr<const AgentSequencing>> orders;
  std::array<Tree, 2> trees;
  TreeIndex known;
  SharedCache memory;
};

// An order can occur in several trees. A learned bound must apply to exactly the orders for which
// it was proven.
TEST(LearnedBound, AppliesToTheOrdersItWasProvenFor) {
  const std::vector<Constraint> constraints{{3, kNoCell, 1, 2}};
  TwoTrees here;
  here.memory.take_new_entries();
  CacheDelta found;
  found.pairs.push_back({here.memory.subproblems.id(0, *here.orders[0], {}),
                         here.memory.subproblems.id(1, *here.orders[2], constraints),
                         1,
                         {5, true, 9}});
  here.memory.merge(found);
  const auto bounds = learned_bounds_of(here.memory.take_new_entries(), here.memory, here.known);
  ASSERT_EQ(bounds.size(), 1u);

  TwoTrees there;
  there.memory.subproblems.id(1, *there.orders[1], {});  // makes the numbering differ
  merge(bounds[0], there.known, there.memory);
  EXPECT_EQ(there.of_pair(0, 2, constraints).excess, 5);
  EXPECT_TRUE(there.of_pair(0, 2, constraints).exact);
  EXPECT_EQ(there.of_pair(0, 1, constraints).excess, 0);
  EXPECT_EQ(there.of_pair(0, 2, {}).excess, 0);
}

TEST(LearnedBound, OfUnknownTreesIsIgnored) {
  TwoTrees s;
  const LearnedBound bound{{{4, 0, {}}, {5, 1, {}}}, {}, {5, true, 9}};
  merge(bound, s.known, s.memory);
  EXPECT_EQ(s.memory.excesses.bytes(), 0);
}

TEST(LearnedBound, RefusesInvalidBounds) {
  TwoTrees s;
  const auto refuses = [&](const LearnedBound& bound) {
    EXPECT_THROW(merge(bound, s.known, s.memory), std::invalid_argument);
    EXPECT_EQ(s.memory.excesses.bytes(), 0);
  };
  refuses({});
  refuses({{{4, 1, {}}, {4, 0, {}}}, {}, {5, true, 9}});
  refuses({{{4, 1, {}}, {4, 1, {}}}, {}, {5, true, 9}});
  refuses({{{4, 0, {}}, {4, 2, {}}}, {}, {5, true, 9}});
  refuses({{{4, -1, {}}, {4, 1, {}}}, {}, {5, true, 9}});
  refuses({{{4, 0, {}}, {4, 1, {}}}, {}, {-5, true, 9}});
  refuses({{{4, 0, {}}}, {-3, true}, {}});
}

TEST(LearnedBound, UtilityDependsOnEffortExcessAndConstraints) {
  const PackedConstraints constraints(std::vector<Constraint>{{3, kNoCell, 1, 2}});
  const LearnedBound expensive{{{0, 0, {}}, {0, 1, {}}}, {}, {1, true, 9}};
  const LearnedBound cheap{{{0, 0, {}}, {0, 1, {}}}, {}, {1, true, 2}};
  const LearnedBound special{{{0, 0, constraints}, {0, 1, {}}}, {}, {1, true, 9}};
  const LearnedBound harmless{{{0, 0, {}}, {0, 1, {}}}, {}, {0, true, 9}};
  EXPECT_GT(expensive.utility(), cheap.utility());
  EXPECT_GT(expensive.utility(), harmless.utility());
  EXPECT_GT(expensive.utility(), special.utility());
}

}  // namespace learned_bounds_test
}  // namespace grove::detail
