// SPDX-License-Identifier: MIT
// What one process found out is told as values, and another knows as much as if it had found it.
#include "search/learned_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "search/expander.h"
#include "search/single_tree.h"
#include "tests/primal/crowd.h"

namespace grove::detail {
namespace facts_test {

// A process: all that is found out there has numbers of its own.
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

  // Expands so many nodes; the costs and bounds of all that came out.
  std::vector<std::pair<Cost, Cost>> expand(std::size_t most) {
    std::vector<NodePtr> nodes{root};
    for (std::size_t i = 0; i < nodes.size() && i < most; ++i) {
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
  std::vector<LearnedBound> facts() {
    return facts_of(expander.memory()->take_new_entries(), *expander.memory(), trees);
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

TEST(Facts, ServeWhoeverIsToldAsIfItHadFoundThem) {
  std::int64_t told = 0;
  ExpansionCounts of_finder;
  ExpansionCounts of_told;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Process finder(seed);
    const auto found = finder.expand(8);
    const auto facts = finder.facts();
    told += std::ssize(facts);
    Process other(seed);
    for (const LearnedBound& fact : facts) merge(fact, other.trees, *other.expander.memory());
    EXPECT_TRUE(other.facts().empty()) << "what one is told is no news";
    EXPECT_EQ(other.expand(8), found) << "seed " << seed;
    of_finder += finder.expander.counts();
    of_told += other.expander.counts();
  }
  EXPECT_GT(told, 300) << "too little was found out to be a test";
  EXPECT_GT(of_finder.pair_expansions, 100);
  EXPECT_EQ(of_told.pair_expansions, 0);
  EXPECT_LT(2 * of_told.low_level_calls, of_finder.low_level_calls);
}

TEST(Facts, AreNewsOnce) {
  Process finder(1);
  finder.expand(4);
  EXPECT_FALSE(finder.facts().empty());
  EXPECT_TRUE(finder.facts().empty());
}

// Two trees in which the first agent has one order, and the second agent another in each.
struct TwoTrees {
  TwoTrees() {
    for (int i = 0; i < 3; ++i) orders.push_back(std::make_shared<AgentSequencing>());
    trees[0].number = 4;
    trees[0].orders = {orders[0], orders[1]};
    trees[1].number = 7;
    trees[1].orders = {orders[0], orders[2]};
    for (const Tree& tree : trees) known.add(tree);
  }
  DependencyTable::Known of_pair(std::size_t first, std::size_t second,
                                 const std::vector<Constraint>& demands) {
    return memory.excesses.of_pair(memory.situations.id(0, *orders[first], {}),
                                   memory.situations.id(1, *orders[second], demands));
  }

  std::vector<std::shared_ptr<const AgentSequencing>> orders;
  std::array<Tree, 2> trees;
  TreeIndex known;
  SharedCache memory;
};

// An order may be one of several trees; what is said must be about the very orders.
TEST(Facts, AreAboutTheOrdersThatTheyWereFoundFor) {
  const std::vector<Constraint> demands{{3, kNoCell, 1, 2}};
  TwoTrees here;
  here.memory.take_new_entries();
  CacheDelta found;
  found.pairs.push_back({here.memory.situations.id(0, *here.orders[0], {}),
                         here.memory.situations.id(1, *here.orders[2], demands),
                         1,
                         {5, true, 9}});
  here.memory.merge(found);
  const auto facts = facts_of(here.memory.take_new_entries(), here.memory, here.known);
  ASSERT_EQ(facts.size(), 1u);

  TwoTrees there;
  there.memory.situations.id(1, *there.orders[1], {});  // numbers differ
  merge(facts[0], there.known, there.memory);
  EXPECT_EQ(there.of_pair(0, 2, demands).excess, 5);
  EXPECT_TRUE(there.of_pair(0, 2, demands).exact);
  EXPECT_EQ(there.of_pair(0, 1, demands).excess, 0);
  EXPECT_EQ(there.of_pair(0, 2, {}).excess, 0);
}

TEST(Facts, OfTreesThatAreNotHereAreIgnored) {
  TwoTrees s;
  const LearnedBound fact{{{4, 0, {}}, {5, 1, {}}}, {}, {5, true, 9}};
  merge(fact, s.known, s.memory);
  EXPECT_EQ(s.memory.excesses.bytes(), 0);
}

TEST(Facts, RefuseWhatCannotBe) {
  TwoTrees s;
  const auto refuses = [&](const LearnedBound& fact) {
    EXPECT_THROW(merge(fact, s.known, s.memory), std::invalid_argument);
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

TEST(Facts, AreWorthMoreTheLongerTheyTookTheFewerConstraintsTheyHaveAndIfTheyRaiseBounds) {
  const PackedConstraints demands(std::vector<Constraint>{{3, kNoCell, 1, 2}});
  const LearnedBound expensive{{{0, 0, {}}, {0, 1, {}}}, {}, {1, true, 9}};
  const LearnedBound cheap{{{0, 0, {}}, {0, 1, {}}}, {}, {1, true, 2}};
  const LearnedBound special{{{0, 0, demands}, {0, 1, {}}}, {}, {1, true, 9}};
  const LearnedBound harmless{{{0, 0, {}}, {0, 1, {}}}, {}, {0, true, 9}};
  EXPECT_GT(expensive.utility(), cheap.utility());
  EXPECT_GT(expensive.utility(), harmless.utility());
  EXPECT_GT(expensive.utility(), special.utility());
}

}  // namespace facts_test
}  // namespace grove::detail
