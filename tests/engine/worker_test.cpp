// SPDX-License-Identifier: MIT
// Tests which work items a worker chooses and when their results become visible to other workers.
#include "engine/worker.h"

#include <gtest/gtest.h>

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "small_search.h"
#include "tests/primal/crowd.h"

namespace grove::detail {
namespace worker_test {

// A search with workers that the test advances step by step.
struct Search : testing::SmallSearch {
  explicit Search(Techniques techniques, Instance the_instance = testing::two_in_a_bay())
      : Search(with(techniques), std::move(the_instance)) {}
  Search(const SolveOptions& the_options, Instance the_instance)
      : SmallSearch(std::move(the_instance)), options(the_options) {
    bounds.nodes = source.nodes = &nodes;
    nodes.push(root);
  }
  static SolveOptions with(Techniques techniques) {
    SolveOptions options;
    options.omega = Omega();
    options.techniques = techniques;
    return options;
  }

  Worker worker(int number = 0) { return Worker(components, number); }

  SolveOptions options;
  testing::ScriptedBounds bounds;
  testing::CountingSource source;
  testing::CountingObserver observer;
  Components components{problem, options, limits, stops, nodes, bounds, source, observer};
};

std::string_view name_of(const std::unique_ptr<WorkItem>& item) {
  return item ? item->name() : "none";
}

std::int64_t count(const Worker& worker, Counter counter) {
  Counters counters;
  worker.add_counts(counters);
  return counters[counter];
}

void complete(Worker& worker, WorkItem& item) {
  item.perform(worker.workspace());
  item.publish();
  worker.commit(item);
}

Instance large_dense_instance() {
  return testing::random_crowd({.size = 12, .obstacles = 15, .agents = 16, .tasks = 16}, 1);
}

TEST(Worker, WorkItemIsVisibleToOthersOnceCommitted) {
  Search s({});
  Worker worker = s.worker();
  const auto item = worker.choose();
  ASSERT_EQ(name_of(item), "expand");
  EXPECT_TRUE(item->allows_next());
  item->perform(worker.workspace());
  item->publish();
  EXPECT_EQ(s.nodes.frontier.live(), 1u) << "the root, taken";
  EXPECT_EQ(s.observer.expansions, 0);
  worker.commit(*item);
  EXPECT_EQ(s.nodes.frontier.open(), 2u);
  EXPECT_EQ(s.observer.expansions, 1);
  EXPECT_EQ(s.observer.work_items, 1);
}

TEST(Worker, AbandonedItemReturnsItsNode) {
  Search s({});
  Worker worker = s.worker();
  const auto item = worker.choose();
  item->perform(worker.workspace());
  item->abandon();
  worker.commit(*item);
  EXPECT_EQ(s.nodes.frontier.open(), 1u);
  EXPECT_EQ(s.nodes.frontier.bound(), s.root->bound());
  EXPECT_EQ(s.observer.expansions, 0);
}

// The effort of an item is its number of labels, plus 16 per call of the low level, plus a quarter
// of the node's cost, plus 1. duration() also counts the other expensive operations.
TEST(Worker, CountsTheWorkOfAnItem) {
  Search s({Technique::kStrongBranching, Technique::kWdg, Technique::kJointMdd});
  Worker worker = s.worker();
  Expander& expander = worker.workspace().expander();
  double duration = 0;
  for (int i = 0; i < 3; ++i) {
    const auto item = worker.choose();
    ASSERT_EQ(name_of(item), "expand");
    const Counters before = expander.counts().reported;
    item->perform(worker.workspace());
    const Counters after = expander.counts().reported;
    const std::int64_t labels =
        after[Counter::kLowLevelExpanded] - before[Counter::kLowLevelExpanded];
    const std::int64_t calls = after[Counter::kLowLevelCalls] - before[Counter::kLowLevelCalls];
    duration += item->duration();
    worker.commit(*item);
    EXPECT_EQ(item->effort(), labels + 16 * calls + s.observer.last_cost / 4 + 1);
  }
  const ExpansionCounts c = expander.counts();
  const Counters counted = c.reported;
  EXPECT_GT(counted[Counter::kLowLevelCalls], 0);
  EXPECT_GT(counted[Counter::kJointMddNodes], 0);
  EXPECT_EQ(count(worker, Counter::kLowLevelCalls), counted[Counter::kLowLevelCalls]);
  const std::int64_t work =
      counted[Counter::kLowLevelExpanded] + 16 * counted[Counter::kLowLevelCalls];
  const auto times = [](double rate, std::int64_t of) { return rate * static_cast<double>(of); };
  EXPECT_NEAR(duration,
              times(1, work) + times(0.55, c.mdd_nodes) +
                  times(0.85, counted[Counter::kJointMddNodes]) + times(2, c.subproblems) +
                  times(1.7, c.groups) + times(0.15, c.path_steps),
              1e-6);
}

TEST(Worker, StartsWithPrimalSearchIfTheRootIsLarge) {
  for (const Technique without : {Technique::kPrimal, Technique::kBypass}) {
    Search s(Techniques::defaults().without(without), large_dense_instance());
    EXPECT_EQ(name_of(s.worker().choose()),
              without == Technique::kPrimal ? "expand" : "primal search");
  }
  Search small(Techniques::defaults());
  EXPECT_EQ(name_of(small.worker().choose()), "expand");
  SolveOptions fixed = Search::with(Techniques::defaults());
  fixed.policy = Policy::kFixed;
  Search plain(fixed, large_dense_instance());
  EXPECT_EQ(name_of(plain.worker().choose()), "expand") << "plain CBS";
}

// Returns the plans that worker `number` finds in its first `items` primal work items.
std::vector<Plan> found_by(Search& s, int number, int items) {
  Worker worker = s.worker(number);
  for (int i = 0; i < items; ++i) {
    const auto item = worker.choose();
    if (name_of(item) != "primal search") break;
    complete(worker, *item);
  }
  std::vector<Plan> plans;
  for (const auto& [plan, source] : s.bounds.posted) {
    EXPECT_NE(source, PlanSource::kTree);
    plans.push_back(plan);
  }
  return plans;
}

TEST(Worker, PrimalSearchOfEachWorkerHasItsOwnSeed) {
  const auto paths = [](int number) {
    Search s(Techniques::defaults(), large_dense_instance());
    s.nodes.frontier.take();  // so that no node can be expanded
    std::vector<Path> all;
    for (const Plan& plan : found_by(s, number, 40))
      for (const AgentPlan& agent : plan.agents) all.push_back(agent.path);
    return all;
  };
  EXPECT_FALSE(paths(0).empty());
  EXPECT_EQ(paths(0), paths(0));
  EXPECT_NE(paths(0), paths(1));
}

TEST(Worker, PrimalSearchFindsOnlyPlansBelowTheIncumbent) {
  Search s(Techniques::defaults(), large_dense_instance());
  s.nodes.frontier.take();
  const std::vector<Plan> plans = found_by(s, 0, 40);
  ASSERT_GT(plans.size(), 1u);
  Search with_incumbent(Techniques::defaults(), large_dense_instance());
  with_incumbent.nodes.frontier.take();
  with_incumbent.bounds.incumbent = plans.front();
  for (const Plan& plan : found_by(with_incumbent, 0, 40)) EXPECT_LT(plan.cost, plans.front().cost);
}

TEST(Worker, HelpsToBoundANodeOfAnotherWorker) {
  Search s({Technique::kWdg, Technique::kStrongBranching});
  TreeSearch& tree = s.components.tree();
  Expansion unfinished;
  unfinished.unfinished = true;
  tree.finish(tree.take(), std::move(unfinished), 0);
  tree.take();
  Worker worker = s.worker(1);
  int helps = 0;
  auto item = worker.choose();
  for (; name_of(item) == "help"; item = worker.choose()) {
    ASSERT_LT(helps++, 100);
    complete(worker, *item);
  }
  EXPECT_GT(helps, 1) << "weights were computed first";
  EXPECT_FALSE(item) << "no other work is left";
  EXPECT_EQ(count(worker, Counter::kAssists), helps);
  EXPECT_GT(count(worker, Counter::kPairExpansions), 0);
  EXPECT_EQ(s.observer.expansions, 0) << "the other worker expands the node";
  EXPECT_EQ(s.nodes.frontier.live(), 1u);
}

TEST(Worker, PreparesATreeOnlyWithoutOtherWork) {
  Search s({});
  s.source.may_prepare = true;
  Worker worker = s.worker();
  const auto expand = worker.choose();
  EXPECT_EQ(name_of(expand), "expand");
  const auto item = worker.choose();
  ASSERT_EQ(name_of(item), "prepare a tree");
  item->perform(worker.workspace());
  EXPECT_EQ(s.source.prepared, 1);
  worker.commit(*item);
  EXPECT_EQ(s.observer.work_items, 1);
  EXPECT_FALSE(worker.turn());
}

TEST(Worker, OneWorkerSolvesAnInstance) {
  Search s({Technique::kStrongBranching});
  Worker worker = s.worker();
  while (s.bounds.posted.empty() || s.nodes.frontier.bound() < s.bounds.posted.back().first.cost)
    ASSERT_TRUE(worker.turn());
  EXPECT_EQ(s.bounds.posted.back().first.cost, 11);
}

}  // namespace worker_test
}  // namespace grove::detail
